// The acceleration structures of a scene: one of each mesh, and one of all instances.
#pragma once

#include "filigree/scene/scene.h"

#include "vulkan/scene_words.h"
#include "vulkan/structure.h"

#include <optional>
#include <vector>

namespace filigree::vulkan {

class HardwareMaps;

// What they are built of. `words` are those that `layout` numbers, on the device.
struct StructureSource {
    const scene::Scene& scene;
    const SceneWords& layout;
    const Buffer& words;
    const Structure* grids = nullptr;  // that stand in the scene, in world units
};

struct StructureOptions {
    VkBuildAccelerationStructureFlagsKHR flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
    VkGeometryInstanceFlagsKHR instanceFlags = 0;  // besides those of all instances
    HardwareMaps* maps = nullptr;                  // attached to the surfaces where there are any
};

struct RayStructures {
    std::vector<Structure> meshes;
    std::optional<Structure> top;

    static Result<RayStructures> build(Device::Data& device, const StructureSource& source,
                                       const StructureOptions& options);
    [[nodiscard]] uint64_t bytes() const;
};

}  // namespace filigree::vulkan
