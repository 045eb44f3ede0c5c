// The connection to the Vulkan loader, and to the validation layer where that is wanted.
#pragma once

#include "filigree/core/result.h"

#include "vulkan/owned.h"

#include <functional>
#include <memory>
#include <string_view>

namespace filigree::vulkan {

using MessageSink = std::function<void(std::string_view)>;

struct DestroyMessenger {
    VkInstance instance = VK_NULL_HANDLE;
    void operator()(VkDebugUtilsMessengerEXT messenger) const;
};
using OwnedMessenger = std::unique_ptr<VkDebugUtilsMessengerEXT_T, DestroyMessenger>;

class Instance {
  public:
    // With a sink, and where the validation layer is installed, its warnings and errors go there.
    static Result<Instance> make(const MessageSink& sink);

    [[nodiscard]] VkInstance get() const { return instance_.get(); }
    [[nodiscard]] bool isValidated() const { return messenger_ != nullptr; }

  private:
    std::unique_ptr<MessageSink> sink_;  // at its place up to the instance's end
    OwnedInstance instance_;
    OwnedMessenger messenger_;
};

}  // namespace filigree::vulkan
