// What an open device consists of.
#pragma once

#include "filigree/vulkan/device.h"

#include "vulkan/instance.h"
#include "vulkan/owned.h"

#include <cstdint>

namespace filigree::vulkan {

// Functions of VK_KHR_acceleration_structure, which the loader does not export.
struct RayFunctions {
    PFN_vkCreateAccelerationStructureKHR create = nullptr;
    PFN_vkDestroyAccelerationStructureKHR destroy = nullptr;
    PFN_vkGetAccelerationStructureBuildSizesKHR sizes = nullptr;
    PFN_vkCmdBuildAccelerationStructuresKHR build = nullptr;
    PFN_vkGetAccelerationStructureDeviceAddressKHR address = nullptr;
};

struct Device::Data {
    explicit Data(Instance from) : instance(std::move(from)) {}

    Instance instance;
    DeviceFacts facts;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkPhysicalDeviceLimits limits{};
    VkPhysicalDeviceMemoryProperties memory{};
    OwnedDevice device;
    RayFunctions rays;              // where facts.rayQuery
    uint64_t scratchAlignment = 1;  // of memory that structures are built in
    VkQueue queue = VK_NULL_HANDLE;
    OwnedCommandPool commands;
    uint64_t allocated = 0;  // bytes in use
};

}  // namespace filigree::vulkan
