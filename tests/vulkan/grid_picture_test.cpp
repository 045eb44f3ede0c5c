// Pictures of compressed grids by a device: those of the CPU but for edges.
#include "grid/sample_grids.h"
#include "jobs/device_picture.h"
#include "trace/thicket.h"
#include "vulkan/film_difference.h"
#include "vulkan/test_device.h"

#include <fmt/format.h>

namespace filigree {
namespace {

using trace::Integrator;
using trace::Method;

// Grids on the CPU and on a device, beside a scene or alone.
class VulkanGridPictures : public tests::VulkanTest {
  protected:
    static constexpr unsigned samples = 2;

    void SetUp() override {
        VulkanTest::SetUp();
        if (IsSkipped() || HasFatalFailure()) return;
        if (!device_->facts().tracesRays()) GTEST_SKIP() << "no Vulkan device was found that traces rays";
        paths_.push_back(vulkan::RayPath::query);
        if (device_->facts().rayPipeline) paths_.push_back(vulkan::RayPath::pipeline);
        if (!device_->facts().rayQuery) paths_.erase(paths_.begin());
        device_.reset();
    }
    void TearDown() override {
        onDevice_.reset();
        VulkanTest::TearDown();
    }

    void setGrids(grid::GridMesh mesh, grid::Codec codec = grid::Codec::lattice) {
        mesh_ = std::move(mesh);
        grids_ = grid::tests::encoded(mesh_, grid::tests::optionsFor(mesh_, codec));
        attributes_ = attributesOf(mesh_);
    }

    [[nodiscard]] trace::World world() const {
        trace::WorldOptions building;
        building.opaque = false;
        building.grids = {&grids_, mesh_.grids, mesh_.triangleCount(), &attributes_, {}};
        return std::move(*trace::World::build(scene_, building));
    }
    Status open(const trace::World& world, vulkan::RayPath path) {
        auto opened = jobs::DeviceScene::open(options(), nameOf(path), scene_, world,
                                              {false, {&grids_, mesh_.grids, &attributes_}});
        if (!opened) return opened.error();
        onDevice_.emplace(std::move(*opened));
        return {};
    }

    [[nodiscard]] static trace::RenderSettings settings(const trace::World& world, Integrator integrator) {
        trace::RenderSettings s = tests::settingsFor(integrator, 96, 64);
        s.camera = trace::overview(world, 1.5F);
        return s;
    }

    // All integrators on all paths.
    void expectPicturesOfTheCpu(Method method) {
        const trace::World made = world();
        jobs::OpacityInput input;
        input.opacity.emplace(std::move(*trace::Opacity::make(method, 4, made, {}, {})));
        for (const vulkan::RayPath path : paths_) {
            const Status opened = open(made, path);
            ASSERT_TRUE(opened.ok()) << opened.error().message;
            auto painter = onDevice_->prepare(input, {});
            ASSERT_TRUE(painter.ok()) << painter.error().message;
            for (const Integrator integrator : tests::integrators) {
                SCOPED_TRACE(fmt::format("{} {}", nameOf(path), nameOf(integrator)));
                const trace::RenderSettings s = settings(made, integrator);
                const trace::Film cpu = tests::filmOf(made, *input.opacity, s, samples);
                const auto film = onDevice_->render(*painter, s, samples, silentProgress());
                ASSERT_TRUE(film.ok()) << film.error().message;
                // Rays that graze edges may pass on either side.
                EXPECT_LE(tests::differing(*film, cpu), cpu.sums.size() / 1000);
                EXPECT_GT(film->pixelsHit, film->sums.size() / 8);
                EXPECT_NEAR(static_cast<double>(film->pixelsHit), static_cast<double>(cpu.pixelsHit), 4);
            }
        }
    }

    scene::Scene scene_;
    grid::GridMesh mesh_;
    grid::EncodedGrids grids_;
    grid::GridAttributes attributes_;
    std::vector<vulkan::RayPath> paths_;
    std::optional<jobs::DeviceScene> onDevice_;
};

// Up the vertices' distance from the box's middle.
void addNormals(grid::GridMesh& mesh) {
    mesh.normals = mesh.vertices;
    mesh.looseNormals = mesh.looseVertices;
}

TEST_F(VulkanGridPictures, WithNormalsAreThoseOfTheCpu) {
    grid::GridMesh mesh = grid::tests::mixedBox(21);
    addNormals(mesh);
    setGrids(std::move(mesh));
    expectPicturesOfTheCpu(Method::none);
}

TEST_F(VulkanGridPictures, AmongMaskedTrianglesAreThoseOfTheCpu) {
    scene_ = tests::thicket();
    for (auto& material : scene_.materials) {
        if (material.alphaMode == scene::AlphaMode::blend) material.alphaMode = scene::AlphaMode::mask;
    }
    setGrids(grid::tests::mixedBox(21));
    expectPicturesOfTheCpu(Method::texture);
}

TEST_F(VulkanGridPictures, SayWhatHasNoShader) {
    setGrids(grid::tests::mixedBox(9), grid::Codec::paper);
    const trace::World made = world();
    const Status opened = open(made, paths_.front());
    ASSERT_FALSE(opened.ok());
    EXPECT_EQ(opened.error().kind, ErrorKind::unsupported);
}

TEST_F(VulkanGridPictures, LeaveNothingBehind) {
    setGrids(grid::tests::mixedBox(9));
    const trace::World made = world();
    const auto device = vulkan::Device::open(options());
    for (unsigned k = 0; k < 3; ++k) {
        const auto placed =
            vulkan::RayScene::build(*device, scene_, {false, {&grids_, mesh_.grids, &attributes_}});
        ASSERT_TRUE(placed.ok()) << placed.error().message;
        EXPECT_GE(placed->bytes().gridWords, grids_.records.size());
        EXPECT_GT(placed->bytes().gridStructures, 24 * grids_.leafCount());
        EXPECT_GT(device->allocatedBytes(), 0u);
    }
    EXPECT_EQ(device->allocatedBytes(), 0u);
}

}  // namespace
}  // namespace filigree
