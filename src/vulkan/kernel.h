// A compute shader with its buffers.
#pragma once

#include "vulkan/buffer.h"
#include "vulkan/shaders.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::vulkan {

// What a shader reads and writes: buffers, bound at 0, 1, .. of set 0, and behind them what it traces.
struct KernelShape {
    uint32_t buffers = 0;
    uint32_t pushBytes = 0;
    bool traces = false;  // an acceleration structure
};

class Kernel {
  public:
    // `constants`: of the shader's constant_id 0, 1, ..
    static Result<Kernel> make(Device::Data& device, Shader shader, const KernelShape& shape,
                               std::span<const uint32_t> constants);

    // Buffers and acceleration structure must live as long as the kernel runs.
    void bind(uint32_t at, const Buffer& buffer);
    void bind(uint32_t at, VkAccelerationStructureKHR structure);

    // Runs `groups` groups across and down. `push` has pushBytes bytes.
    void record(VkCommandBuffer commands, const void* push, uint32_t groupsX, uint32_t groupsY = 1) const;

  private:
    Kernel() = default;
    VkDevice device_ = VK_NULL_HANDLE;
    KernelShape shape_;
    OwnedSetLayout setLayout_;
    OwnedPipelineLayout layout_;
    OwnedPipeline pipeline_;
    OwnedSetPool pool_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;  // of the pool
};

}  // namespace filigree::vulkan
