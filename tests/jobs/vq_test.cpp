// The verb vq on textures made here, and the pairs of a small scene.
#include "filigree/jobs/vq.h"

#include "filigree/core/file.h"
#include "filigree/io/image_file.h"

#include "io/temp_folder.h"
#include "jobs/scene_pairs.h"
#include "jobs/small_scene.h"
#include "jobs/vq_encoders.h"
#include "jobs/vq_report.h"
#include "shared_data.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

namespace filigree::jobs {
namespace {

using tests::TempFolder;

// A grey PNG of a disc with a hole.
std::filesystem::path writeDisc(const TempFolder& folder, const std::string& name, unsigned size) {
    std::vector<uint8_t> texels;
    for (unsigned y = 0; y < size; ++y) {
        for (unsigned x = 0; x < size; ++x) {
            const double r = std::hypot(x + 0.5 - size / 2.0, y + 0.5 - size / 2.0) / size;
            texels.push_back(r < 0.4 && r > 0.1 ? 255 : 0);
        }
    }
    const auto png = io::encodeGreyPng(size, size, texels);
    EXPECT_TRUE(png && writeFile(folder / name, *png));
    return folder / name;
}

Result<VqSummary> run(const VqOptions& options) {
    return vq(options, serialExecutor(), silentProgress());
}

TEST(Vq, MeasuresTexturesAndWritesItsReport) {
    const TempFolder folder;
    VqOptions options;
    options.inputs = {writeDisc(folder, "a.png", 64), writeDisc(folder, "b.png", 100)};
    options.outputFolder = folder / "out";
    const auto summary = run(options);
    ASSERT_TRUE(summary) << summary.error().message;
    ASSERT_EQ(summary->textures.size(), 2u);
    EXPECT_EQ(summary->textures[1].name, "b.png");
    EXPECT_EQ(summary->totals.maps, 2u);
    for (const VqTexture& texture : summary->textures) {
        const auto mean = [&](VqMeasure measure) { return texture.totals.mean(measure); };
        EXPECT_LT(mean(VqMeasure::source8), mean(VqMeasure::source16));
        EXPECT_LT(mean(VqMeasure::source32), mean(VqMeasure::source64));
        for (const VqEncoder& e : vqEncoders()) {
            const auto lost = static_cast<double>(texture.totals.substitutions[indexOf(e.measure)]);
            EXPECT_NEAR(mean(e.measure), mean(e.source) - lost / (e.side * e.side), 1e-12)
                << nameOf(e.measure);
        }
        EXPECT_LE(texture.totals.substitutions[indexOf(VqMeasure::vq2Plus)],
                  texture.totals.substitutions[indexOf(VqMeasure::vq2Best)]);
    }
    for (const char* name : {"index.html", "vq.csv", "savings-vq2.svg", "savings-source.svg",
                             "savings-vq4.svg", "map-001-a-png.png", "map-002-b-png.png"})
        EXPECT_TRUE(std::filesystem::exists(options.outputFolder / name)) << name;
}

TEST(Vq, JsonHasTheMembersPromised) {
    const TempFolder folder;
    VqOptions options;
    options.inputs = {writeDisc(folder, "a.png", 32)};
    options.outputFolder = folder / "out";
    options.pictures = false;
    const auto summary = run(options);
    ASSERT_TRUE(summary);
    const auto json = nlohmann::json::parse(toJson(*summary));
    const auto& texture = json["textures"][0];
    for (const auto& place : {texture, json["mean"]}) {
        for (const char* key :
             {"source8", "source16", "source32", "source64", "masks2x64", "raw16", "vq2+", "vq4+"})
            EXPECT_TRUE(place[key].is_number()) << key;
        for (const char* key : {"paper_literal", "paper_sensible", "best"})
            EXPECT_TRUE(place["vq2"][key].is_number()) << key;
        for (const char* key : {"paper", "fast", "best"}) EXPECT_TRUE(place["vq4"][key].is_number()) << key;
    }
    EXPECT_TRUE(json["substitutions"]["vq2"]["best"].is_number_unsigned());
    EXPECT_TRUE(texture["substitutions"]["vq2+"].is_number_unsigned());
    EXPECT_TRUE(json["maps_per_second"]["vq2"]["best"].is_number());
    for (const char* key : {"used", "unique", "most_frequent_share"}) {
        for (const char* format : {"vq2", "vq4"}) EXPECT_EQ(json["transforms"][format][key], 1) << key;
    }
}

TEST(Vq, RefusesWhatHasNoMap) {
    const TempFolder folder;
    const auto black = io::encodeGreyPng(4, 4, std::vector<uint8_t>(16));
    ASSERT_TRUE(black && writeFile(folder / "black.png", *black));
    VqOptions options;
    options.inputs = {writeDisc(folder, "a.png", 16), folder / "black.png"};
    options.outputFolder = folder / "out";
    const auto summary = run(options);
    ASSERT_FALSE(summary);
    EXPECT_NE(summary.error().message.find("black.png: every alpha is 0"), std::string::npos)
        << summary.error().message;
    EXPECT_FALSE(std::filesystem::exists(options.outputFolder));
    options.limit = 1;
    EXPECT_TRUE(run(options));
}

TEST(Vq, PreferKeepsMoreOfAState) {
    FILIGREE_NEEDS_SHARED_DATA();
    const TempFolder folder;
    VqOptions options;
    const auto alpha = tests::sharedData() / "data" / "alpha";
    for (const auto& file : std::filesystem::directory_iterator(alpha)) options.inputs.push_back(file.path());
    std::ranges::sort(options.inputs);
    options.limit = 6;
    options.pictures = false;
    options.outputFolder = folder / "out";
    const auto neither = run(options);
    options.prefer = 'O';
    const auto opaque = run(options);
    ASSERT_TRUE(neither && opaque);
    const size_t k = indexOf(VqMeasure::vq2Best);
    EXPECT_LE(neither->totals.substitutions[k], opaque->totals.substitutions[k]);
}

TEST(ScenePairs, EqualPairsAreOne) {
    scene::Scene scene = tests::sceneOf({tests::masked(0), tests::masked(0)});
    BakeParameters own;
    BakeParameters half;
    half.cutoff = 0.5;
    const auto groups = pairGroups(scene, own);
    ASSERT_EQ(groups.size(), 1u);
    ASSERT_EQ(groups[0].primitives.size(), 2u);
    ASSERT_EQ(groups[0].primitives[0].pairs.size(), 1u);
    const auto distinct = distinctPairs(groups[0]);
    EXPECT_EQ(distinct.of, (std::vector<std::vector<uint32_t>>{{0}, {0}}));
    const auto& pairs = distinct.pairs;
    ASSERT_EQ(pairs.size(), 1u);
    ASSERT_TRUE(pairs[0].second);
    EXPECT_EQ(pairs[0].first.uv[1], pairs[0].second->uv[2]);
    EXPECT_EQ(pairs[0].first.uv[2], pairs[0].second->uv[1]);
    scene.materials[1].cutoff = 0.25;
    EXPECT_EQ(pairGroups(scene, own).size(), 2u);
    EXPECT_EQ(pairGroups(scene, half).size(), 1u);
    scene.materials[1].alphaMode = scene::AlphaMode::opaque;
    EXPECT_EQ(pairGroups(scene, own)[0].primitives.size(), 1u);
}

}  // namespace
}  // namespace filigree::jobs
