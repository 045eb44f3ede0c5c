// The devices that the drivers offer.
#pragma once

#include "filigree/vulkan/device.h"

#include "vulkan/micromap_api.h"
#include "vulkan/owned.h"

#include <optional>
#include <vector>

namespace filigree::vulkan {

struct PhysicalDevice {
    VkPhysicalDevice handle = VK_NULL_HANDLE;
    DeviceFacts facts;
    MicromapApi micromaps = MicromapApi::none;
};

// Those with Vulkan 1.1 or later and a queue that computes.
Result<std::vector<PhysicalDevice>> physicalDevices(VkInstance instance);

struct QueueFamily {
    uint32_t number = 0;
    uint32_t timestampBits = 0;
};

// The first family of queues that computes.
std::optional<QueueFamily> computeFamily(VkPhysicalDevice device);

}  // namespace filigree::vulkan
