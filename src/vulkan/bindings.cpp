#include "vulkan/bindings.h"

#include <array>

namespace filigree::vulkan {
namespace {

VkDescriptorType typeAt(const BindingShape& shape, uint32_t binding) {
    return binding < shape.buffers ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER
                                   : VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR;
}
uint32_t bindingsOf(const BindingShape& shape) {
    return shape.buffers + (shape.traces ? 1 : 0);
}

Result<OwnedSetLayout> makeSetLayout(VkDevice device, const BindingShape& shape, VkShaderStageFlags stages) {
    std::vector<VkDescriptorSetLayoutBinding> bindings(bindingsOf(shape));
    for (uint32_t k = 0; k < bindings.size(); ++k) bindings[k] = {k, typeAt(shape, k), 1, stages, nullptr};
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

Result<OwnedPipelineLayout> makeLayout(VkDevice device, VkDescriptorSetLayout set,
                                       const VkPushConstantRange& range) {
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = 1;
    info.pSetLayouts = &set;
    info.pushConstantRangeCount = range.size > 0 ? 1 : 0;
    info.pPushConstantRanges = &range;
    VkPipelineLayout made = VK_NULL_HANDLE;
    auto status = checked(vkCreatePipelineLayout(device, &info, nullptr, &made), "lay out a pipeline");
    if (!status) return status.error();
    return OwnedPipelineLayout(device, made);
}

Result<OwnedSetPool> makePool(VkDevice device, const BindingShape& shape) {
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

VkWriteDescriptorSet writeTo(VkDescriptorSet set, uint32_t at, VkDescriptorType type) {
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set;
    write.dstBinding = at;
    write.descriptorCount = 1;
    write.descriptorType = type;
    return write;
}

}  // namespace

Result<Bindings> Bindings::make(Device::Data& device, const BindingShape& shape, VkShaderStageFlags stages) {
    Bindings made;
    made.device_ = device.device.get();
    made.shape_ = shape;
    made.stages_ = stages;
    auto setLayout = makeSetLayout(made.device_, shape, stages);
    if (!setLayout) return setLayout.error();
    auto layout = makeLayout(made.device_, setLayout->get(), {stages, 0, shape.pushBytes});
    if (!layout) return layout.error();
    auto pool = makePool(made.device_, shape);
    if (!pool) return pool.error();
    const auto set = makeSet(made.device_, pool->get(), setLayout->get());
    if (!set) return set.error();
    made.setLayout_ = std::move(*setLayout);
    made.layout_ = std::move(*layout);
    made.pool_ = std::move(*pool);
    made.set_ = *set;
    return made;
}

void Bindings::bind(uint32_t at, const Buffer& buffer) {
    const VkDescriptorBufferInfo info{buffer.get(), 0, VK_WHOLE_SIZE};
    VkWriteDescriptorSet write = writeTo(set_, at, typeAt(shape_, at));
    write.pBufferInfo = &info;
    vkUpdateDescriptorSets(device_, 1, &write, 0, nullptr);
}

void Bindings::bind(uint32_t at, VkAccelerationStructureKHR structure) {
    VkWriteDescriptorSetAccelerationStructureKHR info{};
    info.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR;
    info.accelerationStructureCount = 1;
    info.pAccelerationStructures = &structure;
    VkWriteDescriptorSet write = writeTo(set_, at, typeAt(shape_, at));
    write.pNext = &info;
    vkUpdateDescriptorSets(device_, 1, &write, 0, nullptr);
}

void Bindings::record(VkCommandBuffer commands, VkPipelineBindPoint point, const void* push) const {
    vkCmdBindDescriptorSets(commands, point, layout_.get(), 0, 1, &set_, 0, nullptr);
    if (shape_.pushBytes > 0) vkCmdPushConstants(commands, layout_.get(), stages_, 0, shape_.pushBytes, push);
}

}  // namespace filigree::vulkan
