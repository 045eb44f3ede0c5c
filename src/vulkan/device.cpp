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

// The features that we use of what a device has, as one chain. It stays where it is.
struct WantedFeatures {
    VkPhysicalDeviceRayQueryFeaturesKHR query{};
    VkPhysicalDeviceRayTracingPipelineFeaturesKHR pipeline{};
    VkPhysicalDeviceAccelerationStructureFeaturesKHR structures{};
    VkPhysicalDeviceBufferDeviceAddressFeatures addresses{};
    VkPhysicalDeviceOpacityMicromapFeaturesEXT micromapsExt{};
    MicromapFeaturesKhr micromapsKhr;
    AddressCommandsFeatures addressCommands;
    std::vector<const char*> extensions;
    void* chain = nullptr;

    WantedFeatures(const DeviceFacts& facts, MicromapApi micromaps) {
        if (!facts.tracesRays()) return;
        addresses.bufferDeviceAddress = VK_TRUE;
        add(addresses, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES);
        structures.accelerationStructure = VK_TRUE;
        add(structures, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR);
        extensions = {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                      VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};
        if (facts.rayQuery) {
            query.rayQuery = VK_TRUE;
            add(query, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR);
            extensions.push_back(VK_KHR_RAY_QUERY_EXTENSION_NAME);
        }
        if (facts.rayPipeline) {
            pipeline.rayTracingPipeline = VK_TRUE;
            add(pipeline, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_FEATURES_KHR);
            extensions.push_back(VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME);
        }
        addMicromaps(micromaps);
    }
    WantedFeatures(const WantedFeatures&) = delete;
    WantedFeatures& operator=(const WantedFeatures&) = delete;

  private:
    void addMicromaps(MicromapApi api) {
        if (api == MicromapApi::ext) {
            micromapsExt.micromap = VK_TRUE;
            add(micromapsExt, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_OPACITY_MICROMAP_FEATURES_EXT);
            extensions.insert(extensions.end(), {micromapExtensionExt, synchronization2Extension});
        } else if (api == MicromapApi::khr) {
            micromapsKhr.micromap = VK_TRUE;
            add(micromapsKhr, micromapFeaturesKhr);
            addressCommands.deviceAddressCommands = VK_TRUE;
            add(addressCommands, addressCommandsFeatures);
            extensions.insert(extensions.end(),
                              {micromapExtensionKhr, addressCommandsExtension, synchronization2Extension});
        }
    }

    template <class Features>
    void add(Features& features, VkStructureType type) {
        features.sType = type;
        features.pNext = chain;
        chain = &features;
    }
};

template <class Function>
void load(const Device::Data& data, Function& function, const char* name) {
    function = reinterpret_cast<Function>(vkGetDeviceProcAddr(data.device.get(), name));
}

template <class Properties>
void readProperties(const Device::Data& data, Properties& extension) {
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &extension;
    vkGetPhysicalDeviceProperties2(data.physical, &properties);
}

void loadRayFunctions(Device::Data& data) {
    load(data, data.rays.create, "vkCreateAccelerationStructureKHR");
    load(data, data.rays.destroy, "vkDestroyAccelerationStructureKHR");
    load(data, data.rays.sizes, "vkGetAccelerationStructureBuildSizesKHR");
    load(data, data.rays.build, "vkCmdBuildAccelerationStructuresKHR");
    load(data, data.rays.address, "vkGetAccelerationStructureDeviceAddressKHR");
    VkPhysicalDeviceAccelerationStructurePropertiesKHR structures{};
    structures.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR;
    readProperties(data, structures);
    data.scratchAlignment = structures.minAccelerationStructureScratchOffsetAlignment;
}

void loadRayPipelineFunctions(Device::Data& data) {
    load(data, data.rayPipelines.create, "vkCreateRayTracingPipelinesKHR");
    load(data, data.rayPipelines.handles, "vkGetRayTracingShaderGroupHandlesKHR");
    load(data, data.rayPipelines.trace, "vkCmdTraceRaysKHR");
    VkPhysicalDeviceRayTracingPipelinePropertiesKHR pipelines{};
    pipelines.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_PROPERTIES_KHR;
    readProperties(data, pipelines);
    data.rayPipelines.handleBytes = pipelines.shaderGroupHandleSize;
    data.rayPipelines.handleAlignment = pipelines.shaderGroupHandleAlignment;
    data.rayPipelines.baseAlignment = pipelines.shaderGroupBaseAlignment;
}

void loadMicromapFunctions(Device::Data& data) {
    MicromapFunctions& micromaps = data.micromaps;
    if (micromaps.api == MicromapApi::khr) {
        load(data, micromaps.createStructure, "vkCreateAccelerationStructure2KHR");
        MicromapPropertiesKhr khr;
        readProperties(data, khr);
        micromaps.limits = {khr.maxOpacity2StateSubdivisionLevel, khr.maxOpacity4StateSubdivisionLevel};
        return;
    }
    load(data, micromaps.create, "vkCreateMicromapEXT");
    load(data, micromaps.destroy, "vkDestroyMicromapEXT");
    load(data, micromaps.sizes, "vkGetMicromapBuildSizesEXT");
    load(data, micromaps.build, "vkCmdBuildMicromapsEXT");
    VkPhysicalDeviceOpacityMicromapPropertiesEXT ext{};
    ext.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_OPACITY_MICROMAP_PROPERTIES_EXT;
    readProperties(data, ext);
    micromaps.limits = {ext.maxOpacity2StateSubdivisionLevel, ext.maxOpacity4StateSubdivisionLevel};
}

Status openQueue(Device::Data& data, QueueFamily family) {
    const float priority = 1;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = family.number;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    const WantedFeatures features(data.facts, data.micromaps.api);
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
    if (data.facts.tracesRays()) loadRayFunctions(data);
    if (data.facts.rayPipeline) loadRayPipelineFunctions(data);
    if (data.facts.micromaps) loadMicromapFunctions(data);
    vkGetDeviceQueue(device, family.number, 0, &data.queue);
    data.timestampBits = family.timestampBits;
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool.queueFamilyIndex = family.number;
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
    data->micromaps.api = (*found)[*chosen].micromaps;
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(data->physical, &properties);
    data->limits = properties.limits;
    vkGetPhysicalDeviceMemoryProperties(data->physical, &data->memory);
    if (auto opened = openQueue(*data, computeFamily(data->physical).value_or(QueueFamily{})); !opened)
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
