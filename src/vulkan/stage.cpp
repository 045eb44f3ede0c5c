#include "vulkan/stage.h"

namespace filigree::vulkan {

Result<Stage> Stage::make(Device::Data& device, std::span<const uint32_t> code, VkShaderStageFlagBits stage,
                          std::span<const uint32_t> constants) {
    VkShaderModuleCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    info.codeSize = code.size_bytes();
    info.pCode = code.data();
    VkShaderModule handle = VK_NULL_HANDLE;
    auto status =
        checked(vkCreateShaderModule(device.device.get(), &info, nullptr, &handle), "load a shader");
    if (!status) return status.error();
    Stage made;
    made.stage_ = stage;
    made.module_ = {device.device.get(), handle};
    made.constants_.assign(constants.begin(), constants.end());
    for (uint32_t k = 0; k < constants.size(); ++k) made.entries_.push_back({k, 4 * k, 4});
    return made;
}

VkPipelineShaderStageCreateInfo Stage::info() {
    values_ = {static_cast<uint32_t>(entries_.size()), entries_.data(), 4 * constants_.size(),
               constants_.data()};
    VkPipelineShaderStageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage = stage_;
    info.module = module_.get();
    info.pName = "main";
    info.pSpecializationInfo = &values_;
    return info;
}

}  // namespace filigree::vulkan
