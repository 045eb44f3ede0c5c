// What an open device consists of.
#pragma once

#include "filigree/vulkan/device.h"

#include "vulkan/instance.h"
#include "vulkan/micromap_api.h"
#include "vulkan/owned.h"

#include <cstdint>

namespace filigree::vulkan {

// Functions of VK_KHR_acceleration_structure, which the loader does not export.
struct RayFunctions {
    PFN_vkCreateAccelerationStructureKHR create = nullptr;
    PFN_vkDestroyAccelerationStructureKHR destroy = nullptr;
    PFN_vkGetAccelerationStructureBuildSizesKHR sizes = nullptr;
    PFN_vkCmdBuildAccelerationStructuresKHR build = nullptr;
    PFN_vkGetAccelerationStructureDeviceAddressKHR address = nullptr;
};

// Functions and limits of VK_KHR_ray_tracing_pipeline.
struct RayPipelineFunctions {
    PFN_vkCreateRayTracingPipelinesKHR create = nullptr;
    PFN_vkGetRayTracingShaderGroupHandlesKHR handles = nullptr;
    PFN_vkCmdTraceRaysKHR trace = nullptr;
    uint32_t handleBytes = 0;      // of a group of shaders
    uint32_t handleAlignment = 1;  // in a table
    uint32_t baseAlignment = 1;    // of a table
};

// Functions and limits of VK_EXT_opacity_micromap or VK_KHR_opacity_micromap.
struct MicromapFunctions {
    MicromapApi api = MicromapApi::none;
    MicromapLimits limits;
    PFN_vkCreateMicromapEXT create = nullptr;  // and those below: of EXT
    PFN_vkDestroyMicromapEXT destroy = nullptr;
    PFN_vkGetMicromapBuildSizesEXT sizes = nullptr;
    PFN_vkCmdBuildMicromapsEXT build = nullptr;
    CreateStructure2Function createStructure = nullptr;  // of KHR
};

struct Device::Data {
    explicit Data(Instance from) : instance(std::move(from)) {}

    Instance instance;
    DeviceFacts facts;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkPhysicalDeviceLimits limits{};
    VkPhysicalDeviceMemoryProperties memory{};
    OwnedDevice device;
    RayFunctions rays;                  // where facts.tracesRays()
    RayPipelineFunctions rayPipelines;  // where facts.rayPipeline
    MicromapFunctions micromaps;        // where facts.micromaps
    uint64_t scratchAlignment = 1;      // of memory that structures are built in
    VkQueue queue = VK_NULL_HANDLE;
    uint32_t timestampBits = 0;  // 0: the queue has no clock
    OwnedCommandPool commands;
    uint64_t allocated = 0;  // bytes in use
};

}  // namespace filigree::vulkan
