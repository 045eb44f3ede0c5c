#include "filigree/jobs/bake.h"

#include "jobs/small_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::jobs {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using tests::masked;
using tests::sceneOf;

BakeSummary bakeIt(scene::Scene& scene, const BakeParameters& parameters) {
    auto summary = bakeScene(scene, parameters, serialExecutor(), silentProgress());
    EXPECT_TRUE(summary.ok()) << summary.error().message;
    return summary.ok() ? *summary : BakeSummary{};
}

BakeParameters atLevel(unsigned level) {
    BakeParameters parameters;
    parameters.level = level;
    return parameters;
}

std::vector<int> micromapsOf(const scene::Scene& scene) {
    std::vector<int> used;
    for (const auto& primitive : scene.meshes[0].primitives) used.push_back(primitive.micromaps);
    return used;
}

TEST(BakeScene, GroupsPrimitivesByAlphaSource) {
    std::vector<scene::Material> materials(6, masked(0));
    materials[1].name = "another name, the same alpha";
    materials[2].cutoff = 0.25;
    materials[3].wrapU = image::Wrap::clampToEdge;
    materials[4].baseColourFactor[3] = 0.75f;
    auto scene = sceneOf(materials);
    const auto summary = bakeIt(scene, atLevel(3));
    EXPECT_THAT(micromapsOf(scene), ElementsAre(0, 0, 1, 2, 3, 0));
    EXPECT_EQ(summary.triangles, 12u);
    EXPECT_EQ(summary.maskedTriangles, 12u);
    EXPECT_EQ(summary.microTriangles, 12u * 64);
    EXPECT_EQ(scene.meshes[0].primitives[0].micromapIndices, scene.meshes[0].primitives[5].micromapIndices);
    EXPECT_EQ(scene.micromaps[1].bakedWith->cutoff, 0.25);
}

TEST(BakeScene, CutoffOptionReplacesTheMaterials) {
    std::vector<scene::Material> materials(2, masked(0));
    materials[1].cutoff = 0.25;
    auto scene = sceneOf(materials);
    auto parameters = atLevel(2);
    parameters.cutoff = 0.75;
    bakeIt(scene, parameters);
    ASSERT_EQ(scene.micromaps.size(), 1u);
    EXPECT_EQ(scene.micromaps[0].bakedWith->cutoff, 0.75);
}

TEST(BakeScene, PassesOverOpaqueAndBlendWithANote) {
    std::vector<scene::Material> materials(3, masked(0));
    materials[1].alphaMode = scene::AlphaMode::opaque;
    materials[2].alphaMode = scene::AlphaMode::blend;
    auto scene = sceneOf(materials);
    const auto summary = bakeIt(scene, atLevel(2));
    EXPECT_THAT(micromapsOf(scene), ElementsAre(0, -1, -1));
    EXPECT_EQ(summary.triangles, 6u);
    EXPECT_EQ(summary.maskedTriangles, 2u);
    EXPECT_THAT(summary.notes, ElementsAre(HasSubstr("OPAQUE"), HasSubstr("BLEND")));

    auto parameters = atLevel(2);
    parameters.includeBlend = true;
    EXPECT_EQ(bakeIt(scene, parameters).maskedTriangles, 4u);
    EXPECT_THAT(micromapsOf(scene), ElementsAre(0, -1, 1));
    EXPECT_EQ(scene.micromaps[1].bakedWith->mode, image::AlphaMode::blend);
}

TEST(BakeScene, AllSpecialStillHasOneRecord) {
    for (const unsigned states : {2u, 4u}) {
        auto scene = sceneOf({masked(-1)});
        auto parameters = atLevel(5);
        parameters.states = states;
        const auto summary = bakeIt(scene, parameters);
        ASSERT_EQ(scene.micromaps.size(), 1u);
        EXPECT_EQ(scene.micromaps[0].set.records.size(), 1u);
        EXPECT_EQ(scene.micromaps[0].set.data.size(), 1u);
        EXPECT_THAT(scene.meshes[0].primitives[0].micromapIndices, ElementsAre(-2, -2));
        EXPECT_EQ(summary.special[static_cast<size_t>(micromap::State::opaque)], 2u);
        EXPECT_EQ(summary.levels[0], 1u);
        EXPECT_EQ(summary.knownShare(), 1.0);
    }
}

