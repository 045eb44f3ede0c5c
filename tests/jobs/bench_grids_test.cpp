#include "filigree/jobs/bench_grids.h"

#include "filigree/grid/shapes.h"

#include "jobs/grid_leaks.h"
#include "jobs/grid_methods.h"
#include "jobs/grid_race.h"

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include <gmock/gmock.h>

namespace filigree::jobs {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::unique_ptr<GridMethod> methodFor(std::string_view name, GridScene& scene) {
    auto method = makeGridMethod(name, scene, serialExecutor());
    EXPECT_TRUE(method.ok()) << method.error().message;
    return std::move(*method);
}

TEST(GridMethods, AgreeOnWhatRaysMeet) {
    GridScene scene{"terrain", grid::terrain(65, serialExecutor()), {}, {}};
    const Box bounds{{0, -1, 0}, {1, 1, 1}};
    const auto reference =
        trace::EmbreeGrids::build(scene.mesh, trace::EmbreeLayout::triangles, {.robust = true, .threads = 1});
    ASSERT_TRUE(reference.ok());
    trace::GridRayOptions options;
    options.width = options.height = 48;
    const auto rays = gridRaySets(*reference, bounds, trace::overviewOf(bounds, 1), options);
    ASSERT_GT(rays.bounce.size(), 100u);
    EXPECT_EQ(rays.bounce.size(), rays.ao.size());
    EXPECT_EQ(rays.bounce.size(), rays.shuffled.size());
    std::vector<float> expected(rays.primary.size());
    methodFor("triangles-robust", scene)->closest(rays.primary, false, expected);
    for (const std::string_view name : gridMethodNames()) {
        const auto method = methodFor(name, scene);
        EXPECT_GT(method->bytes(), 0u);
        for (const bool batched : {false, true}) {
            std::vector<float> distances(rays.primary.size());
            method->closest(rays.primary, batched, distances);
            size_t different = 0;
            for (size_t k = 0; k < distances.size(); ++k)
                different += std::isfinite(distances[k]) != std::isfinite(expected[k]) ||
                                     std::fabs(distances[k] - expected[k]) > 1e-3F
                                 ? 1
                                 : 0;
            EXPECT_LE(different, distances.size() / 200) << name;
        }
    }
}

TEST(GridMethods, HaveASpeedEach) {
    GridScene scene{"torus", grid::torus(65, serialExecutor()), {}, {}};
    const auto stock = methodFor("triangles", scene);
    const auto lattice = methodFor("lattice", scene);
    const std::array<GridMethod*, 2> methods{stock.get(), lattice.get()};
    trace::GridRaySets rays;
    rays.primary = {{{0, 5, 0}, {0.2F, -1, 0}}, {{0, 5, 0}, {1, 0, 0}}};
    rays.ao = rays.primary;
    const auto speeds = raceGrids(methods, rays, 3, silentProgress());
    ASSERT_TRUE(speeds.ok());
    ASSERT_EQ(speeds->size(), 2u);
    for (const GridSpeeds& speed : *speeds) {
        EXPECT_EQ(speed[0].hits, 1u);
        EXPECT_EQ(speed[2].hits, 1u);
        EXPECT_GT(speed[0].mraysPerSecond, 0);
        EXPECT_GT(speed[0].ratioToBatches, 0);
        EXPECT_EQ(speed[1].mraysPerSecond, 0) << "there were no rays";
    }
    EXPECT_EQ(speeds->front()[0].ratio, 1);
}

// 10^6 rays; the bench casts more.
TEST(GridLeaks, LatticeHasNone) {
    struct Closed {
        GridScene scene;
        PointBehind behind;
    };
    std::array<Closed, 2> shapes{{{{"torus", grid::torus(129, serialExecutor()), {}, {}}, behindTorus},
                                  {{"box", grid::box(43, serialExecutor()), {}, {}}, behindBox}}};
    for (Closed& shape : shapes) {
        const auto method = methodFor("lattice", shape.scene);
        const auto leaks = countLeaks(*method, method->surface(serialExecutor()), shape.behind, 500'000);
        EXPECT_EQ(leaks.rays, 500'000u);
        EXPECT_EQ(leaks.misses, 0u) << shape.scene.name;
    }
}

// Without the last grid there is a hole: the test must see it.
TEST(GridLeaks, AreSeen) {
    GridScene scene{"box", grid::box(20, serialExecutor()), {}, {}};
    const grid::GridMesh whole = scene.mesh;
    scene.mesh.grids.pop_back();
    scene.mesh.vertices.resize(scene.mesh.grids.back().firstVertex + scene.mesh.grids.back().vertexCount());
    scene.mesh.diagonals.resize(scene.mesh.quadCount());
    const auto method = methodFor("lattice", scene);
    EXPECT_GT(countLeaks(*method, whole, behindBox, 10'000).misses, 1000u);
}

BenchGridsOptions smallBench() {
    BenchGridsOptions options;
    options.scenes = {"torus"};
    options.sizes = {65};
    options.width = options.height = 40;
    options.rounds = 1;
    options.leakRays = 2000;
    options.leakSize = 33;
    return options;
}

TEST(BenchGrids, HasARowForEachMethod) {
    const auto summary = benchGrids(smallBench(), serialExecutor(), silentProgress());
    ASSERT_TRUE(summary.ok()) << summary.error().message;
    std::vector<std::string> names;
    std::map<std::string, double> bytes;
    for (const BenchGridsRow& row : summary->rows) {
        names.push_back(row.method);
        bytes[row.method] = row.bytesPerTriangle;
        EXPECT_EQ(row.scene, "torus 65");
        EXPECT_EQ(row.triangles, 2u * 64 * 64);
        EXPECT_GT(row.primary.mraysPerSecond, 0);
        EXPECT_GT(row.shuffled.ratio, 0);
    }
    EXPECT_THAT(names, ElementsAre("triangles", "triangles-compact", "triangles-qbvh8", "grids",
                                   "grids-compact", "paper", "lattice"));
    EXPECT_LT(bytes["lattice"], bytes["paper"]);
    EXPECT_LT(bytes["paper"], bytes["grids-compact"]);
    EXPECT_LT(bytes["grids"], bytes["triangles"]);
    const auto json = nlohmann::json::parse(toJson(*summary));
    EXPECT_EQ(json["rows"].size(), 7u);
    EXPECT_EQ(json["leaks"]["rays"], 2000);
    EXPECT_EQ(json["leaks"]["misses"], 0);
}

TEST(BenchGrids, RacesOneByOneWhereMemoryIsShort) {
    BenchGridsOptions options = smallBench();
    options.memory = 1;
    options.methods = {"grids", "lattice"};
    options.leakRays = 0;
    const auto summary = benchGrids(options, serialExecutor(), silentProgress());
    ASSERT_TRUE(summary.ok());
    ASSERT_EQ(summary->rows.size(), 3u);
    EXPECT_EQ(summary->rows[0].method, "triangles");
    EXPECT_TRUE(summary->leaks.empty());
}

TEST(BenchGrids, SaysWhatItCannotDo) {
    const auto messageOf = [](auto change) {
        BenchGridsOptions options = smallBench();
        change(options);
        const auto summary = benchGrids(options, serialExecutor(), silentProgress());
        EXPECT_FALSE(summary.ok());
        EXPECT_EQ(summary.error().kind, ErrorKind::usage);
        return summary.error().message;
    };
    EXPECT_THAT(messageOf([](auto& o) { o.sizes = {3}; }), HasSubstr("--sizes 3"));
    EXPECT_THAT(messageOf([](auto& o) { o.methods = {"bvh"}; }), HasSubstr("--methods bvh"));
    EXPECT_THAT(messageOf([](auto& o) { o.rounds = 0; }), HasSubstr("--rounds"));
    EXPECT_THAT(messageOf([](auto& o) { o.leakSize = 2; }), HasSubstr("--leak-size 2"));
    EXPECT_THAT(messageOf([](auto& o) { o.scenes = {"hills.obj"}; }), HasSubstr("hills.obj"));
}

}  // namespace
}  // namespace filigree::jobs
