#include "filigree/grid/shapes.h"

#include "grid/noise.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace filigree::grid {
namespace {

using ExactPoint = NoisePoint<3>;

Vec3 roundedToFloat(const ExactPoint& p) {
    return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

// cos and sin of a share of a full turn, by their series: those of the standard library vary.
std::array<double, 2> cosineAndSine(double share) {
    const double quarters = std::floor(4 * share + 0.5);
    const double x = (share - quarters / 4) * 6.283185307179586477;  // within +-pi / 4
    double cosine = 1;
    double sine = x;
    double term = x;
    for (int k = 2; k < 20; ++k) {
        term *= k % 2 == 0 ? -x / k : x / k;  // 1 - x^2 / 2! + x^4 / 4! ... and x - x^3 / 3! + ...
        (k % 2 == 0 ? cosine : sine) += term;
    }
    switch (static_cast<int>(quarters) & 3) {
        case 0:
            return {cosine, sine};
        case 1:
            return {-sine, cosine};
        case 2:
            return {-cosine, -sine};
        default:
            return {sine, -cosine};
    }
}

// Appends a grid whose vertex (column, row) is at(column, row).
template <class At>
void addGrid(GridMesh& mesh, uint32_t columns, uint32_t rows, const Executor& executor, const At& at) {
    const VertexGrid grid{columns, rows, mesh.vertices.size(), mesh.quadCount()};
    mesh.vertices.resize(grid.firstVertex + grid.vertexCount());
    constexpr size_t rowsAtOnce = 8;
    executor.parallelFor(rows, rowsAtOnce, [&](size_t begin, size_t end) {
        for (size_t row = begin; row < end; ++row) {
            for (uint32_t column = 0; column < columns; ++column)
                mesh.vertices[grid.firstVertex + row * columns + column] =
                    at(column, static_cast<uint32_t>(row));
        }
    });
    mesh.grids.push_back(grid);
}

double heightAt(double x, double z) {
    const NoisePoint<2> p{x, z};
    const double plain = fractalNoise<2>(p, 2, 3, 0.5, 11);
    const double ridges = ridgedNoise<2>(p, 4, 4, 0.42, 0.02, 23);
    const double detail = fractalNoise<2>(p, 48, 3, 0.4, 37);
    const double rough = 0.25 + 0.75 * ridges * ridges;
    return 0.2 * plain + 0.08 * ridges + 0.01 * rough * detail;
}

ExactPoint torusPoint(double around, double tube) {
    const auto [ca, sa] = cosineAndSine(around);
    const auto [ct, st] = cosineAndSine(tube);
    const ExactPoint normal{ct * ca, st, -ct * sa};
    const ExactPoint p{ca + 0.4 * normal[0], 0.4 * normal[1], -sa + 0.4 * normal[2]};
    const double bumps = 0.05 * fractalNoise<3>(p, 2.5, 3, 0.5, 5);
    const double detail = 0.018 * ridgedNoise<3>(p, 12, 3, 0.4, 0.05, 7);
    ExactPoint displaced{};
    for (size_t k = 0; k < 3; ++k) displaced[k] = p[k] + (bumps + detail) * normal[k];
    return displaced;
}

// A box's surface in whole steps along its edges.
class BoxSurface {
  public:
    explicit BoxSurface(uint32_t side) : side_(side) {}

    // Each coordinate at most `side`, at least one of them 0 or `side`.
    [[nodiscard]] Vec3 at(uint32_t i, uint32_t j, uint32_t k) const {
        ExactPoint p{along(i), along(j), along(k)};
        const double swell = 1 + 0.12 * fractalNoise<3>(p, 1.5, 4, 0.45, 3);
        for (double& x : p) x *= swell;
        return roundedToFloat(p);
    }

    // The belt's vertex at `step` of 4 * side about the y axis, from (0, 0, side) towards x.
    [[nodiscard]] Vec3 beltAt(uint32_t step, uint32_t j) const {
        const uint32_t part = step / side_ % 4;
        const uint32_t far = step % side_;
        switch (part) {
            case 0:
                return at(far, j, side_);
            case 1:
                return at(side_, j, side_ - far);
            case 2:
                return at(side_ - far, j, 0);
            default:
                return at(0, j, far);
        }
    }

  private:
    [[nodiscard]] double along(uint32_t step) const { return 2.0 * step / side_ - 1; }

    uint32_t side_;
};

}  // namespace

GridMesh terrain(uint32_t n, const Executor& executor) {
    assert(n >= 2);
    GridMesh mesh;
    const double last = n - 1;
    addGrid(mesh, n, n, executor, [&](uint32_t column, uint32_t row) {
        const double x = column / last;
        const double z = 1 - row / last;
        return roundedToFloat({x, heightAt(x, z), z});
    });
    return mesh;
}

GridMesh torus(uint32_t n, const Executor& executor) {
    assert(n >= 4);
    GridMesh mesh;
    const uint32_t steps = n - 1;
    addGrid(mesh, n, n, executor, [&](uint32_t column, uint32_t row) {
        return roundedToFloat(torusPoint(static_cast<double>(column % steps) / steps,
                                         static_cast<double>(row % steps) / steps));
    });
    return mesh;
}

GridMesh box(uint32_t side, const Executor& executor) {
    assert(side >= 8);
    GridMesh mesh;
    const BoxSurface surface(side);
    const uint32_t cut = side / 3 + 1;               // where the belt begins
    const uint32_t first = 2 * side + side / 4 + 1;  // quads of its first half
    addGrid(mesh, side + 1, side + 1, executor,
            [&](uint32_t column, uint32_t row) { return surface.at(column, side, side - row); });
    addGrid(mesh, side + 1, side + 1, executor,
            [&](uint32_t column, uint32_t row) { return surface.at(row, 0, side - column); });
    addGrid(mesh, first + 1, side + 1, executor,
            [&](uint32_t column, uint32_t row) { return surface.beltAt(cut + column, row); });
    const uint64_t secondHalf = mesh.quadCount();
    addGrid(mesh, side + 1, 4 * side - first + 1, executor,
            [&](uint32_t column, uint32_t row) { return surface.beltAt(cut + 4 * side - row, column); });
    mesh.diagonals.resize(mesh.quadCount(), Diagonal::ac);
    std::fill(mesh.diagonals.begin() + static_cast<std::ptrdiff_t>(secondHalf), mesh.diagonals.end(),
              Diagonal::bd);
    return mesh;
}

}  // namespace filigree::grid
