#include "filigree/jobs/demo.h"

#include "filigree/core/file.h"
#include "filigree/io/gltf.h"
#include "filigree/io/gltf_rules.h"

#include "io/temp_folder.h"
#include "jobs/demo_bytes.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::jobs {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using tests::TempFolder;

scene::Scene demoScene() {
    const auto document = io::GltfDocument::parse(tests::demoBytes(), "", "demo");
    EXPECT_TRUE(document.ok()) << document.error().message;
    auto scene = io::readScene(*document);
    EXPECT_TRUE(scene.ok()) << scene.error().message;
    return std::move(*scene);
}

TEST(DemoScene, isTheSameEveryTime) {
    const auto again = makeDemoScene();
    ASSERT_TRUE(again.ok());
    EXPECT_EQ(*again, tests::demoBytes());
    EXPECT_LT(again->size(), 3'000'000U);
}

TEST(DemoScene, keepsTheRules) {
    const auto document = io::GltfDocument::parse(tests::demoBytes(), "", "demo");
    ASSERT_TRUE(document.ok());
    EXPECT_THAT(io::checkRules(*document), IsEmpty());
}

TEST(DemoScene, everyCutOutHasBothSidesAndASmoothEdge) {
    const scene::Scene scene = demoScene();
    size_t cutOuts = 0;
    for (const auto& image : scene.images) {
        ASSERT_TRUE(image.alpha.has_value()) << image.name;
        const auto& texels = image.alpha->texels;
        EXPECT_EQ(*std::min_element(texels.begin(), texels.end()), 0) << image.name;
        EXPECT_EQ(*std::max_element(texels.begin(), texels.end()), 65535) << image.name;
        EXPECT_GT(std::set<uint16_t>(texels.begin(), texels.end()).size(), 30U) << image.name;
        ++cutOuts;
    }
    EXPECT_EQ(cutOuts, 5U);
}

TEST(DemoScene, holdsWhatTheDemoShows) {
    const scene::Scene scene = demoScene();
    EXPECT_EQ(scene.cameras.size(), 2U);
    EXPECT_GT(scene.instances.size(), 300U);
    EXPECT_THAT(scene.notes, IsEmpty());
    const auto isMask = [](const auto& m) { return m.alphaMode == scene::AlphaMode::mask; };
    EXPECT_EQ(std::count_if(scene.materials.begin(), scene.materials.end(), isMask), 5);
    float largest = 0;
    for (const auto& mesh : scene.meshes) {
        for (const auto& primitive : mesh.primitives) {
            for (const mesh::Uv& uv : primitive.uvs) largest = std::max(largest, std::max(uv.u, uv.v));
        }
    }
    EXPECT_GT(largest, 8) << "the fence repeats its texture";
}

TEST(Demo, leavesAProvedScenePageAndPictures) {
    const TempFolder folder;
    DemoOptions options;
    options.outputFolder = folder / "out/demo";
    options.parameters.level = 4;
    options.samples = 1;
    const auto threads = makeThreadedExecutor(0);
    const auto summary = demo(options, *threads, silentProgress());
    ASSERT_TRUE(summary.ok()) << summary.error().message;
    EXPECT_TRUE(summary->validation.valid());
    ASSERT_TRUE(summary->validation.deep.has_value());
    EXPECT_GT(summary->validation.deep->microTriangles, 0U);
    EXPECT_EQ(summary->validation.deep->wrong, 0U);
    EXPECT_GE(summary->inspection.pictures.size(), 10U);
    for (const auto& picture : summary->inspection.pictures) {
        EXPECT_TRUE(std::filesystem::exists(options.outputFolder / picture)) << picture;
    }
    ASSERT_EQ(summary->views.size(), 2U);
    ASSERT_TRUE(summary->views[0].triptych.has_value());
    EXPECT_TRUE(summary->views[0].triptych->identical);
    EXPECT_LT(summary->views[0].counters.total().textureFetches,
              summary->views[0].triptych->textureFetches / 2);
    EXPECT_EQ(summary->grids.statistics.triangles, 2U * 1024 * 1024);
    EXPECT_LT(summary->grids.bytesPerTriangle(), 1.0);
    ASSERT_TRUE(summary->terrainView.grids.has_value());
    EXPECT_EQ(summary->terrainView.grids->codec, "lattice");
    const auto page = readFile(summary->page);
    ASSERT_TRUE(page.ok());
    EXPECT_THAT(std::string(page->begin(), page->end()), HasSubstr("Bake and proof"));
    EXPECT_TRUE(nlohmann::json::accept(toJson(*summary)));
}

TEST(Demo, anUnusableFolderIsOneLine) {
    const TempFolder folder;
    ASSERT_TRUE(writeFile(folder / "taken", "a file").ok());
    DemoOptions options;
    options.outputFolder = folder / "taken/demo";
    const auto summary = demo(options, serialExecutor(), silentProgress());
    ASSERT_FALSE(summary.ok());
    EXPECT_EQ(summary.error().kind, ErrorKind::file);
    EXPECT_THAT(summary.error().message, HasSubstr("taken"));
}

}  // namespace
}  // namespace filigree::jobs
