#include "vulkan/instance.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace filigree::vulkan {
namespace {

constexpr const char* validationLayer = "VK_LAYER_KHRONOS_validation";
constexpr const char* messengerExtension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;

VKAPI_ATTR VkBool32 VKAPI_CALL passMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                           VkDebugUtilsMessageTypeFlagsEXT,
                                           const VkDebugUtilsMessengerCallbackDataEXT* message, void* sink) {
    (*static_cast<const MessageSink*>(sink))(message->pMessage);
    return VK_FALSE;
}

bool isLayerInstalled(const char* name) {
    uint32_t count = 0;
    if (vkEnumerateInstanceLayerProperties(&count, nullptr) != VK_SUCCESS) return false;
    std::vector<VkLayerProperties> layers(count);
    if (vkEnumerateInstanceLayerProperties(&count, layers.data()) != VK_SUCCESS) return false;
    return std::ranges::any_of(layers,
                               [&](const auto& layer) { return std::strcmp(layer.layerName, name) == 0; });
}

VkDebugUtilsMessengerCreateInfoEXT messengerInfo(MessageSink* sink) {
    VkDebugUtilsMessengerCreateInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    info.pfnUserCallback = passMessage;
    info.pUserData = sink;
    return info;
}

Result<OwnedMessenger> makeMessenger(VkInstance instance, const VkDebugUtilsMessengerCreateInfoEXT& info) {
    const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance, "vkCreateDebugUtilsMessengerEXT"));
    VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
    const VkResult made =
        create != nullptr ? create(instance, &info, nullptr, &messenger) : VK_ERROR_EXTENSION_NOT_PRESENT;
    if (auto status = checked(made, "listen to the validation layer"); !status) return status.error();
    return OwnedMessenger(messenger, {instance});
}

}  // namespace

void DestroyMessenger::operator()(VkDebugUtilsMessengerEXT messenger) const {
    const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance, "vkDestroyDebugUtilsMessengerEXT"));
    if (destroy != nullptr) destroy(instance, messenger, nullptr);
}

Result<Instance> Instance::make(const MessageSink& sink) {
    Instance made;
    const bool watched = sink != nullptr && isLayerInstalled(validationLayer);
    if (watched) made.sink_ = std::make_unique<MessageSink>(sink);
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = "filigree";
    application.apiVersion = VK_API_VERSION_1_2;
    // Chained, it hears of the instance's own creation and end; the messenger of all between.
    const VkDebugUtilsMessengerCreateInfoEXT messenger = messengerInfo(made.sink_.get());
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    if (watched) {
        info.pNext = &messenger;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &validationLayer;
        info.enabledExtensionCount = 1;
        info.ppEnabledExtensionNames = &messengerExtension;
    }
    VkInstance instance = VK_NULL_HANDLE;
    const VkResult connected = vkCreateInstance(&info, nullptr, &instance);
    if (connected == VK_ERROR_INCOMPATIBLE_DRIVER)
        return Error{ErrorKind::unsupported, "no Vulkan device was found; install a driver"};
    auto status = checked(connected, "connect to Vulkan");
    if (!status) return status.error();
    made.instance_.reset(instance);
    if (!watched) return made;
    auto listening = makeMessenger(instance, messenger);
    if (!listening) return listening.error();
    made.messenger_ = std::move(*listening);
    return made;
}

}  // namespace filigree::vulkan
