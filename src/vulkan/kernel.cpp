#include "vulkan/kernel.h"

#include <array>

namespace filigree::vulkan {
namespace {

constexpr VkShaderStageFlags stage = VK_SHADER_STAGE_COMPUTE_BIT;

VkDescriptorType typeAt(const KernelShape& shape, uint32_t binding) {
    return binding < shape.buffers ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER
                                   : VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR;
}
uint32_t bindingsOf(const KernelShape& shape) {
    return shape.buffers + (shape.traces ? 1 : 0);
}

Result<OwnedSetLayout> makeSetLayout(VkDevice device, const KernelShape& shape) {
    std::vector<VkDescriptorSetLayoutBinding> bindings(bindingsOf(shape));
    for (uint32_t k = 0; k < bindings.size(); ++k) bindings[k] = {k, typeAt(shape, k), 1, stage, nullptr};
    VkDescriptorSetLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    info.bindingCount = static_cast<uint32_t>(bindings.size());
    info.pBindings = bindings.data();
    VkDescriptorSetLayout made = VK_NULL_HANDLE;
    auto status =
        checked(vkCreateDescriptorSetLayout(device, &info, nullptr, &made), "lay out a shader's buffers");
    if (!status) return status.error();
    return OwnedSetLayout(device, made);
}

Result<OwnedPipelineLayout> makeLayout(VkDevice device, VkDescriptorSetLayout set, uint32_t pushBytes) {
    const VkPushConstantRange range{stage, 0, pushBytes};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = 1;
    info.pSetLayouts = &set;
    info.pushConstantRangeCount = pushBytes > 0 ? 1 : 0;
    info.pPushConstantRanges = &range;
    VkPipelineLayout made = VK_NULL_HANDLE;
    auto status = checked(vkCreatePipelineLayout(device, &info, nullptr, &made), "lay out a pipeline");
    if (!status) return status.error();
    return OwnedPipelineLayout(device, made);
}

Result<OwnedShader> makeShader(VkDevice device, Shader shader) {
    const std::span<const uint32_t> code = codeOf(shader);
    VkShaderModuleCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    info.codeSize = code.size_bytes();
    info.pCode = code.data();
    VkShaderModule made = VK_NULL_HANDLE;
    auto status = checked(vkCreateShaderModule(device, &info, nullptr, &made), "load a shader");
    if (!status) return status.error();
    return OwnedShader(device, made);
}

Result<OwnedPipeline> makePipeline(VkDevice device, VkPipelineLayout layout, VkShaderModule shader,
                                   std::span<const uint32_t> constants) {
    std::vector<VkSpecializationMapEntry> entries;
    for (uint32_t k = 0; k < constants.size(); ++k) entries.push_back({k, 4 * k, 4});
    const VkSpecializationInfo values{static_cast<uint32_t>(entries.size()), entries.data(),
                                      constants.size_bytes(), constants.data()};
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = shader;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = &values;
    info.layout = layout;
    VkPipeline made = VK_NULL_HANDLE;
    auto status = checked(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &made),
                          "compile a shader");
    if (!status) return status.error();
    return OwnedPipeline(device, made);
}

Result<OwnedSetPool> makePool(VkDevice device, const KernelShape& shape) {
    const std::array<VkDescriptorPoolSize, 2> sizes{{{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, shape.buffers},
                                                     {VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, 1}}};
    VkDescriptorPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    info.maxSets = 1;
    info.poolSizeCount = shape.traces ? 2 : 1;
    info.pPoolSizes = sizes.data();
    VkDescriptorPool made = VK_NULL_HANDLE;
    auto status =
        checked(vkCreateDescriptorPool(device, &info, nullptr, &made), "make room for a shader's buffers");
    if (!status) return status.error();
    return OwnedSetPool(device, made);
}

Result<VkDescriptorSet> makeSet(VkDevice device, VkDescriptorPool pool, VkDescriptorSetLayout layout) {
    VkDescriptorSetAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    info.descriptorPool = pool;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    VkDescriptorSet made = VK_NULL_HANDLE;
    auto status = checked(vkAllocateDescriptorSets(device, &info, &made), "bind a shader's buffers");
    if (!status) return status.error();
    return made;
}

}  // namespace

Result<Kernel> Kernel::make(Device::Data& device, Shader shader, const KernelShape& shape,
                            std::span<const uint32_t> constants) {
    Kernel made;
    made.device_ = device.device.get();
    made.shape_ = shape;
    auto setLayout = makeSetLayout(made.device_, shape);
    if (!setLayout) return setLayout.error();
    auto layout = makeLayout(made.device_, setLayout->get(), shape.pushBytes);
    if (!layout) return layout.error();
    const auto code = makeShader(made.device_, shader);
    if (!code) return code.error();
    auto pipeline = makePipeline(made.device_, layout->get(), code->get(), constants);
    if (!pipeline) return pipeline.error();
    auto pool = makePool(made.device_, shape);
    if (!pool) return pool.error();
    const auto set = makeSet(made.device_, pool->get(), setLayout->get());
    if (!set) return set.error();
    made.setLayout_ = std::move(*setLayout);
    made.layout_ = std::move(*layout);
    made.pipeline_ = std::move(*pipeline);
    made.pool_ = std::move(*pool);
    made.set_ = *set;
    return made;
}

void Kernel::bind(uint32_t at, const Buffer& buffer) {
    const VkDescriptorBufferInfo info{buffer.get(), 0, VK_WHOLE_SIZE};
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set_;
    write.dstBinding = at;
    write.descriptorCount = 1;
    write.descriptorType = typeAt(shape_, at);
    write.pBufferInfo = &info;
    vkUpdateDescriptorSets(device_, 1, &write, 0, nullptr);
}

void Kernel::bind(uint32_t at, VkAccelerationStructureKHR structure) {
    VkWriteDescriptorSetAccelerationStructureKHR info{};
    info.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR;
    info.accelerationStructureCount = 1;
    info.pAccelerationStructures = &structure;
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.pNext = &info;
    write.dstSet = set_;
    write.dstBinding = at;
    write.descriptorCount = 1;
    write.descriptorType = typeAt(shape_, at);
    vkUpdateDescriptorSets(device_, 1, &write, 0, nullptr);
}

void Kernel::record(VkCommandBuffer commands, const void* push, uint32_t groupsX, uint32_t groupsY) const {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_.get(), 0, 1, &set_, 0, nullptr);
    if (shape_.pushBytes > 0) vkCmdPushConstants(commands, layout_.get(), stage, 0, shape_.pushBytes, push);
    vkCmdDispatch(commands, groupsX, groupsY, 1);
}

}  // namespace filigree::vulkan
