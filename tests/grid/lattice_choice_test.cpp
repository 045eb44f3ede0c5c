// Lattices from the error that is allowed: bounds that hold on every vertex, regular axes, clear refusals.
#include "filigree/grid/lattice_choice.h"

#include "filigree/core/box.h"
#include "filigree/grid/shapes.h"

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <tuple>

#include <gtest/gtest.h>

namespace filigree::grid {
namespace {

GridMesh sheet(uint32_t columns, uint32_t rows, const std::function<Vec3(uint32_t, uint32_t)>& at) {
    GridMesh mesh;
    mesh.grids = {{columns, rows, 0, 0}};
    for (uint32_t row = 0; row < rows; ++row)
        for (uint32_t column = 0; column < columns; ++column) mesh.vertices.push_back(at(column, row));
    return mesh;
}
GridMesh heightfield(double cell, double scale, double bump) {
    return sheet(70, 50, [=](uint32_t column, uint32_t row) {
        const double grey = std::round(2000 + 900 * std::sin(0.11 * column) * std::cos(0.07 * row)) +
                            bump * std::sin(column * 12.9 + row * 78.2);
        return Vec3{static_cast<float>(column * cell), static_cast<float>(grey * scale),
                    static_cast<float>(row * cell)};
    });
}

struct Measured {
    double rms = 0;
    double max = 0;
    std::array<double, 3> maxOnAxis{};
};
Measured measured(const GridMesh& mesh, const Lattice& lattice) {
    Measured errors;
    for (const Vec3& vertex : mesh.vertices) {
        const LatticePoint point = lattice.pointAt(vertex);
        const Vec3 decoded = lattice.positionOf(point);
        double square = 0;
        for (size_t k = 0; k < 3; ++k) {
            EXPECT_GE(point[k], 0);
            EXPECT_LT(point[k], latticeLimit);
            const double off = std::abs(double{decoded[k]} - double{vertex[k]});
            errors.maxOnAxis[k] = std::max(errors.maxOnAxis[k], off);
            square += off * off;
        }
        errors.rms += square;
        errors.max = std::max(errors.max, std::sqrt(square));
    }
    errors.rms = std::sqrt(errors.rms / static_cast<double>(mesh.vertices.size()));
    return errors;
}
double diagonalOf(const GridMesh& mesh) {
    Box bounds;
    for (const Vec3& vertex : mesh.vertices) bounds.extend(vertex);
    return double{bounds.diagonal()};
}
// What latticeForError and latticeForRms say of rounding.
double rounding(const GridMesh& mesh, size_t axis) {
    double most = 0;
    for (const Vec3& vertex : mesh.vertices) most = std::max(most, std::abs(double{vertex[axis]}));
    return std::ldexp(most, -22);
}

TEST(LatticeForError, BoundsEveryVertex) {
    for (const GridMesh& mesh : {terrain(65, serialExecutor()), torus(65, serialExecutor()),
                                 box(24, serialExecutor()), heightfield(0.3, 0.01, 0.2)})
        for (const double share : {1e-6, 1e-4, 1e-2}) {
            const double wanted = share * diagonalOf(mesh);
            const auto lattice = latticeForError(mesh, wanted);
            ASSERT_TRUE(lattice.ok()) << lattice.error().message;
            const Measured errors = measured(mesh, *lattice);
            EXPECT_LE(errors.max, wanted * (1 + 1e-6) + 3 * rounding(mesh, 0));
            EXPECT_GE(errors.max, wanted / 3);
            for (size_t k = 0; k < 3; ++k)
                EXPECT_LE(errors.maxOnAxis[k], lattice->step[k] / 2 + rounding(mesh, k));
        }
}

TEST(LatticeForError, LeavesEvenAxesExact) {
    const auto lattice = latticeForError(heightfield(0.3, 0.01, 0.2), 1.0);
    ASSERT_TRUE(lattice.ok()) << lattice.error().message;
    EXPECT_NEAR(lattice->step[0], 0.3, 1e-8);
    EXPECT_DOUBLE_EQ(lattice->step[1], 2.0);
    EXPECT_NEAR(lattice->step[2], 0.3, 1e-8);
}

TEST(LatticeForError, TakesARegularSpacingThatIsCoarser) {
    // Heights are whole steps of 0.25, which need not be cut finer; nor do they decide the others' step.
    const GridMesh mesh = heightfield(0.3, 0.25, 0);
    EXPECT_DOUBLE_EQ(latticeForError(mesh, 0.1)->step[1], 0.25);
    EXPECT_DOUBLE_EQ(latticeForError(mesh, 0.4)->step[1], 0.8);
}

TEST(LatticeForRms, GivesTheRmsThatWasWanted) {
    for (const GridMesh& mesh : {terrain(257, serialExecutor()), torus(257, serialExecutor())})
        for (const double share : {3e-7, 2e-6, 5e-5, 1e-3}) {
            const double wanted = share * diagonalOf(mesh);
            const auto lattice = latticeForRms(mesh, wanted, serialExecutor());
            ASSERT_TRUE(lattice.ok()) << lattice.error().message;
            const double rms = measured(mesh, *lattice).rms;
            EXPECT_LE(rms, wanted);
            EXPECT_GE(rms, 0.99 * wanted);
        }
}

TEST(LatticeForRms, IsTheSameForAnyThreads) {
    const GridMesh mesh = torus(300, serialExecutor());
    const auto threads = makeThreadedExecutor(3);
    EXPECT_TRUE(*latticeForRms(mesh, 1e-5, serialExecutor()) == *latticeForRms(mesh, 1e-5, *threads));
}

TEST(LosslessLattice, HoldsHeightfieldsToTheBit) {
    for (const double cell : {1.0, 0.1, 30.0, 1.0 / 3, 0.7251})
        for (const double scale : {1.0, 0.1, 1.0 / 65535, -0.01, 257.0, 0.0137}) {
            const GridMesh mesh = heightfield(cell, scale, 0);
            const auto lattice = losslessLattice(mesh);
            ASSERT_TRUE(lattice.ok()) << cell << " " << scale << ": " << lattice.error().message;
            EXPECT_EQ(measured(mesh, *lattice).max, 0);
            EXPECT_NEAR(lattice->step[1], std::abs(scale), 1e-5 * std::abs(scale));
        }
}

TEST(LosslessLattice, FindsTheGreatestStep) {
    GridMesh mesh = heightfield(2, 257, 0);
    EXPECT_EQ(losslessLattice(mesh)->step, (std::array<double, 3>{2, 257, 2}));
    for (Vec3& vertex : mesh.vertices) vertex[1] += 3;
    EXPECT_EQ(losslessLattice(mesh)->step[1], 257);
}

TEST(LosslessLattice, HoldsQuantisedMeshes) {
    std::mt19937 random(1);
    const GridMesh mesh = sheet(9, 9, [&](uint32_t, uint32_t) {
        const auto number = [&] { return static_cast<float>(random() % 40000) / 65536 - 0.3125F; };
        return Vec3{number(), number(), number()};
    });
    const auto lattice = losslessLattice(mesh);
    ASSERT_TRUE(lattice.ok()) << lattice.error().message;
    EXPECT_EQ(measured(mesh, *lattice).max, 0);
}

TEST(LosslessLattice, NamesAVertexWhereThereIsNone) {
    GridMesh mesh = heightfield(1, 1, 0);
    mesh.vertices[17][1] = 12.3456789F;
    const auto lattice = losslessLattice(mesh);
    ASSERT_FALSE(lattice.ok());
    EXPECT_EQ(lattice.error().kind, ErrorKind::unsupported);
    EXPECT_THAT(lattice.error().message, testing::HasSubstr("vertex 17 of the grids: "));
}

TEST(LatticeChoice, CountsLooseVertices) {
    GridMesh mesh = heightfield(1, 1, 0);
    mesh.looseVertices = {{-5, 1, 1000}};
    const auto lattice = losslessLattice(mesh);
    ASSERT_TRUE(lattice.ok());
    EXPECT_EQ(lattice->origin[0], -5);
    EXPECT_EQ(lattice->pointAt(mesh.looseVertices[0])[2], 1000);
    mesh.looseVertices[0][2] = std::numeric_limits<float>::quiet_NaN();
    const auto none = losslessLattice(mesh);
    ASSERT_FALSE(none.ok());
    EXPECT_THAT(none.error().message, testing::HasSubstr("loose vertex 0: z is not"));
}

TEST(LatticeChoice, RefusesErrorsThatMakeNoSense) {
    const GridMesh mesh = heightfield(1, 1, 0.5);
    for (const double wanted : {0.0, -1.0, 1e9, std::numeric_limits<double>::quiet_NaN(),
                                std::numeric_limits<double>::infinity()}) {
        const auto error = latticeForError(mesh, wanted);
        ASSERT_FALSE(error.ok());
        EXPECT_EQ(error.error().kind, ErrorKind::usage);
        EXPECT_FALSE(latticeForRms(mesh, wanted, serialExecutor()).ok());
    }
}

TEST(LatticeChoice, SaysWhichStepWouldFit) {
    const GridMesh mesh = heightfield(1, 1, 0.5);
    const auto lattice = latticeForError(mesh, 1e-5);
    ASSERT_FALSE(lattice.ok());
    EXPECT_EQ(lattice.error().kind, ErrorKind::limit);
    EXPECT_THAT(lattice.error().message, testing::HasSubstr("a step of 0.0001"));
}

TEST(LatticeChoice, RefusesMeshesOfNothing) {
    EXPECT_FALSE(latticeForError({}, 1).ok());
    EXPECT_FALSE(losslessLattice({}).ok());
    // All at one place: no error is at most its diagonal, but the lattice is clear.
    GridMesh point = sheet(2, 2, [](uint32_t, uint32_t) { return Vec3{1, 2, 3}; });
    EXPECT_FALSE(latticeForError(point, 1).ok());
    EXPECT_EQ(losslessLattice(point)->pointAt({1, 2, 3}), (LatticePoint{0, 0, 0}));
}

}  // namespace
}  // namespace filigree::grid
