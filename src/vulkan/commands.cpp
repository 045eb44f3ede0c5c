#include "vulkan/commands.h"

namespace filigree::vulkan {
namespace {

// A buffer of commands that goes back to its pool.
class Commands {
  public:
    Commands(Device::Data& device, VkCommandBuffer handle) : device_(device), handle_(handle) {}
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;
    ~Commands() { vkFreeCommandBuffers(device_.device.get(), device_.commands.get(), 1, &handle_); }

  private:
    Device::Data& device_;
    VkCommandBuffer handle_;
};

Status waitFor(Device::Data& device, VkCommandBuffer commands, std::string_view action) {
    const VkFenceCreateInfo info{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, nullptr, 0};
    VkFence handle = VK_NULL_HANDLE;
    if (auto made = checked(vkCreateFence(device.device.get(), &info, nullptr, &handle), action); !made)
        return made;
    const OwnedFence fence(device.device.get(), handle);
    VkSubmitInfo work{};
    work.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    work.commandBufferCount = 1;
    work.pCommandBuffers = &commands;
    if (auto begun = checked(vkQueueSubmit(device.queue, 1, &work, handle), action); !begun) return begun;
    return checked(vkWaitForFences(device.device.get(), 1, &handle, VK_TRUE, UINT64_MAX), action);
}

}  // namespace

Status submit(Device::Data& device, std::string_view action,
              const std::function<void(VkCommandBuffer)>& record) {
    VkCommandBufferAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    info.commandPool = device.commands.get();
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    if (auto made = checked(vkAllocateCommandBuffers(device.device.get(), &info, &commands), action); !made)
        return made;
    const Commands owner(device, commands);
    VkCommandBufferBeginInfo once{};
    once.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    once.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    if (auto begun = checked(vkBeginCommandBuffer(commands, &once), action); !begun) return begun;
    record(commands);
    barrier(commands);
    if (auto ended = checked(vkEndCommandBuffer(commands), action); !ended) return ended;
    return waitFor(device, commands, action);
}

void barrier(VkCommandBuffer commands) {
    VkMemoryBarrier all{};
    all.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    all.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    all.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT | VK_ACCESS_HOST_READ_BIT;
    const VkPipelineStageFlags stages = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    vkCmdPipelineBarrier(commands, stages, stages | VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &all, 0, nullptr, 0,
                         nullptr);
}

}  // namespace filigree::vulkan
