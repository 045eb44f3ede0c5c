// Compressed grids in a world look as their triangles do under Embree, alone and among surfaces with holes.
#include "filigree/grid/encode_grids.h"
#include "filigree/grid/error.h"
#include "filigree/grid/lattice_choice.h"
#include "filigree/grid/shapes.h"

#include "grid/triangles_of.h"
#include "jobs/psnr.h"
#include "trace/thicket.h"

#include <gmock/gmock.h>

namespace filigree {
namespace {

using grid::Codec;
using trace::Integrator;
using trace::Method;

// A displaced box of half its size, and a loose triangle behind it.
grid::GridMesh smallBox() {
    grid::GridMesh mesh = grid::box(20, serialExecutor());
    for (Vec3& v : mesh.vertices) v = plus(times(v, 0.5F), {0.3F, -0.4F, 0.2F});
    mesh.looseVertices = {{-2, -1, -1.5F}, {2, -1, -1.5F}, {0, 1.5F, -1.8F}};
    mesh.looseTriangles = {{0, 1, 2}};
    return mesh;
}

scene::Mesh trianglesOf(const grid::GridMesh& mesh) {
    scene::Primitive primitive;
    forEachTriangle(mesh, [&](const std::array<Vec3, 3>& corners) {
        for (const Vec3& corner : corners) {
            primitive.indices.push_back(static_cast<uint32_t>(primitive.positions.size()));
            primitive.positions.push_back(corner);
        }
    });
    return {"triangles", {primitive}};
}

void addTriangles(const grid::GridMesh& mesh, scene::Scene& scene) {
    scene.instances.push_back({static_cast<unsigned>(scene.meshes.size())});
    scene.meshes.push_back(trianglesOf(mesh));
}

grid::EncodedGrids encoded(grid::GridMesh& mesh, Codec codec) {
    grid::EncodeOptions options;
    options.codec = codec;
    const auto lattice = grid::latticeForError(mesh, 1e-6 * grid::boundsOf(mesh).diagonal());
    EXPECT_TRUE(lattice.ok());
    options.lattice = *lattice;
    auto grids = grid::encodeGrids(mesh, options, serialExecutor(), silentProgress());
    EXPECT_TRUE(grids.ok());
    return std::move(*grids);
}

// In the colour of surfaces without material.
trace::WorldOptions worldWith(const grid::EncodedGrids& grids, const grid::GridMesh& mesh) {
    trace::WorldOptions options;
    options.grids.grids = &grids;
    options.grids.table = mesh.grids;
    options.grids.triangles = mesh.triangleCount();
    options.grids.albedo = [](const grid::Hit&) { return Vec3{0.6F, 0.6F, 0.6F}; };
    return options;
}

class GridWorld : public testing::TestWithParam<Codec> {
  protected:
    static trace::RenderSettings settings(Integrator integrator) {
        trace::RenderSettings s = tests::settingsFor(integrator, 96, 64);
        s.camera = trace::lookAt({0.4F, 0.5F, 3.4F}, {0.1F, -0.1F, 0}, {0, 1, 0}, 0.9F);
        return s;
    }
    static trace::Film filmOf(scene::Scene& scene, const trace::World& world, Method method,
                              Integrator integrator) {
        if (method == Method::texture) {
            const auto texture = trace::Opacity::make(method, 4, world, {}, {});
            return tests::filmOf(world, *texture, settings(integrator), 4);
        }
        const auto input = tests::inputFor(scene, world, method, 4, 4);
        EXPECT_TRUE(input.ok());
        return tests::filmOf(world, *input->opacity, settings(integrator), 4);
    }
    // Both pictures with all integrators.
    void expectAlike(scene::Scene& withGrids, const trace::World& gridWorld, scene::Scene& plain,
                     const trace::World& plainWorld, Method method) {
        for (const Integrator integrator : tests::integrators) {
            const auto grids = filmOf(withGrids, gridWorld, method, integrator);
            const auto triangles = filmOf(plain, plainWorld, method, integrator);
            EXPECT_GT(jobs::psnr(developed(grids), developed(triangles)), 40.0) << nameOf(integrator);
            EXPECT_NEAR(static_cast<double>(grids.pixelsHit), static_cast<double>(triangles.pixelsHit), 2);
        }
    }

