#include "vulkan/buffer.h"

#include "vulkan/commands.h"

#include <algorithm>
#include <cstring>
#include <optional>

#include <fmt/format.h>

namespace filigree::vulkan {
namespace {

constexpr VkMemoryPropertyFlags visible =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

std::optional<uint32_t> memoryTypeWith(const VkPhysicalDeviceMemoryProperties& memory, uint32_t allowed,
                                       VkMemoryPropertyFlags flags) {
    for (uint32_t k = 0; k < memory.memoryTypeCount; ++k) {
        const bool fits = (memory.memoryTypes[k].propertyFlags & flags) == flags;
        if (((allowed >> k) & 1) != 0 && fits) return k;
    }
    return std::nullopt;
}

// Memory that the CPU reads must be cached where that can be had.
std::optional<uint32_t> memoryType(const Device::Data& device, uint32_t allowed, BufferPlace place) {
    const bool shared = place == BufferPlace::shared;
    const VkMemoryPropertyFlags least = shared ? visible : 0;
    const VkMemoryPropertyFlags more =
        shared ? VK_MEMORY_PROPERTY_HOST_CACHED_BIT : VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    if (const auto found = memoryTypeWith(device.memory, allowed, least | more)) return found;
    return memoryTypeWith(device.memory, allowed, least);
}

Result<OwnedBuffer> makeHandle(Device::Data& device, uint64_t bytes, VkBufferUsageFlags usage,
                               std::string_view action) {
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = bytes;
    info.usage = usage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    VkBuffer buffer = VK_NULL_HANDLE;
    auto status = checked(vkCreateBuffer(device.device.get(), &info, nullptr, &buffer), action);
    if (!status) return status.error();
    return OwnedBuffer(device.device.get(), buffer);
}

Result<OwnedMemory> allocate(Device::Data& device, const VkMemoryRequirements& needs, BufferPlace place,
                             bool addressed, std::string_view action) {
    const auto type = memoryType(device, needs.memoryTypeBits, place);
    if (!type)
        return Error{ErrorKind::limit, fmt::format("the device has no memory for it: cannot {}", action)};
    VkMemoryAllocateFlagsInfo flags{};
    flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.pNext = addressed ? &flags : nullptr;
    info.allocationSize = needs.size;
    info.memoryTypeIndex = *type;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    auto status = checked(vkAllocateMemory(device.device.get(), &info, nullptr, &memory), action);
    if (!status) return status.error();
    return OwnedMemory(device.device.get(), memory);
}

}  // namespace

Result<Buffer> Buffer::make(Device::Data& device, uint64_t bytes, BufferPlace place, std::string_view what,
                            VkBufferUsageFlags usage, uint64_t alignment) {
    const std::string action = fmt::format("make a buffer of {} bytes for {}", bytes, what);
    const bool addressed = (usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) != 0;
    const bool bound = (usage & VK_BUFFER_USAGE_STORAGE_BUFFER_BIT) != 0 && !addressed;
    if (bound && bytes > device.limits.maxStorageBufferRange) {
        return Error{ErrorKind::limit,
                     fmt::format("{}: {} bytes, and the device's shaders read buffers of up to {}", what,
                                 bytes, device.limits.maxStorageBufferRange)};
    }
    Buffer made;
    made.size_ = std::max<uint64_t>(bytes, 16) + alignment - 1;
    auto handle = makeHandle(device, made.size_, usage, action);
    if (!handle) return handle.error();
    made.buffer_ = std::move(*handle);
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device.device.get(), made.get(), &needs);
    auto memory = allocate(device, needs, place, addressed, action);
    if (!memory) return memory.error();
    made.memory_ = std::move(*memory);
    made.device_ = &device;
    made.allocated_ = needs.size;
    device.allocated += needs.size;
    auto status = checked(vkBindBufferMemory(device.device.get(), made.get(), made.memory_.get(), 0), action);
    if (status && place == BufferPlace::shared) {
        void* mapped = nullptr;
        status = checked(vkMapMemory(device.device.get(), made.memory_.get(), 0, VK_WHOLE_SIZE, 0, &mapped),
                         action);
        made.mapped_ = static_cast<uint8_t*>(mapped);
    }
    if (!status) return status.error();
    if (alignment > 1) made.start_ = -made.address() & (alignment - 1);
    return made;
}

Buffer::Buffer(Buffer&& other) noexcept {
    *this = std::move(other);
}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(memory_, other.memory_);
    std::swap(buffer_, other.buffer_);
    std::swap(size_, other.size_);
    std::swap(start_, other.start_);
    std::swap(allocated_, other.allocated_);
    std::swap(mapped_, other.mapped_);
    return *this;
}

Buffer::~Buffer() {
    if (device_ != nullptr) device_->allocated -= allocated_;
}

VkDeviceAddress Buffer::address() const {
    VkBufferDeviceAddressInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO;
    info.buffer = get();
    return vkGetBufferDeviceAddress(device_->device.get(), &info) + start_;
}

Result<Buffer> uploaded(Device::Data& device, std::span<const uint8_t> bytes, std::string_view what,
                        VkBufferUsageFlags usage, uint64_t padding, uint64_t alignment) {
    const uint64_t size = bytes.size() + padding;
    auto staging = Buffer::make(device, size, BufferPlace::shared, what, 0);
    if (!staging) return staging.error();
    std::memset(staging->mapped() + bytes.size(), 0, staging->size() - bytes.size());
    if (!bytes.empty()) std::memcpy(staging->mapped(), bytes.data(), bytes.size());
    auto made = Buffer::make(device, size, BufferPlace::onDevice, what, usage, alignment);
    if (!made) return made.error();
    const auto copied = submit(device, "copy data to the device", [&](VkCommandBuffer commands) {
        const VkBufferCopy all{0, made->start(), staging->size()};
        vkCmdCopyBuffer(commands, staging->get(), made->get(), 1, &all);
    });
    if (!copied) return copied.error();
    return made;
}

Status download(Device::Data& device, const Buffer& from, std::span<uint8_t> to) {
    auto staging = Buffer::make(device, to.size(), BufferPlace::shared, "results", 0);
    if (!staging) return staging.error();
    const auto copied = submit(device, "copy results from the device", [&](VkCommandBuffer commands) {
        const VkBufferCopy all{0, 0, to.size()};
        vkCmdCopyBuffer(commands, from.get(), staging->get(), 1, &all);
    });
    if (!copied) return copied;
    std::memcpy(to.data(), staging->mapped(), to.size());
    return {};
}

}  // namespace filigree::vulkan
