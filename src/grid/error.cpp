#include "filigree/grid/error.h"

#include "grid/sub_grids.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace filigree::grid {
namespace {

double squaredDistance(const Vec3& a, const Vec3& b) {
    double sum = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
        const double off = double{a[axis]} - double{b[axis]};
        sum += off * off;
    }
    return sum;
}

// Sums of runs, added in their order, so that the threads do not matter.
struct RunSum {
    double total = 0;
    double most = 0;
    uint64_t count = 0;

    void add(double value) {
        total += value;
        most = std::max(most, value);
        ++count;
    }
    void add(const RunSum& other) {
        total += other.total;
        most = std::max(most, other.most);
        count += other.count;
    }
    [[nodiscard]] double mean() const { return count > 0 ? total / static_cast<double>(count) : 0; }
};

// Of a sum of squared distances.
VertexErrors errorsOf(const RunSum& squares) {
    return {std::sqrt(squares.mean()), std::sqrt(squares.most), squares.count};
}

// The sum of body(begin, end) over runs of indices.
RunSum summed(size_t count, const Executor& executor, const std::function<RunSum(size_t, size_t)>& body) {
    constexpr size_t run = 4096;
    std::vector<RunSum> sums((count + run - 1) / run);
    executor.parallelFor(sums.size(), 1, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k) sums[k] = body(k * run, std::min(count, (k + 1) * run));
    });
    RunSum all;
    for (const RunSum& sum : sums) all.add(sum);
    return all;
}

// The largest error of a sub-grid against the diagonal of its box, negative where that is 0.
double shareOf(const GridMesh& mesh, const DecodedGrids& decoded, const PaperPlace& place) {
    const VertexGrid& grid = mesh.grids[place.grid];
    double most = 0;
    Box box;
    for (unsigned row = 0; row <= place.rows; ++row) {
        for (unsigned column = 0; column <= place.columns; ++column) {
            const uint64_t k = vertexOf(grid, place, column, row);
            most = std::max(most, squaredDistance(mesh.vertices[k], decoded.vertices[k]));
            box.extend(mesh.vertices[k]);
        }
    }
    const double diagonal = std::sqrt(squaredDistance(box.low, box.high));
    return diagonal > 0 ? std::sqrt(most) / diagonal : -1;
}

RunSum looseErrors(const GridMesh& mesh, const DecodedGrids& decoded) {
    RunSum sum;
    for (size_t t = 0; t < mesh.looseTriangles.size(); ++t) {
        for (size_t corner = 0; corner < 3; ++corner) {
            const Vec3& source = mesh.looseVertices[mesh.looseTriangles[t][corner]];
            sum.add(squaredDistance(source, decoded.looseTriangles[t][corner]));
        }
    }
    return sum;
}

}  // namespace

Box boundsOf(const GridMesh& mesh) {
    Box box;
    for (const Vec3& vertex : mesh.vertices) box.extend(vertex);
    for (const Vec3& vertex : mesh.looseVertices) box.extend(vertex);
    return box;
}

GridErrors errorsOf(const GridMesh& mesh, const DecodedGrids& decoded, const Executor& executor) {
    RunSum sum = summed(mesh.vertices.size(), executor, [&](size_t begin, size_t end) {
        RunSum some;
        for (size_t k = begin; k < end; ++k) some.add(squaredDistance(mesh.vertices[k], decoded.vertices[k]));
        return some;
    });
    GridErrors errors;
    errors.grids = errorsOf(sum);
    sum.add(looseErrors(mesh, decoded));
    errors.all = errorsOf(sum);
    const std::vector<PaperPlace> places = subGridsOf(mesh);
    const auto shares = summed(places.size(), executor, [&](size_t begin, size_t end) {
        RunSum some;
        for (size_t k = begin; k < end; ++k) {
            const double share = shareOf(mesh, decoded, places[k]);
            if (share >= 0) some.add(share);
        }
        return some;
    });
    errors.subGridMean = shares.mean();
    errors.subGridMax = shares.most;
    return errors;
}

SubGridShares subGridShares(const GridMesh& mesh, const DecodedGrids& decoded, uint32_t grid) {
    SubGridShares shares;
    shares.columns = (mesh.grids[grid].columns + paperQuads - 2) / paperQuads;
    shares.rows = (mesh.grids[grid].rows + paperQuads - 2) / paperQuads;
    for (const PaperPlace& place : subGridsOf(mesh, grid))
        shares.shares.push_back(static_cast<float>(std::max(0.0, shareOf(mesh, decoded, place))));
    return shares;
}

VertexErrors paperErrors(const GridMesh& mesh, DisplacementCode displacement, const Executor& executor) {
    const PaperCode paper = PaperCode::forDiagonal(displacement, boundsOf(mesh).diagonal());
    const std::vector<PaperPlace> places = subGridsOf(mesh);
    const auto sum = summed(places.size(), executor, [&](size_t begin, size_t end) {
        RunSum some;
        for (size_t k = begin; k < end; ++k) {
            const PaperPlace& place = places[k];
            const PaperVertices source = subGridVertices(mesh.vertices, mesh.grids[place.grid], place);
            const PaperVertices vertices = decodePaper(encodePaper(place, source, paper).data(), paper);
            for (unsigned row = 0; row < ownVertices(place.gridRow, place.rows, place.gridRows); ++row) {
                const unsigned columns = ownVertices(place.gridColumn, place.columns, place.gridColumns);
                for (unsigned v = row * paperSide; v < row * paperSide + columns; ++v)
                    some.add(squaredDistance(source[v], vertices[v]));
            }
        }
        return some;
    });
    return errorsOf(sum);
}

}  // namespace filigree::grid
