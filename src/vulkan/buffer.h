// Memory of a device that shaders read and write.
#pragma once

#include "vulkan/device_data.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace filigree::vulkan {

// Where a buffer lies: `onDevice` is quick for shaders; `shared` is seen by the CPU, too.
enum class BufferPlace : uint8_t { onDevice, shared };

class Buffer {
  public:
    Buffer() = default;
    // `what` names it in errors. At least 16 bytes are made. `usage` besides copies; with storage and no
    // address shaders bind it, and its size is checked.
    // `alignment`: of its address, a power of two.
    static Result<Buffer> make(Device::Data& device, uint64_t bytes, BufferPlace place, std::string_view what,
                               VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                               uint64_t alignment = 1);
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;
    ~Buffer();

    [[nodiscard]] VkBuffer get() const { return buffer_.get(); }
    // Bytes, from the address on where it is aligned.
    [[nodiscard]] uint64_t size() const { return size_ - start_; }
    // Only of shared ones.
    [[nodiscard]] uint8_t* mapped() const { return mapped_; }
    // Only with VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT.
    [[nodiscard]] VkDeviceAddress address() const;
    // Where the aligned address stands in the buffer.
    [[nodiscard]] uint64_t start() const { return start_; }

  private:
    Device::Data* device_ = nullptr;
    OwnedMemory memory_;
    OwnedBuffer buffer_;  // goes first
    uint64_t size_ = 0;
    uint64_t start_ = 0;
    uint64_t allocated_ = 0;
    uint8_t* mapped_ = nullptr;
};

// A buffer on the device that holds `bytes`, and behind them `padding` bytes of zero.
Result<Buffer> uploaded(Device::Data& device, std::span<const uint8_t> bytes, std::string_view what,
                        VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, uint64_t padding = 8,
                        uint64_t alignment = 1);

template <class T>
Result<Buffer> uploadedOf(Device::Data& device, const std::vector<T>& values, std::string_view what,
                          VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT) {
    return uploaded(device, {reinterpret_cast<const uint8_t*>(values.data()), values.size() * sizeof(T)},
                    what, usage);
}

// Copies the begin of a buffer back.
Status download(Device::Data& device, const Buffer& from, std::span<uint8_t> to);

}  // namespace filigree::vulkan
