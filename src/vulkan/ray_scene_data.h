// What a scene on a device consists of.
#pragma once

#include "filigree/vulkan/ray_scene.h"

#include "vulkan/ray_structures.h"

namespace filigree::vulkan {

struct RayScene::Data {
    const scene::Scene* scene = nullptr;
    SceneWords layout;  // without its words, which the device has
    Buffer words;
    std::optional<Structure> grids;  // over the boxes of records
    uint32_t gridsAt = noWord;       // of the words
    uint64_t gridWordBytes = 0;
    RayStructures structures;

    [[nodiscard]] StructureSource source() const {
        return {*scene, layout, words, grids ? &*grids : nullptr};
    }
};

}  // namespace filigree::vulkan
