// The verb grids: budgets on real meshes and heightfields, pictures, JSON.
#include "filigree/jobs/grids.h"

#include "filigree/grid/decode_grids.h"
#include "filigree/grid/shapes.h"
#include "filigree/io/fil_grids.h"

#include "grid/sample_grids.h"
#include "io/temp_folder.h"
#include "jobs/colour_ramp.h"
#include "jobs/grid_error_map.h"
#include "jobs/grid_lattice.h"
#include "jobs/grid_views.h"
#include "shared_data.h"

#include <cstdlib>
#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

namespace filigree::jobs {
namespace {

using tests::TempFolder;

// What the issue allows, bytes a triangle in all.
struct Budget {
    const char* file;
    const char* codec;
    bool lossless;
    double bytes;
    bool isLong;  // with FILIGREE_FULL alone
};

class GridBudgets : public ::testing::TestWithParam<Budget> {};
INSTANTIATE_TEST_SUITE_P(
    Grids, GridBudgets,
    ::testing::Values(Budget{"0ad_thessalian_plains_513.png", "lattice", true, 0.45, false},
                      Budget{"0ad_thessalian_plains_513.png", "paper", false, 4.7, false},
                      Budget{"vulkan_terrain_1024.png", "lattice", true, 0.45, true},
                      Budget{"srtm_N51W001_1201.png", "lattice", true, 0.45, true},
                      Budget{"0ad_eire_and_albion_993.png", "lattice", true, 0.45, true},
                      Budget{"teddybear_cc2.ply", "lattice", false, 1.6, false},
                      Budget{"concept_sedan.glb", "lattice", false, 5.0, false},
                      Budget{"peterbilt_truck.glb", "lattice", false, 5.0, true},
                      Budget{"japanese_maple.glb", "lattice", false, 5.0, true}));

TEST_P(GridBudgets, AreKept) {
    FILIGREE_NEEDS_SHARED_DATA();
    const Budget& budget = GetParam();
    if (budget.isLong && std::getenv("FILIGREE_FULL") == nullptr) {
        GTEST_SKIP() << "with FILIGREE_FULL";
    }
    const TempFolder folder;
    GridsOptions options;
    options.input = tests::sharedData() / "data/meshes" / budget.file;
    options.output = folder / "x.fil";
    options.codec = budget.codec;
    options.precision.lossless = budget.lossless;
    const auto summary = grids(options, serialExecutor(), silentProgress());
    ASSERT_TRUE(summary) << summary.error().message;
    EXPECT_LE(summary->bytesPerTriangle(), budget.bytes);
    EXPECT_EQ(summary->errors.all.max == 0, budget.lossless);
    const auto file = io::readFilGrids(options.output);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->triangleCount(), summary->statistics.triangles);
    EXPECT_EQ(grid::bytesOf(file->grids).total(), summary->bytes.total());
    if (std::string(budget.file) != "teddybear_cc2.ply") return;
    EXPECT_GE(summary->statistics.shareAtLeast(4), 0.95);
}

TEST(Grids, MatchTheErrorOfThePaper) {
    for (const grid::GridMesh& mesh : {grid::torus(129, serialExecutor()), grid::tests::mixedBox(32)}) {
        GridPrecision precision;
        precision.matchPaper = true;
        const auto chosen =
            chooseLattice(mesh, precision, grid::DisplacementCode::unitVector, serialExecutor());
        ASSERT_TRUE(chosen);
        grid::GridMesh encoding = mesh;
        grid::EncodeOptions options;
        options.lattice = chosen->lattice;
        const auto encoded = grid::tests::encoded(encoding, options);
        const auto decoded = grid::decodeGrids(
            encoded, mesh.grids, static_cast<uint32_t>(mesh.looseTriangles.size()), serialExecutor());
        const double rms = grid::errorsOf(encoding, decoded, serialExecutor()).grids.rms;
        EXPECT_LE(rms, *chosen->paperRms * 1.0001);
        EXPECT_GE(rms, *chosen->paperRms * 0.98);
    }
}

TEST(Grids, TakeTheUsualErrorWhereThePaperHasNone) {
    grid::GridMesh mesh;
    mesh.looseVertices = {{0, 0, 0}, {3, 0, 0.1F}, {0.3F, 4, 0}};
    mesh.looseTriangles = {{0, 1, 2}};
    const auto chosen = chooseLattice(mesh, {}, grid::DisplacementCode::unitVector, serialExecutor());
    ASSERT_TRUE(chosen);
    EXPECT_NEAR(*chosen->paperRms, usualPaperRms * 5, 1e-6);
}

TEST(GridErrorMap, ShowsEachSubGrid) {
    grid::GridMesh mesh = grid::box(40, serialExecutor());
    const auto encoded = grid::tests::encoded(mesh, grid::tests::optionsFor(mesh, grid::Codec::paper));
    const auto decoded = grid::decodeGrids(encoded, mesh.grids, 0, serialExecutor());
    const Canvas map = gridErrorMap(mesh, decoded, grid::Codec::paper);
    EXPECT_GT(map.width(), 40u);
    EXPECT_TRUE(map.png());
    // Without grids there is still a picture.
    EXPECT_TRUE(gridErrorMap({}, {}, grid::Codec::lattice).png());
}

TEST(GridViews, ShowGridsAndTheirErrors) {
    grid::GridMesh mesh = grid::tests::mixedBox(24);
    const auto encoded = grid::tests::encoded(mesh, grid::tests::optionsFor(mesh, grid::Codec::paper));
    const auto decoded = grid::decodeGrids(
        encoded, mesh.grids, static_cast<uint32_t>(mesh.looseTriangles.size()), serialExecutor());
    const grid::GridAttributes attributes = grid::attributesOf(mesh);
    const auto views =
        drawGridViews({mesh, encoded, decoded, attributes}, 64, 36, serialExecutor(), silentProgress());
    ASSERT_TRUE(views) << views.error().message;
    for (const auto* picture : {&views->lit, &views->pieces, &views->error})
        EXPECT_EQ(picture->rgba.size(), 4u * 64 * 36);
    EXPECT_NE(views->pieces.rgba, views->error.rgba);
    EXPECT_EQ(views->scale.marks.size(), 5u);
    // The sky is the same in both.
    EXPECT_EQ(std::vector(views->pieces.rgba.begin(), views->pieces.rgba.begin() + 4),
              std::vector(views->error.rgba.begin(), views->error.rgba.begin() + 4));
}

TEST(ColourRamp, EndsAtRoundNumbers) {
    EXPECT_DOUBLE_EQ(rampEnd(3), 4);
    EXPECT_DOUBLE_EQ(rampEnd(0.05), 0.08);
    EXPECT_DOUBLE_EQ(rampEnd(9), 10);
    EXPECT_DOUBLE_EQ(rampEnd(0), 1);
    EXPECT_DOUBLE_EQ(rampPlace(1, 4), 0.5);
    EXPECT_DOUBLE_EQ(rampPlace(9, 4), 1);
    EXPECT_EQ(rampScale(heatRamp(), "tests", 16, "").marks[3].text, "9");
}

// Attributes come back at hits as they were at the vertices.
TEST(GridAttributes, AreInterpolatedAtHits) {
    grid::GridMesh mesh = grid::tests::mixedBox(12);
    mesh.normals = mesh.vertices;  // any values will do
    mesh.looseNormals = mesh.looseVertices;
    mesh.quadSources.resize(mesh.quadCount());
    for (uint32_t q = 0; q < mesh.quadSources.size(); ++q) mesh.quadSources[q] = {7 * q, 7 * q + 1};
    const auto encoded = grid::tests::encoded(mesh, grid::tests::optionsFor(mesh, grid::Codec::lattice));
    const grid::GridAttributes attributes = grid::attributesOf(mesh);
    grid::Tracer tracer(encoded);
    unsigned loose = 0;
    for (int k = 0; k < 400; ++k) {
        grid::Ray ray;
        const double turn = k * 2.399963;
        const double height = 1.2 - 2.4 * (k + 0.5) / 400;
        ray.direction = {static_cast<float>(std::cos(turn)), static_cast<float>(height),
                         static_cast<float>(std::sin(turn))};
        const grid::Hit hit = tracer.closest(ray);
        ASSERT_NE(hit.grid, grid::noGrid);
        const grid::SurfacePoint point = surfaceAt(attributes, mesh.grids, hit);
        ASSERT_TRUE(point.normal && point.source);
        const Vec3 off = minus(*point.normal, plus(ray.origin, times(ray.direction, hit.t)));
        EXPECT_LT(std::sqrt(dot(off, off)), 0.01);
        loose += hit.grid == grid::looseGrid ? 1 : 0;
        if (hit.grid != grid::looseGrid) {
            const uint64_t quad = mesh.grids[hit.grid].firstQuad +
                                  uint64_t{hit.row} * (mesh.grids[hit.grid].columns - 1) + hit.column;
            EXPECT_EQ(*point.source, 7 * quad + hit.half);
        }
    }
    EXPECT_GT(loose, 10u);
}

}  // namespace
}  // namespace filigree::jobs
