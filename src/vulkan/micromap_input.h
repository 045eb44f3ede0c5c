// Micromaps as devices take them: what can be said of them without a device.
#pragma once

#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/micromap/set.h"
#include "filigree/vulkan/picture.h"

#include "vulkan/micromap_api.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::vulkan {

// Of a set whose encoding is flat and which has been checked.
std::vector<micromap::Record> recordsOf(const encoding::EncodedView& flat);

// ErrorKind::unsupported where a record's level is above the device's.
Status checkLevels(std::span<const micromap::Record> records, const MicromapLimits& limits);

// For VkMicromapBuildInfoEXT and VkAccelerationStructureTrianglesOpacityMicromapEXT.
std::vector<VkMicromapUsageEXT> usagesOf(std::span<const micromap::UsageCount> counts);

// The maps of all triangles of all surfaces, those of a surface one after another.
struct MicromapIndices {
    VkIndexType type = VK_INDEX_TYPE_UINT32;
    uint32_t stride = 4;               // bytes, the size of an index
    std::vector<uint64_t> firstBytes;  // [surface_count], where a surface's indices begin
    std::vector<uint8_t> bytes;
};

// 16 bits an index where they tell all maps from the special ones, else 32. With two states unknown ones take
// their side.
MicromapIndices micromapIndices(std::span<const SurfaceMaps> surfaces, uint32_t mapCount, unsigned states);

}  // namespace filigree::vulkan
