// The devices that the drivers offer.
#pragma once

#include "filigree/vulkan/device.h"

#include "vulkan/owned.h"

#include <optional>
#include <vector>

namespace filigree::vulkan {

struct PhysicalDevice {
    VkPhysicalDevice handle = VK_NULL_HANDLE;
    DeviceFacts facts;
};

// Those with Vulkan 1.1 or later and a queue that computes.
Result<std::vector<PhysicalDevice>> physicalDevices(VkInstance instance);

// The first family of queues that computes.
std::optional<uint32_t> computeFamily(VkPhysicalDevice device);

}  // namespace filigree::vulkan
