// What shaders read and write besides what they address themselves.
#pragma once

#include "vulkan/buffer.h"

#include <cstdint>

namespace filigree::vulkan {

// Buffers, bound at 0, 1, .. of set 0, behind them an acceleration structure where shaders trace; and
// constants that are pushed.
struct BindingShape {
    uint32_t buffers = 0;
    uint32_t pushBytes = 0;
    bool traces = false;
};

// The bound objects must live as long as shaders run.
class Bindings {
  public:
    Bindings() = default;
    static Result<Bindings> make(Device::Data& device, const BindingShape& shape, VkShaderStageFlags stages);

    void bind(uint32_t at, const Buffer& buffer);
    void bind(uint32_t at, VkAccelerationStructureKHR structure);

    [[nodiscard]] VkPipelineLayout layout() const { return layout_.get(); }
    // `push` has pushBytes bytes.
    void record(VkCommandBuffer commands, VkPipelineBindPoint point, const void* push) const;

  private:
    VkDevice device_ = VK_NULL_HANDLE;
    BindingShape shape_;
    VkShaderStageFlags stages_ = 0;
    OwnedSetLayout setLayout_;
    OwnedPipelineLayout layout_;
    OwnedSetPool pool_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;  // of the pool
};

}  // namespace filigree::vulkan
