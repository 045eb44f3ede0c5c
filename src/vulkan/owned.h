// Vulkan's objects with an owner, and its results as errors.
#pragma once

#include "filigree/core/result.h"

#include <memory>
#include <string_view>
#include <utility>

#include <vulkan/vulkan.h>

namespace filigree::vulkan {

// Success, or what could not be done: "the device is out of memory: cannot ACTION".
Status checked(VkResult result, std::string_view action);

// An object of a device, destroyed with its owner. The device must live longer.
template <class Handle, auto destroy>
class Owned {
  public:
    Owned() = default;
    Owned(VkDevice device, Handle handle) : device_(device), handle_(handle) {}
    Owned(Owned&& other) noexcept
        : device_(other.device_), handle_(std::exchange(other.handle_, VK_NULL_HANDLE)) {}
    Owned& operator=(Owned&& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Owned() {
        if (handle_ != VK_NULL_HANDLE) destroy(device_, handle_, nullptr);
    }

    [[nodiscard]] Handle get() const { return handle_; }

  private:
    VkDevice device_ = VK_NULL_HANDLE;
    Handle handle_ = VK_NULL_HANDLE;
};

using OwnedBuffer = Owned<VkBuffer, vkDestroyBuffer>;
using OwnedMemory = Owned<VkDeviceMemory, vkFreeMemory>;
using OwnedFence = Owned<VkFence, vkDestroyFence>;
using OwnedQueryPool = Owned<VkQueryPool, vkDestroyQueryPool>;
using OwnedCommandPool = Owned<VkCommandPool, vkDestroyCommandPool>;
using OwnedShader = Owned<VkShaderModule, vkDestroyShaderModule>;
using OwnedPipeline = Owned<VkPipeline, vkDestroyPipeline>;
using OwnedPipelineLayout = Owned<VkPipelineLayout, vkDestroyPipelineLayout>;
using OwnedSetLayout = Owned<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout>;
using OwnedSetPool = Owned<VkDescriptorPool, vkDestroyDescriptorPool>;

struct DestroyInstance {
    void operator()(VkInstance instance) const { vkDestroyInstance(instance, nullptr); }
};
using OwnedInstance = std::unique_ptr<VkInstance_T, DestroyInstance>;

struct DestroyDevice {
    void operator()(VkDevice device) const { vkDestroyDevice(device, nullptr); }
};
using OwnedDevice = std::unique_ptr<VkDevice_T, DestroyDevice>;

}  // namespace filigree::vulkan