TEST(BakeScene, CountsBytesInTheSmallestIndexType) {
    auto scene = sceneOf({masked(0)});
    const auto summary = bakeIt(scene, atLevel(4));
    EXPECT_EQ(summary.dataBytes, summary.micromaps * 64);
    EXPECT_EQ(summary.recordBytes, summary.micromaps * 8);
    EXPECT_EQ(summary.indexBytes, 2u);
}

TEST(BakeScene, NonFiniteCoordinatesAreUnknownAndNoted) {
    auto scene = sceneOf({masked(0)});
    scene.meshes[0].primitives[0].uvs[3].u = std::numeric_limits<float>::quiet_NaN();
    const auto summary = bakeIt(scene, atLevel(3));
    EXPECT_EQ(scene.meshes[0].primitives[0].micromapIndices[1],
              micromap::specialIndex(micromap::State::unknownOpaque));
    EXPECT_THAT(summary.notes, ElementsAre(HasSubstr("halves: triangles whose")));
}

TEST(BakeScene, RotationKeepsEachTriangleItsVertices) {
    auto scene = sceneOf({masked(0)});
    auto& indices = scene.meshes[0].primitives[0].indices;
    indices = {0, 1, 2, 1, 2, 0};
    auto parameters = atLevel(4);
    parameters.rotate = true;
    EXPECT_EQ(bakeIt(scene, parameters).micromaps, 1u);
    // The same triangle twice, one of them turned until both have the same order: winding and vertices stay.
    EXPECT_TRUE(std::equal(indices.begin(), indices.begin() + 3, indices.begin() + 3));
    const auto first = std::find(indices.begin(), indices.begin() + 3, 0u);
    std::rotate(indices.begin(), first, indices.begin() + 3);
    EXPECT_THAT(std::vector(indices.begin(), indices.begin() + 3), ElementsAre(0, 1, 2));
}

TEST(BakeScene, BakingAgainReplacesMicromaps) {
    auto scene = sceneOf({masked(0)});
    bakeIt(scene, atLevel(2));
    bakeIt(scene, atLevel(5));
    ASSERT_EQ(scene.micromaps.size(), 1u);
    for (const auto& record : scene.micromaps[0].set.records) EXPECT_EQ(record.level, 5);
}

TEST(BakeScene, MipsStopAtTheCoarsest) {
    auto scene = sceneOf({masked(0)});
    auto parameters = atLevel(3);
    parameters.mips = allMips;
    EXPECT_THAT(bakeIt(scene, parameters).notes, ElementsAre(HasSubstr("mips all")));
    EXPECT_EQ(scene.micromaps[0].bakedWith->mips, 4u);
}

TEST(Check, NamesTheOptionOutOfRange) {
    const auto message = [](auto change) {
        BakeParameters parameters;
        change(parameters);
        const auto checked = check(parameters);
        return checked ? "" : checked.error().message;
    };
    EXPECT_THAT(message([](auto&) {}), IsEmpty());
    EXPECT_THAT(message([](auto& p) { p.states = 3; }), HasSubstr("--states"));
    EXPECT_THAT(message([](auto& p) { p.level = 13; }), HasSubstr("--level"));
    EXPECT_THAT(message([](auto& p) { p.maxLevel = 13; }), HasSubstr("--max-level"));
    EXPECT_THAT(message([](auto& p) { p.cutoff = 2; }), HasSubstr("--cutoff"));
    EXPECT_THAT(message([](auto& p) { p.cutoff = std::nan(""); }), HasSubstr("--cutoff"));
    EXPECT_THAT(message([](auto& p) { p.guard = -1; }), HasSubstr("--guard"));
    EXPECT_THAT(message([](auto& p) { p.guard = std::nan(""); }), HasSubstr("--guard"));
}

}  // namespace
}  // namespace filigree::jobs
