#include "jobs/scene_maps.h"

#include "filigree/jobs/bake.h"

#include "jobs/small_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::jobs {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::Ge;
using tests::halves;
using tests::masked;
using tests::sceneOf;

BakeParameters atLevel(unsigned level, unsigned states = 4) {
    BakeParameters parameters;
    parameters.level = level;
    parameters.states = states;
    return parameters;
}

SceneMaps mapsOf(scene::Scene& scene, const BakeParameters& parameters) {
    auto maps = bakeMaps(scene, parameters, serialExecutor(), silentProgress());
    EXPECT_TRUE(maps.ok()) << maps.error().message;
    return maps.ok() ? std::move(*maps) : SceneMaps{};
}

// Two images with the same texels, so two alpha sources with the same maps; and a material without a hole.
scene::Scene twins() {
    auto scene = sceneOf({masked(0), masked(1), masked(-1)});
    scene.images.push_back(halves());
    for (unsigned k = 0; k < 3; ++k) scene.meshes[0].primitives[k].primitiveIndex = k;
    return scene;
}

TEST(SceneMaps, EqualMapsOfDifferentSourcesAreOne) {
    auto scene = twins();
    const SceneMaps maps = mapsOf(scene, atLevel(4));
    EXPECT_EQ(maps.groups.size(), 3u);
    EXPECT_EQ(maps.maps.size(), 2u);
    ASSERT_EQ(maps.primitives.size(), 3u);
    EXPECT_THAT(maps.primitives[0].indices, ElementsAre(0, 1));
    EXPECT_THAT(maps.primitives[1].indices, ElementsAre(0, 1));
    EXPECT_THAT(maps.primitives[2].indices, ElementsAre(-2, -2));
    EXPECT_EQ(maps.level, 4u);
    EXPECT_EQ(maps.triangles, 6u);
    EXPECT_EQ(maps.maskedTriangles, 6u);
    EXPECT_EQ(maps.views().size(), 2u);
}

TEST(SceneMaps, PrimitivesStandInSceneOrder) {
    auto scene = sceneOf({masked(0), masked(1), masked(0)});
    scene.images.push_back(halves());
    for (unsigned k = 0; k < 3; ++k) scene.meshes[0].primitives[k].primitiveIndex = k;
    const SceneMaps maps = mapsOf(scene, atLevel(3));
    std::vector<size_t> groups;
    for (const MapPrimitive& primitive : maps.primitives) groups.push_back(primitive.group);
    EXPECT_THAT(groups, ElementsAre(0, 1, 0));
}

TEST(SceneMaps, WhatASceneCarriesIsWhatItWasBakedTo) {
    for (const unsigned states : {2u, 4u}) {
        auto scene = twins();
        const SceneMaps baked = mapsOf(scene, atLevel(5, states));
        auto carrying = twins();
        ASSERT_TRUE(bakeScene(carrying, atLevel(5, states), serialExecutor(), silentProgress()).ok());
        const SceneMaps carried = carriedMaps(carrying);
        EXPECT_EQ(carried.format, baked.format);
        EXPECT_EQ(carried.level, baked.level);
        ASSERT_EQ(carried.maps.size(), baked.maps.size());
        for (size_t k = 0; k < baked.maps.size(); ++k)
            EXPECT_TRUE(micromap::equal(carried.maps[k], baked.maps[k])) << k;
        ASSERT_EQ(carried.primitives.size(), baked.primitives.size());
        for (size_t p = 0; p < baked.primitives.size(); ++p) {
            EXPECT_EQ(carried.primitives[p].indices, baked.primitives[p].indices);
            EXPECT_EQ(carried.primitives[p].group, baked.primitives[p].group);
        }
        ASSERT_EQ(carried.groups.size(), baked.groups.size());
        EXPECT_EQ(carried.groups[0].name, baked.groups[0].name);
        EXPECT_EQ(carried.groups[0].test->guard, baked.groups[0].test->guard);
    }
}

TEST(SceneMaps, HaveNoLevelWhereLevelsDiffer) {
    auto scene = sceneOf({masked(0)});
    scene.meshes[0].primitives[0].uvs = {{0.4F, 0}, {0.6F, 0}, {0.6F, 0.2F}, {0.4F, 3}};
    const SceneMaps maps = mapsOf(scene, {});
    ASSERT_EQ(maps.maps.size(), 2u);
    EXPECT_NE(maps.maps[0].level, maps.maps[1].level);
    EXPECT_FALSE(maps.level.has_value());
    EXPECT_THAT(maps.primitives[0].indices, Each(Ge(0)));
}

TEST(SceneMaps, ASceneWithoutMasksHasNone) {
    auto material = masked(0);
    material.alphaMode = scene::AlphaMode::opaque;
    auto scene = sceneOf({material});
    const SceneMaps maps = mapsOf(scene, atLevel(4));
    EXPECT_EQ(maps.maps.size(), 0u);
    EXPECT_TRUE(maps.primitives.empty());
    EXPECT_EQ(maps.maskedTriangles, 0u);
    EXPECT_EQ(maps.notes.size(), 1u);
}

}  // namespace
}  // namespace filigree::jobs
