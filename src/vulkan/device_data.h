// What an open device consists of.
#pragma once

#include "filigree/vulkan/device.h"

#include "vulkan/instance.h"
#include "vulkan/owned.h"

#include <cstdint>

namespace filigree::vulkan {

struct Device::Data {
    explicit Data(Instance from) : instance(std::move(from)) {}

    Instance instance;
    DeviceFacts facts;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkPhysicalDeviceLimits limits{};
    VkPhysicalDeviceMemoryProperties memory{};
    OwnedDevice device;
    VkQueue queue = VK_NULL_HANDLE;
    OwnedCommandPool commands;
    uint64_t allocated = 0;  // bytes in use
};

}  // namespace filigree::vulkan
