#include "vulkan/kernel.h"

#include "vulkan/stage.h"

namespace filigree::vulkan {

Result<Kernel> Kernel::make(Device::Data& device, Shader shader, const BindingShape& shape,
                            std::span<const uint32_t> constants) {
    auto bindings = Bindings::make(device, shape, VK_SHADER_STAGE_COMPUTE_BIT);
    if (!bindings) return bindings.error();
    auto stage = Stage::make(device, shader, VK_SHADER_STAGE_COMPUTE_BIT, constants);
    if (!stage) return stage.error();
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage = stage->info();
    info.layout = bindings->layout();
    VkPipeline pipeline = VK_NULL_HANDLE;
    auto status =
        checked(vkCreateComputePipelines(device.device.get(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
                "compile a shader");
    if (!status) return status.error();
    Kernel made;
    made.bindings_ = std::move(*bindings);
    made.pipeline_ = {device.device.get(), pipeline};
    return made;
}

void Kernel::record(VkCommandBuffer commands, const void* push, uint32_t groupsX, uint32_t groupsY) const {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
    bindings_.record(commands, VK_PIPELINE_BIND_POINT_COMPUTE, push);
    vkCmdDispatch(commands, groupsX, groupsY, 1);
}

}  // namespace filigree::vulkan
