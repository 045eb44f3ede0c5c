#include "filigree/jobs/inspect.h"

#include "filigree/core/file.h"
#include "filigree/io/image_file.h"
#include "filigree/jobs/bake.h"

#include "io/temp_folder.h"
#include "jobs/command_words.h"
#include "jobs/demo_bytes.h"
#include "jobs/inspection.h"
#include "jobs/small_scene.h"

#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::jobs {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::Pair;
using tests::masked;
using tests::sceneOf;
using tests::TempFolder;

scene::Scene baked(std::vector<scene::Material> materials, unsigned level) {
    scene::Scene scene = sceneOf(std::move(materials));
    BakeParameters parameters;
    parameters.level = level;
    EXPECT_TRUE(bakeScene(scene, parameters, serialExecutor(), silentProgress()).ok());
    return scene;
}

Inspection inspected(const scene::Scene& scene, const TempFolder& folder) {
    auto inspection =
        inspectScene(scene, folder.path(), "filigree inspect", {}, serialExecutor(), silentProgress());
    EXPECT_TRUE(inspection.ok()) << inspection.error().message;
    return inspection.ok() ? std::move(*inspection) : Inspection{};
}

TEST(Inspect, countsWhatTheTrianglesUse) {
    const TempFolder folder;
    const auto inspection = inspected(baked({masked(0), masked(0)}, 4), folder);
    ASSERT_EQ(inspection.summary.textures.size(), 1U) << "equal materials are one texture";
    const InspectedTexture& t = inspection.summary.textures[0];
    EXPECT_EQ(t.name, "halves");
    EXPECT_EQ(t.width, 16U);
    EXPECT_EQ(t.triangles, 4U);
    EXPECT_EQ(t.distinctTriangles, 2U);
    EXPECT_EQ(t.drawnTriangles, 2U);
    EXPECT_EQ(t.micromaps, 2U);
    EXPECT_EQ(t.bytes, 2 * (64U + 8U));
    EXPECT_THAT(t.levels, ElementsAre(Pair(4, 2)));
    EXPECT_THAT(t.sharing, ElementsAre(Pair(2, 2)));
    EXPECT_EQ(std::accumulate(t.states.begin(), t.states.end(), uint64_t{0}), 4U * 256);
    EXPECT_NEAR(std::accumulate(t.area.begin(), t.area.end(), 0.0), 2.0 * 16 * 16, 1e-9);
    const auto shares = t.areaShares();
    EXPECT_NEAR(shares[0], shares[1], 0.05) << "half of the texture is opaque";
    EXPECT_GT(shares[0], 0.3);
}

TEST(Inspect, specialIndicesCountAsWholeTriangles) {
    const TempFolder folder;
    scene::Scene scene = sceneOf({masked(0)});
    for (mesh::Uv& uv : scene.meshes[0].primitives[0].uvs) uv.u = 0.15F + 0.1F * uv.u;
    ASSERT_TRUE(bakeScene(scene, {}, serialExecutor(), silentProgress()).ok());
    const auto inspection = inspected(scene, folder);
    const InspectedTexture& t = inspection.summary.textures[0];
    EXPECT_THAT(t.special, ElementsAre(0, 2, 0, 0));
    EXPECT_THAT(t.states, ElementsAre(0, 2, 0, 0));
    EXPECT_THAT(t.levels, IsEmpty());
    EXPECT_DOUBLE_EQ(t.areaShares()[1], 1);
}

TEST(Inspect, writesEveryPictureItNames) {
    const TempFolder folder;
    const auto inspection = inspected(baked({masked(0)}, 3), folder);
    EXPECT_EQ(inspection.summary.pictures.size(), 5U) << "an overlay and four charts";
    for (const auto& picture : inspection.summary.pictures) {
        const auto bytes = readFile(folder.path() / picture);
        ASSERT_TRUE(bytes.ok()) << picture;
        EXPECT_TRUE(io::decodePng(*bytes).ok()) << picture;
    }
}

TEST(Inspect, oneImageUnderTwoCutoffsIsTwoTextures) {
    const TempFolder folder;
    scene::Material strict = masked(0);
    strict.cutoff = 0.9;
    const auto inspection = inspected(baked({masked(0), strict}, 2), folder);
    ASSERT_EQ(inspection.summary.textures.size(), 2U);
    EXPECT_NE(inspection.summary.textures[0].name, inspection.summary.textures[1].name);
    EXPECT_NE(inspection.summary.textures[0].picture, inspection.summary.textures[1].picture);
}

