// The two extensions that bring micromaps to devices, with what the headers of 2022 lack of the newer one:
// VK_KHR_opacity_micromap and what it needs of VK_KHR_device_address_commands, numbers and layouts as the
// Vulkan registry has them (headers 1.4.359).
#pragma once

#include <cstdint>

#include <vulkan/vulkan.h>

namespace filigree::vulkan {

// EXT has micromaps as objects of their own; in KHR they are acceleration structures.
enum class MicromapApi : uint8_t { none, ext, khr };

// The highest levels that a device takes.
struct MicromapLimits {
    uint32_t twoStateLevel = 0;
    uint32_t fourStateLevel = 0;
};

inline constexpr const char* micromapExtensionExt = "VK_EXT_opacity_micromap";
inline constexpr const char* micromapExtensionKhr = "VK_KHR_opacity_micromap";
inline constexpr const char* addressCommandsExtension = "VK_KHR_device_address_commands";
inline constexpr const char* synchronization2Extension = "VK_KHR_synchronization2";  // which both build on

inline constexpr auto micromapFeaturesKhr = static_cast<VkStructureType>(1000623000);
inline constexpr auto micromapPropertiesKhr = static_cast<VkStructureType>(1000623001);
inline constexpr auto geometryMicromapDataKhr = static_cast<VkStructureType>(1000623002);
inline constexpr auto trianglesMicromapKhr = static_cast<VkStructureType>(1000623003);
inline constexpr auto addressCommandsFeatures = static_cast<VkStructureType>(1000318006);
inline constexpr auto createStructure2 = static_cast<VkStructureType>(1000318015);
inline constexpr auto micromapStructureKhr = static_cast<VkAccelerationStructureTypeKHR>(1000623000);
inline constexpr auto micromapGeometryKhr = static_cast<VkGeometryTypeKHR>(1000623000);

struct MicromapFeaturesKhr {
    VkStructureType sType = micromapFeaturesKhr;
    void* pNext = nullptr;
    VkBool32 micromap = VK_FALSE;
};

struct MicromapPropertiesKhr {
    VkStructureType sType = micromapPropertiesKhr;
    void* pNext = nullptr;
    uint32_t maxOpacity2StateSubdivisionLevel = 0;
    uint32_t maxOpacity4StateSubdivisionLevel = 0;
    uint32_t maxOpacityLossy4StateSubdivisionLevel = 0;
    uint64_t maxMicromapTriangles = 0;
};

struct AddressCommandsFeatures {
    VkStructureType sType = addressCommandsFeatures;
    void* pNext = nullptr;
    VkBool32 deviceAddressCommands = VK_FALSE;
};

// What a micromap is built of. VkMicromapUsageKHR is VkMicromapUsageEXT.
struct GeometryMicromapDataKhr {
    VkStructureType sType = geometryMicromapDataKhr;
    const void* pNext = nullptr;
    uint32_t usageCountsCount = 0;
    const VkMicromapUsageEXT* pUsageCounts = nullptr;
    const VkMicromapUsageEXT* const* ppUsageCounts = nullptr;
    VkDeviceAddress data = 0;
    VkDeviceAddress triangleArray = 0;
    VkDeviceSize triangleArrayStride = 0;
};

// What the triangles of a geometry find in a micromap.
struct TrianglesMicromapKhr {
    VkStructureType sType = trianglesMicromapKhr;
    void* pNext = nullptr;
    VkIndexType indexType = VK_INDEX_TYPE_NONE_KHR;
    VkDeviceAddress indexBuffer = 0;
    VkDeviceSize indexStride = 0;
    uint32_t baseTriangle = 0;
    VkAccelerationStructureKHR micromap = VK_NULL_HANDLE;
};

// vkCreateAccelerationStructure2KHR, the only way to a micromap.
struct CreateStructure2 {
    VkStructureType sType = createStructure2;
    const void* pNext = nullptr;
    VkAccelerationStructureCreateFlagsKHR createFlags = 0;
    VkDeviceAddress address = 0;  // VkDeviceAddressRangeKHR
    VkDeviceSize size = 0;
    VkFlags addressFlags = 0;
    VkAccelerationStructureTypeKHR type = micromapStructureKhr;
};
using CreateStructure2Function = VkResult(VKAPI_PTR*)(VkDevice, const CreateStructure2*,
                                                      const VkAllocationCallbacks*,
                                                      VkAccelerationStructureKHR*);

}  // namespace filigree::vulkan
