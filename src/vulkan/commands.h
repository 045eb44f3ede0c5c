// Work for a device, done when the call returns.
#pragma once

#include "vulkan/device_data.h"

#include <functional>
#include <string_view>

namespace filigree::vulkan {

// Records commands, has the device run them and waits. What they write is seen by all that comes later.
// `action` names them in errors.
Status submit(Device::Data& device, std::string_view action,
              const std::function<void(VkCommandBuffer)>& record);

// The same, and how many seconds the commands took: by the device's clock, or where it has none by the CPU's.
Result<double> submitTimed(Device::Data& device, std::string_view action,
                           const std::function<void(VkCommandBuffer)>& record);

// Commands behind this see what those before it wrote.
void barrier(VkCommandBuffer commands);

}  // namespace filigree::vulkan
