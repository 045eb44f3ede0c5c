// Acceleration structures.
#pragma once

#include "vulkan/buffer.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace filigree::vulkan {

// The usage of buffers that structures are built from.
inline constexpr VkBufferUsageFlags buildInput =
    VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
    VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR;

// Geometries of one structure, with how many primitives each has.
struct StructureInput {
    VkAccelerationStructureTypeKHR type = VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR;
    std::vector<VkAccelerationStructureGeometryKHR> geometries;
    std::vector<uint32_t> counts;  // [geometries.size()]
    VkBuildAccelerationStructureFlagsKHR flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
};

class Structure {
  public:
    // Built when the call returns. `what` names it in errors.
    static Result<Structure> build(Device::Data& device, const StructureInput& input, std::string_view what);
    Structure(Structure&& other) noexcept;
    Structure& operator=(Structure&& other) noexcept;
    ~Structure();

    [[nodiscard]] VkAccelerationStructureKHR get() const { return handle_; }
    [[nodiscard]] VkDeviceAddress address() const;
    [[nodiscard]] uint64_t bytes() const { return storage_.size(); }

  private:
    Structure() = default;
    Device::Data* device_ = nullptr;
    Buffer storage_;
    VkAccelerationStructureKHR handle_ = VK_NULL_HANDLE;
};

}  // namespace filigree::vulkan
