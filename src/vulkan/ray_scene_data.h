// What a scene on a device consists of.
#pragma once

#include "filigree/vulkan/ray_scene.h"

#include "vulkan/buffer.h"
#include "vulkan/scene_words.h"
#include "vulkan/structure.h"

#include <optional>
#include <vector>

namespace filigree::vulkan {

struct RayScene::Data {
    std::vector<const scene::Primitive*> primitives;  // of the surfaces
    Buffer words;                                     // SceneWords
    std::vector<Structure> meshes;
    std::optional<Structure> grids;  // over the boxes of records
    uint32_t gridsAt = noWord;       // of the words
    uint64_t gridWordBytes = 0;
    std::optional<Structure> top;
};

}  // namespace filigree::vulkan
