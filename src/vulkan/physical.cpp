#include "vulkan/physical.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace filigree::vulkan {
namespace {

std::vector<VkExtensionProperties> extensionsOf(VkPhysicalDevice device) {
    uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data());
    extensions.resize(count);
    return extensions;
}

DeviceKind kindOf(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return DeviceKind::gpu;
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return DeviceKind::integratedGpu;
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return DeviceKind::virtualGpu;
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            return DeviceKind::cpu;
        default:
            return DeviceKind::other;
    }
}

template <class Features>
void readFeatures(VkPhysicalDevice device, Features& extension) {
    VkPhysicalDeviceFeatures2 features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    features.pNext = &extension;
    vkGetPhysicalDeviceFeatures2(device, &features);
}

struct RayFeatures {
    bool structures = false;
    bool query = false;
    bool pipeline = false;
};

// An extension may be there with its feature off.
RayFeatures rayFeaturesOf(VkPhysicalDevice device) {
    VkPhysicalDeviceRayTracingPipelineFeaturesKHR pipeline{};
    pipeline.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_FEATURES_KHR;
    VkPhysicalDeviceRayQueryFeaturesKHR query{};
    query.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR;
    query.pNext = &pipeline;
    VkPhysicalDeviceAccelerationStructureFeaturesKHR structures{};
    structures.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR;
    structures.pNext = &query;
    VkPhysicalDeviceBufferDeviceAddressFeatures addresses{};
    addresses.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES;
    addresses.pNext = &structures;
    readFeatures(device, addresses);
    const bool built = structures.accelerationStructure != 0 && addresses.bufferDeviceAddress != 0;
    return {built, built && query.rayQuery != 0, built && pipeline.rayTracingPipeline != 0};
}

// EXT where a device has both: its ray queries need no mode of shaders.
template <class Has>
MicromapApi micromapApiOf(VkPhysicalDevice device, const Has& has) {
    if (!has(synchronization2Extension)) return MicromapApi::none;
    if (has(micromapExtensionExt)) {
        VkPhysicalDeviceOpacityMicromapFeaturesEXT ext{};
        ext.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_OPACITY_MICROMAP_FEATURES_EXT;
        readFeatures(device, ext);
        if (ext.micromap != 0) return MicromapApi::ext;
    }
    if (has(micromapExtensionKhr) && has(addressCommandsExtension)) {
        AddressCommandsFeatures commands;
        MicromapFeaturesKhr khr;
        khr.pNext = &commands;
        readFeatures(device, khr);
        if (khr.micromap != 0 && commands.deviceAddressCommands != 0) return MicromapApi::khr;
    }
    return MicromapApi::none;
}

PhysicalDevice describe(VkPhysicalDevice device) {
    VkPhysicalDeviceDriverProperties driver{};
    driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    const bool isNew = [&] {
        VkPhysicalDeviceProperties plain;
        vkGetPhysicalDeviceProperties(device, &plain);
        return plain.apiVersion >= VK_API_VERSION_1_2;
    }();
    if (isNew) properties.pNext = &driver;
    vkGetPhysicalDeviceProperties2(device, &properties);
    const auto extensions = extensionsOf(device);
    const auto has = [&](std::string_view name) {
        return std::ranges::any_of(extensions,
                                   [&](const auto& found) { return name == found.extensionName; });
    };
    PhysicalDevice described{device, {}, MicromapApi::none};
    DeviceFacts& facts = described.facts;
    facts.name = properties.properties.deviceName;
    facts.driver = isNew ? fmt::format("{} {}", driver.driverName, driver.driverInfo)
                         : fmt::format("version {}", properties.properties.driverVersion);
    facts.kind = kindOf(properties.properties.deviceType);
    // Asking for features of extensions that are not there is an error.
    if (!isNew || !has(VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME)) return described;
    const RayFeatures rays = rayFeaturesOf(device);
    facts.rayQuery = rays.query && has(VK_KHR_RAY_QUERY_EXTENSION_NAME);
    facts.rayPipeline = rays.pipeline && has(VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME);
    if (facts.tracesRays()) described.micromaps = micromapApiOf(device, has);
    facts.micromaps = described.micromaps != MicromapApi::none;
    return described;
}

bool isUsable(VkPhysicalDevice device) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(device, &properties);
    return properties.apiVersion >= VK_API_VERSION_1_1 && computeFamily(device).has_value();
}

}  // namespace

std::optional<QueueFamily> computeFamily(VkPhysicalDevice device) {
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    for (uint32_t k = 0; k < count; ++k) {
        if ((families[k].queueFlags & VK_QUEUE_COMPUTE_BIT) != 0)
            return QueueFamily{k, families[k].timestampValidBits};
    }
    return std::nullopt;
}

Result<std::vector<PhysicalDevice>> physicalDevices(VkInstance instance) {
    uint32_t count = 0;
    auto status = checked(vkEnumeratePhysicalDevices(instance, &count, nullptr), "list the devices");
    if (!status) return status.error();
    std::vector<VkPhysicalDevice> handles(count);
    status = checked(vkEnumeratePhysicalDevices(instance, &count, handles.data()), "list the devices");
    if (!status) return status.error();
    std::vector<PhysicalDevice> devices;
    for (const VkPhysicalDevice handle : handles) {
        if (isUsable(handle)) devices.push_back(describe(handle));
    }
    return devices;
}

}  // namespace filigree::vulkan
