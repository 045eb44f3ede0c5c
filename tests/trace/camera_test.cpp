#include "trace/camera.h"

#include "trace/thicket.h"

#include <limits>

namespace filigree {
namespace {

void expectNear(const Vec3& a, const Vec3& b) {
    for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 1e-5);
}

TEST(Camera, LooksThroughThePicturesMiddleAndEdges) {
    const float fov = 0.9F;
    const scene::Camera camera = trace::lookAt({1, 2, 3}, {1, 2, -5}, {0, 1, 0}, fov);
    const trace::CameraRays rays(camera, 200, 100);
    expectNear(rays.origin(), {1, 2, 3});
    expectNear(rays.through(100, 50), {0, 0, -1});
    const float slope = std::tan(fov / 2);
    expectNear(rays.through(100, 0), normalised({0, slope, -1}));
    expectNear(rays.through(200, 50), normalised({2 * slope, 0, -1}));
}

TEST(Camera, StandsWhereUpIsAlongTheView) {
    for (const Vec3& up : {Vec3{0, 0, 1}, Vec3{0, 0, 0}}) {
        const scene::Camera camera = trace::lookAt({0, 0, 4}, {0, 0, 0}, up, 1);
        expectNear(trace::CameraRays(camera, 2, 2).through(1, 1), {0, 0, -1});
    }
}

TEST(Camera, IsCheckedBeforeItRenders) {
    trace::RenderSettings settings;
    settings.camera = trace::lookAt({0, 0, 1}, {0, 0, 0}, {0, 1, 0}, 1);
    EXPECT_TRUE(check(settings).ok());
    settings.camera.transform[12] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(check(settings).ok());
    settings.camera.transform[12] = 0;
    for (const float fov : {0.0F, -1.0F, 3.15F, std::numeric_limits<float>::quiet_NaN()}) {
        settings.camera.verticalFov = fov;
        EXPECT_FALSE(check(settings).ok()) << fov;
    }
    EXPECT_FALSE(trace::checkSize(0, 10).ok());
    EXPECT_FALSE(trace::checkSize(10, trace::maxPictureSide + 1).ok());
}

// Where a point of the world falls in a picture, in shares of it.
std::pair<float, float> seenAt(const scene::Camera& camera, float aspect, const Vec3& point) {
    const auto& m = camera.transform;
    const Vec3 to = minus(point, {m[12], m[13], m[14]});
    const float depth = -dot(to, {m[8], m[9], m[10]});
    const float slope = std::tan(camera.verticalFov / 2) * depth;
    return {dot(to, {m[0], m[1], m[2]}) / (slope * aspect), dot(to, {m[4], m[5], m[6]}) / slope};
}

TEST(Camera, OverviewShowsAllOfASceneFromOutside) {
    const scene::Scene scene = tests::thicket();
    const auto world = trace::World::build(scene, {});
    const Box box = world->bounds();
    for (const float aspect : {0.3F, 1.0F, 3.0F}) {
        const scene::Camera camera = trace::overview(*world, aspect);
        for (unsigned k = 0; k < 8; ++k) {
            const auto [x, y] = seenAt(camera, aspect, box.corner(k));
            EXPECT_LE(std::fabs(x), 1.0001F);
            EXPECT_LE(std::fabs(y), 1.0001F);
        }
    }
}

// A closed box around the thicket.
TEST(Camera, OverviewGoesInsideWhereNoHoleShowsOutside) {
    scene::Scene scene = tests::thicket();
    scene::Primitive walls;
    for (unsigned k = 0; k < 8; ++k) {
        walls.positions.push_back(
            {(k & 1) != 0 ? 10.0F : -10.0F, (k & 2) != 0 ? 6.0F : -1.5F, (k & 4) != 0 ? 10.0F : -10.0F});
    }
    walls.indices = {0, 1, 3, 0, 3, 2, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                     2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 3, 7, 1, 7, 5};
    scene.meshes.push_back({"walls", {walls}});
    scene.instances.push_back({2, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}});
    const auto world = trace::World::build(scene, {});
    const auto& eye = trace::overview(*world, 1.5F).transform;
    EXPECT_LT(std::fabs(eye[12]), 10);
    EXPECT_LT(std::fabs(eye[14]), 10);
}

}  // namespace
}  // namespace filigree
