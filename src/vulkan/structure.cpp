#include "vulkan/structure.h"

#include "vulkan/commands.h"

#include <utility>

#include <fmt/format.h>

namespace filigree::vulkan {
namespace {

constexpr VkBufferUsageFlags addressed = VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
constexpr uint64_t micromapAlignment = 256;

VkAccelerationStructureBuildGeometryInfoKHR buildInfo(const StructureInput& input) {
    VkAccelerationStructureBuildGeometryInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR;
    info.type = input.type;
    info.flags = input.flags;
    info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
    info.geometryCount = static_cast<uint32_t>(input.geometries.size());
    info.pGeometries = input.geometries.data();
    return info;
}

VkAccelerationStructureBuildSizesInfoKHR sizesOf(const Device::Data& device, const StructureInput& input) {
    VkAccelerationStructureBuildSizesInfoKHR sizes{};
    sizes.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR;
    const auto info = buildInfo(input);
    device.rays.sizes(device.device.get(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info,
                      input.counts.data(), &sizes);
    return sizes;
}

// Micromaps can be made at an address alone.
VkResult createHandle(const Device::Data& device, const Buffer& storage, uint64_t bytes,
                      VkAccelerationStructureTypeKHR type, VkAccelerationStructureKHR* handle) {
    if (type == micromapStructureKhr) {
        CreateStructure2 create;
        create.address = storage.address();
        create.size = bytes;
        return device.micromaps.createStructure(device.device.get(), &create, nullptr, handle);
    }
    VkAccelerationStructureCreateInfoKHR create{};
    create.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR;
    create.buffer = storage.get();
    create.size = bytes;
    create.type = type;
    return device.rays.create(device.device.get(), &create, nullptr, handle);
}

}  // namespace

Result<Structure> Structure::build(Device::Data& device, const StructureInput& input, std::string_view what) {
    const auto sizes = sizesOf(device, input);
    Structure made;
    auto storage = Buffer::make(device, sizes.accelerationStructureSize, BufferPlace::onDevice, what,
                                addressed | VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR,
                                input.type == micromapStructureKhr ? micromapAlignment : 1);
    if (!storage) return storage.error();
    made.storage_ = std::move(*storage);
    const auto scratch =
        Buffer::make(device, sizes.buildScratchSize, BufferPlace::onDevice, "building it",
                     addressed | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, device.scratchAlignment);
    if (!scratch) return scratch.error().within(std::string(what));
    const std::string action = fmt::format("build {}", what);
    auto status = checked(
        createHandle(device, made.storage_, sizes.accelerationStructureSize, input.type, &made.handle_),
        action);
    if (!status) return status.error();
    made.device_ = &device;
    auto info = buildInfo(input);
    info.dstAccelerationStructure = made.handle_;
    info.scratchData.deviceAddress = scratch->address();
    std::vector<VkAccelerationStructureBuildRangeInfoKHR> ranges;
    for (const uint32_t count : input.counts) ranges.push_back({count, 0, 0, 0});
    // Micromaps must have none.
    const VkAccelerationStructureBuildRangeInfoKHR* first =
        input.type == micromapStructureKhr ? nullptr : ranges.data();
    status = submit(device, action,
                    [&](VkCommandBuffer commands) { device.rays.build(commands, 1, &info, &first); });
    if (!status) return status.error();
    return made;
}

Structure::Structure(Structure&& other) noexcept {
    *this = std::move(other);
}

Structure& Structure::operator=(Structure&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(storage_, other.storage_);
    std::swap(handle_, other.handle_);
    return *this;
}

Structure::~Structure() {
    if (handle_ != VK_NULL_HANDLE) device_->rays.destroy(device_->device.get(), handle_, nullptr);
}

VkDeviceAddress Structure::address() const {
    VkAccelerationStructureDeviceAddressInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR;
    info.accelerationStructure = handle_;
    return device_->rays.address(device_->device.get(), &info);
}

}  // namespace filigree::vulkan
