#include "vulkan/commands.h"

#include <array>
#include <chrono>

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

Result<OwnedQueryPool> makeTimestamps(Device::Data& device) {
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = 2;
    VkQueryPool made = VK_NULL_HANDLE;
    auto status = checked(vkCreateQueryPool(device.device.get(), &info, nullptr, &made), "make timestamps");
    if (!status) return status.error();
    return OwnedQueryPool(device.device.get(), made);
}

// Of timestamps that have been written.
Result<double> secondsBetween(const Device::Data& device, VkQueryPool pool) {
    std::array<uint64_t, 2> ticks{};
    const VkResult read =
        vkGetQueryPoolResults(device.device.get(), pool, 0, 2, sizeof ticks, ticks.data(), sizeof ticks[0],
                              VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
    if (auto status = checked(read, "read timestamps"); !status) return status.error();
    const uint64_t mask = ~uint64_t{0} >> (64 - device.timestampBits);
    return static_cast<double>((ticks[1] - ticks[0]) & mask) * 1e-9 *
           static_cast<double>(device.limits.timestampPeriod);
}

}  // namespace

Result<double> submitTimed(Device::Data& device, std::string_view action,
                           const std::function<void(VkCommandBuffer)>& record) {
    if (device.timestampBits == 0) {
        const auto start = std::chrono::steady_clock::now();
        if (auto done = submit(device, action, record); !done) return done.error();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    const auto pool = makeTimestamps(device);
    if (!pool) return pool.error();
    auto done = submit(device, action, [&](VkCommandBuffer commands) {
        vkCmdResetQueryPool(commands, pool->get(), 0, 2);
        vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, pool->get(), 0);
        record(commands);
        vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, pool->get(), 1);
    });
    if (!done) return done.error();
    return secondsBetween(device, pool->get());
}

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
