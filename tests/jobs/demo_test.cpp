#include "filigree/jobs/demo.h"

#include "filigree/core/file.h"
#include "filigree/io/gltf.h"
#include "filigree/io/gltf_rules.h"

#include "io/temp_folder.h"
#include "jobs/demo_scene.h"
#include "jobs/scene_view.h"

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

scene::Scene demoScene(bool colour) {
    const auto document = io::GltfDocument::parse(*makeDemoScene(), "", "demo");
    EXPECT_TRUE(document.ok()) << document.error().message;
    io::ReadOptions reading;
    reading.colour = colour;
    auto scene = io::readScene(*document, reading);
    EXPECT_TRUE(scene.ok()) << scene.error().message;
    return std::move(*scene);
}

TEST(DemoScene, isTheSameEveryTime) {
    const auto a = makeDemoScene();
    const auto b = makeDemoScene();
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_EQ(*a, *b);
    EXPECT_LT(a->size(), 3'000'000U);
}

TEST(DemoScene, keepsTheRules) {
    const auto document = io::GltfDocument::parse(*makeDemoScene(), "", "demo");
    ASSERT_TRUE(document.ok());
    EXPECT_THAT(io::checkRules(*document), IsEmpty());
}

TEST(DemoScene, everyCutOutHasBothSidesAndASmoothEdge) {
    const scene::Scene scene = demoScene(false);
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
    const scene::Scene scene = demoScene(false);
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

TEST(SceneView, seesSkyAboveAndFoliageInTheSun) {
    const scene::Scene scene = demoScene(true);
    const Canvas view = drawView(scene, scene.cameras[0], 150, 100, serialExecutor());
    const Colour sky = view.at(2, 2);
    EXPECT_GT(sky.b, sky.r);
    size_t green = 0;
    for (uint32_t y = 0; y < 100; ++y) {
        for (uint32_t x = 0; x < 150; ++x) {
            const Colour c = view.at(x, y);
            green += c.g > c.r + 20 && c.g > c.b + 20 ? 1 : 0;
        }
    }
    EXPECT_GT(green, 1000U);
    const auto threads = makeThreadedExecutor(3);
    const Canvas again = drawView(scene, scene.cameras[0], 150, 100, *threads);
    for (uint32_t i = 0; i < 150 * 100; ++i) ASSERT_EQ(view.at(i % 150, i / 150), again.at(i % 150, i / 150));
}

TEST(SceneView, cutsWhatLiesBehindTheCamera) {
    const scene::Scene scene = demoScene(true);
    scene::Camera inside = scene.cameras[0];
    inside.transform[12] = -3.2F;  // in the crown of a tree
    inside.transform[13] = 3.0F;
    inside.transform[14] = -2.6F;
    EXPECT_TRUE(drawView(scene, inside, 60, 40, serialExecutor()).png().ok());
}

TEST(Demo, leavesAProvedScenePageAndPictures) {
    const TempFolder folder;
    DemoOptions options;
    options.outputFolder = folder / "out/demo";
    options.parameters.level = 4;
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
