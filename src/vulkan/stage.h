// One shader of a pipeline.
#pragma once

#include "vulkan/device_data.h"
#include "vulkan/shaders.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::vulkan {

class Stage {
  public:
    // `constants`: of the shader's constant_id 0, 1, ..
    static Result<Stage> make(Device::Data& device, Shader shader, VkShaderStageFlagBits stage,
                              std::span<const uint32_t> constants);

    // Looks into this stage, which must stay where it is meanwhile.
    [[nodiscard]] VkPipelineShaderStageCreateInfo info();

  private:
    VkShaderStageFlagBits stage_{};
    OwnedShader module_;
    std::vector<uint32_t> constants_;
    std::vector<VkSpecializationMapEntry> entries_;
    VkSpecializationInfo values_{};
};

}  // namespace filigree::vulkan
