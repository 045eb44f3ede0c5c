#include "vulkan/owned.h"

#include <fmt/format.h>

namespace filigree::vulkan {

Status checked(VkResult result, std::string_view action) {
    switch (result) {
        case VK_SUCCESS:
            return {};
        case VK_ERROR_OUT_OF_HOST_MEMORY:
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return Error{ErrorKind::limit, fmt::format("the device is out of memory: cannot {}", action)};
        case VK_ERROR_DEVICE_LOST:
            return Error{ErrorKind::limit,
                         fmt::format("the device was lost (crashed, reset or timed out): cannot {}", action)};
        case VK_ERROR_EXTENSION_NOT_PRESENT:
        case VK_ERROR_FEATURE_NOT_PRESENT:
        case VK_ERROR_INCOMPATIBLE_DRIVER:
            return Error{ErrorKind::unsupported,
                         fmt::format("the Vulkan driver lacks a feature: cannot {}", action)};
        default:
            return Error{ErrorKind::limit,
                         fmt::format("Vulkan error {}: cannot {}", static_cast<int>(result), action)};
    }
}

}  // namespace filigree::vulkan
