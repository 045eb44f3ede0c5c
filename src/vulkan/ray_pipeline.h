// A pipeline of ray-tracing shaders with its buffers, and the table that says which shader runs where.
#pragma once

#include "vulkan/bindings.h"
#include "vulkan/shaders.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace filigree::vulkan {

// The shaders of one kind of geometry; that of an instance is chosen by its
// instanceShaderBindingTableRecordOffset. With an intersection shader it is for boxes, else for triangles.
struct HitShaders {
    std::optional<Shader> closest;
    std::optional<Shader> any;
    std::optional<Shader> intersection;
};

struct RayShaders {
    Shader generation;
    Shader miss;
    std::vector<HitShaders> hits;
    VkPipelineCreateFlags flags = 0;
};

class RayPipeline {
  public:
    // Rays start no rays. `constants`: of each shader's constant_id 0, 1, ..
    static Result<RayPipeline> make(Device::Data& device, const RayShaders& shaders,
                                    const BindingShape& shape, std::span<const uint32_t> constants);

    Bindings& bindings() { return bindings_; }

    // Runs the ray generation shader `width` times across and `height` times down.
    void record(VkCommandBuffer commands, const void* push, uint32_t width, uint32_t height) const;

  private:
    RayPipeline() = default;
    PFN_vkCmdTraceRaysKHR trace_ = nullptr;
    Bindings bindings_;
    OwnedPipeline pipeline_;
    Buffer table_;
    VkStridedDeviceAddressRegionKHR generation_{};
    VkStridedDeviceAddressRegionKHR miss_{};
    VkStridedDeviceAddressRegionKHR hits_{};
    VkStridedDeviceAddressRegionKHR callable_{};  // none
};

}  // namespace filigree::vulkan
