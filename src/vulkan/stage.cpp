#include "vulkan/stage.h"

#include "vulkan/micromap_shader.h"

namespace filigree::vulkan {

namespace {

std::vector<uint32_t> moduleOf(const Device::Data& device, Shader shader, VkShaderStageFlagBits stage) {
    const std::span<const uint32_t> code = codeOf(shader);
    if (!shader.micromaps) return {code.begin(), code.end()};
    const bool queries = stage == VK_SHADER_STAGE_COMPUTE_BIT;
    return withMicromaps(code, {true, queries && device.micromaps.api == MicromapApi::khr});
}

}  // namespace

Result<Stage> Stage::make(Device::Data& device, Shader shader, VkShaderStageFlagBits stage,
                          std::span<const uint32_t> constants) {
    const std::vector<uint32_t> code = moduleOf(device, shader, stage);
    VkShaderModuleCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    info.codeSize = 4 * code.size();
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