    grid::GridMesh mesh_ = smallBox();
    grid::EncodedGrids grids_ = encoded(mesh_, GetParam());
};

TEST_P(GridWorld, LooksAsItsTrianglesDo) {
    scene::Scene empty;
    scene::Scene plain;
    addTriangles(mesh_, plain);
    const auto gridWorld = trace::World::build(empty, worldWith(grids_, mesh_));
    const auto plainWorld = trace::World::build(plain, {});
    ASSERT_TRUE(gridWorld.ok() && plainWorld.ok());
    EXPECT_EQ(gridWorld->triangleCount(), plainWorld->triangleCount());
    expectAlike(empty, *gridWorld, plain, *plainWorld, Method::texture);
}

TEST_P(GridWorld, StandsAmongSurfacesWithHoles) {
    scene::Scene thicket = tests::thicket();
    scene::Scene plain = tests::thicket();
    addTriangles(mesh_, plain);
    const auto gridWorld = trace::World::build(thicket, worldWith(grids_, mesh_));
    const auto plainWorld = trace::World::build(plain, {});
    ASSERT_TRUE(gridWorld.ok() && plainWorld.ok());
    expectAlike(thicket, *gridWorld, plain, *plainWorld, Method::texture);
    expectAlike(thicket, *gridWorld, plain, *plainWorld, Method::sdag);
}

TEST_P(GridWorld, KnowsItsBoundsAndBytes) {
    const scene::Scene empty;
    const auto world = trace::World::build(empty, worldWith(grids_, mesh_));
    ASSERT_TRUE(world.ok());
    const Box box = world->bounds();
    const Box exact = grid::boundsOf(mesh_);
    for (size_t k = 0; k < 3; ++k) {
        EXPECT_LE(box.low[k], exact.low[k] + 1e-4F);
        EXPECT_GE(box.high[k], exact.high[k] - 1e-4F);
    }
    EXPECT_LT(box.diagonal(), 1.05F * exact.diagonal());
    EXPECT_EQ(world->bytes().geometry + world->bytes().bvh, bytesOf(grids_).total());
}

TEST_P(GridWorld, IsSeenByTheOverview) {
    const scene::Scene empty;
    const auto world = trace::World::build(empty, worldWith(grids_, mesh_));
    ASSERT_TRUE(world.ok());
    const auto opacity = trace::Opacity::make(Method::texture, 4, *world, {}, {});
    trace::RenderSettings s = settings(Integrator::primary);
    s.camera = trace::overview(*world);
    EXPECT_GT(tests::filmOf(*world, *opacity, s, 1).pixelsHit, 96u * 64 / 10);
}

INSTANTIATE_TEST_SUITE_P(Codecs, GridWorld, testing::Values(Codec::paper, Codec::lattice),
                         [](const auto& of) { return std::string(nameOf(of.param)); });

TEST(GridColours, FollowTheFunction) {
    grid::GridMesh mesh = smallBox();
    const grid::EncodedGrids grids = encoded(mesh, Codec::lattice);
    trace::WorldOptions options = worldWith(grids, mesh);
    options.grids.albedo = [](const grid::Hit& hit) {
        return hit.grid == grid::looseGrid ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
    };
    const scene::Scene empty;
    const auto world = trace::World::build(empty, options);
    ASSERT_TRUE(world.ok());
    const auto opacity = trace::Opacity::make(Method::texture, 4, *world, {}, {});
    trace::RenderSettings s = tests::settingsFor(Integrator::primary, 48, 32);
    s.camera = trace::lookAt({0, 0.3F, 3.4F}, {0.1F, -0.1F, 0}, {0, 1, 0}, 0.9F);
    const auto picture = developed(tests::filmOf(*world, *opacity, s, 1));
    size_t red = 0;
    size_t blue = 0;
    for (size_t k = 0; k < picture.rgba.size(); k += 4) {
        red += picture.rgba[k] > 0 && picture.rgba[k + 2] == 0 ? 1 : 0;
        blue += picture.rgba[k] == 0 && picture.rgba[k + 2] > 0 ? 1 : 0;
    }
    EXPECT_GT(red, 50u);
    EXPECT_GT(blue, 50u);
}

TEST(OpaqueSurfaces, AreLeftOutOnRequest) {
    const scene::Scene thicket = tests::thicket();
    trace::WorldOptions options;
    options.opaque = false;
    const auto all = trace::World::build(thicket, {});
    const auto tested = trace::World::build(thicket, options);
    ASSERT_TRUE(all.ok() && tested.ok());
    EXPECT_EQ(tested->triangleCount() + 2, all->triangleCount());
    for (size_t k = 0; k < tested->surfaceCount(); ++k) EXPECT_TRUE(tested->isTested(k));
}

}  // namespace
}  // namespace filigree
