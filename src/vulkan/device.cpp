#include "filigree/vulkan/device.h"

#include "vulkan/device_data.h"
#include "vulkan/physical.h"

#include <algorithm>

namespace filigree::vulkan {
namespace {

std::vector<DeviceFacts> factsOfAll(const std::vector<PhysicalDevice>& devices) {
    std::vector<DeviceFacts> facts;
    std::ranges::transform(devices, std::back_inserter(facts), &PhysicalDevice::facts);
    return facts;
}

// The features that we use of what a device has, as one chain.
struct WantedFeatures {
    VkPhysicalDeviceRayQueryFeaturesKHR query{};
    VkPhysicalDeviceAccelerationStructureFeaturesKHR structures{};
    VkPhysicalDeviceBufferDeviceAddressFeatures addresses{};
    std::vector<const char*> extensions;
    const void* chain = nullptr;

    explicit WantedFeatures(const DeviceFacts& facts) {
        query.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR;
        query.rayQuery = VK_TRUE;
        structures.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR;
        structures.pNext = &query;
        structures.accelerationStructure = VK_TRUE;
        addresses.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES;
        addresses.pNext = &structures;
        addresses.bufferDeviceAddress = VK_TRUE;
        if (!facts.rayQuery) return;
        chain = &addresses;
        extensions = {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                      VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME, VK_KHR_RAY_QUERY_EXTENSION_NAME};
    }
};

void loadRayFunctions(Device::Data& data) {
    const auto load = [&]<class Function>(Function& function, const char* name) {
        function = reinterpret_cast<Function>(vkGetDeviceProcAddr(data.device.get(), name));
    };
    load(data.rays.create, "vkCreateAccelerationStructureKHR");
    load(data.rays.destroy, "vkDestroyAccelerationStructureKHR");
    load(data.rays.sizes, "vkGetAccelerationStructureBuildSizesKHR");
    load(data.rays.build, "vkCmdBuildAccelerationStructuresKHR");
    load(data.rays.address, "vkGetAccelerationStructureDeviceAddressKHR");
    VkPhysicalDeviceAccelerationStructurePropertiesKHR structures{};
    structures.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &structures;
    vkGetPhysicalDeviceProperties2(data.physical, &properties);
    data.scratchAlignment = structures.minAccelerationStructureScratchOffsetAlignment;
}

Status openQueue(Device::Data& data, uint32_t family) {
    const float priority = 1;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    const WantedFeatures features(data.facts);
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.pNext = features.chain;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = static_cast<uint32_t>(features.extensions.size());
    info.ppEnabledExtensionNames = features.extensions.data();
    VkDevice device = VK_NULL_HANDLE;
    auto status = checked(vkCreateDevice(data.physical, &info, nullptr, &device), "open the device");
    if (!status) return status.error().within(data.facts.name);
    data.device.reset(device);
    if (data.facts.rayQuery) loadRayFunctions(data);
    vkGetDeviceQueue(device, family, 0, &data.queue);
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool.queueFamilyIndex = family;
    VkCommandPool commands = VK_NULL_HANDLE;
    status = checked(vkCreateCommandPool(device, &pool, nullptr, &commands), "make a command pool");
    if (!status) return status;
    data.commands = {device, commands};
    return {};
}

}  // namespace

bool isBuilt() {
    return true;
}

Result<std::vector<DeviceFacts>> devices() {
    const auto instance = Instance::make({});
    if (!instance) return instance.error();
    const auto found = physicalDevices(instance->get());
    if (!found) return found.error();
    return factsOfAll(*found);
}

Result<Device> Device::open(const DeviceOptions& options) {
    auto instance = Instance::make(options.onMessage);
    if (!instance) return instance.error();
    const auto found = physicalDevices(instance->get());
    if (!found) return found.error();
    const auto chosen = chooseDevice(factsOfAll(*found), options.device);
    if (!chosen) return chosen.error();
    auto data = std::make_unique<Data>(std::move(*instance));
    data->facts = (*found)[*chosen].facts;
    data->physical = (*found)[*chosen].handle;
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(data->physical, &properties);
    data->limits = properties.limits;
    vkGetPhysicalDeviceMemoryProperties(data->physical, &data->memory);
    if (auto opened = openQueue(*data, computeFamily(data->physical).value_or(0)); !opened)
        return opened.error();
    return Device(std::move(data));
}

Device::Device(std::unique_ptr<Data> data) : data_(std::move(data)) {}
Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;
Device::~Device() = default;

const DeviceFacts& Device::facts() const {
    return data_->facts;
}

bool Device::isValidated() const {
    return data_->instance.isValidated();
}

uint64_t Device::allocatedBytes() const {
    return data_->allocated;
}

uint64_t Device::largestBufferBytes() const {
    return data_->limits.maxStorageBufferRange;
}

}  // namespace filigree::vulkan