TEST(Inspect, namesFromTheFileCannotLeaveTheFolderOrThePage) {
    const TempFolder folder;
    scene::Scene scene = baked({masked(0)}, 2);
    scene.images[0].name = "../../<script>alert(1)</script>/\xFF";
    const auto inspection = inspected(scene, folder);
    EXPECT_EQ(inspection.summary.textures[0].picture.string().find('/'), std::string::npos);
    report::Page page;
    page.sections = inspection.sections;
    EXPECT_THAT(report::toHtml(page), Not(HasSubstr("<script>alert")));
    EXPECT_TRUE(nlohmann::json::accept(toJson(inspection.summary)));
}

TEST(Inspect, micromapsOnAnOpaqueMaterialAreNoted) {
    const TempFolder folder;
    scene::Scene scene = baked({masked(0)}, 2);
    scene.materials[0].alphaMode = scene::AlphaMode::opaque;
    const auto inspection = inspected(scene, folder);
    EXPECT_THAT(inspection.summary.textures, IsEmpty());
    EXPECT_THAT(inspection.summary.notes, ElementsAre(HasSubstr("no alpha")));
}

TEST(Inspect, sameSceneSamePictures) {
    const TempFolder a;
    const TempFolder b;
    const scene::Scene scene = baked({masked(0)}, 5);
    const auto threads = makeThreadedExecutor(3);
    const auto first = inspected(scene, a);
    ASSERT_TRUE(inspectScene(scene, b.path(), "filigree inspect", {}, *threads, silentProgress()).ok());
    for (const auto& picture : first.summary.pictures) {
        EXPECT_EQ(*readFile(a.path() / picture), *readFile(b.path() / picture)) << picture;
    }
}

TEST(Inspect, filesWithoutMicromapsAreBakedInMemory) {
    const TempFolder folder;
    ASSERT_TRUE(writeFile(folder / "a scene.glb", tests::demoBytes()).ok());
    InspectOptions options;
    options.input = folder / "a scene.glb";
    options.outputFolder = folder / "new/deep";
    options.parameters.level = 2;
    const auto summary = inspect(options, serialExecutor(), silentProgress());
    ASSERT_TRUE(summary.ok()) << summary.error().message;
    EXPECT_TRUE(summary->bakedInMemory);
    EXPECT_EQ(summary->textures.size(), 5U);
    const auto page = readFile(summary->page);
    ASSERT_TRUE(page.ok());
    const std::string html(page->begin(), page->end());
    EXPECT_THAT(html, HasSubstr("--level 2")) << "the figures' command makes them again";
    EXPECT_THAT(html, HasSubstr("&#39;" + (folder / "a scene.glb").string() + "&#39;"));
    EXPECT_TRUE(nlohmann::json::accept(toJson(*summary)));
}

TEST(Inspect, badPathsAreOneLine) {
    const TempFolder folder;
    InspectOptions options;
    options.input = folder / "none.glb";
    options.outputFolder = folder / "out";
    auto summary = inspect(options, serialExecutor(), silentProgress());
    ASSERT_FALSE(summary.ok());
    EXPECT_EQ(summary.error().kind, ErrorKind::file);
    EXPECT_FALSE(std::filesystem::exists(options.outputFolder)) << "nothing is left of a failed run";

    ASSERT_TRUE(writeFile(folder / "scene.glb", tests::demoBytes()).ok());
    ASSERT_TRUE(writeFile(folder / "taken", "a file").ok());
    options.input = folder / "scene.glb";
    options.outputFolder = folder / "taken";
    options.parameters.level = 0;
    summary = inspect(options, serialExecutor(), silentProgress());
    ASSERT_FALSE(summary.ok());
    EXPECT_THAT(summary.error().message, HasSubstr("taken"));
}

TEST(ShellCommand, quotesWhatAShellWouldSplit) {
    const std::vector<std::string> words = {"filigree", "it's here.glb", "-o", "out/a", ""};
    EXPECT_EQ(shellCommand(words), "filigree 'it'\\''s here.glb' -o out/a ''");
}

}  // namespace
}  // namespace filigree::jobs
