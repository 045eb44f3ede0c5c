#include "vulkan/micromap_input.h"

#include "filigree/core/bytes.h"

#include <fmt/format.h>

namespace filigree::vulkan {
namespace {

constexpr int32_t firstUnknownIndex = -3;  // and -4
// Indices above are special.
constexpr uint32_t mostMapsIn16Bits = 0xfffc;

int32_t indexFor(int32_t index, unsigned states) {
    return states == 2 && index <= firstUnknownIndex ? index + 2 : index;
}

}  // namespace

std::vector<micromap::Record> recordsOf(const encoding::EncodedView& flat) {
    std::vector<micromap::Record> records;
    records.reserve(flat.mapCount);
    for (size_t map = 0; map < flat.mapCount; ++map) {
        const uint8_t* record = flat.descriptors.data() + micromap::recordBytes * map;
        records.push_back({loadLe<uint32_t>(record), loadLe<uint16_t>(record + 4), flat.format});
    }
    return records;
}

Status checkLevels(std::span<const micromap::Record> records, const MicromapLimits& limits) {
    for (const micromap::Record& record : records) {
        const bool two = record.format == micromap::Format::twoState;
        const uint32_t most = two ? limits.twoStateLevel : limits.fourStateLevel;
        if (record.level <= most) continue;
        return Error{ErrorKind::unsupported,
                     fmt::format("micromaps of level {}, and the device takes up to {} with {} states; bake "
                                 "with --level {}",
                                 record.level, most, two ? 2 : 4, most)};
    }
    return {};
}

std::vector<VkMicromapUsageEXT> usagesOf(std::span<const micromap::UsageCount> counts) {
    std::vector<VkMicromapUsageEXT> usages;
    for (const micromap::UsageCount& count : counts)
        usages.push_back({count.count, count.level, static_cast<uint32_t>(count.format)});
    return usages;
}

MicromapIndices micromapIndices(std::span<const SurfaceMaps> surfaces, uint32_t mapCount, unsigned states) {
    MicromapIndices made;
    const bool isSmall = mapCount <= mostMapsIn16Bits;
    made.type = isSmall ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32;
    made.stride = isSmall ? 2 : 4;
    for (const SurfaceMaps& surface : surfaces) {
        made.firstBytes.push_back(made.bytes.size());
        for (const int32_t index : surface.indices) {
            const auto bits = static_cast<uint32_t>(indexFor(index, states));
            for (uint32_t k = 0; k < made.stride; ++k)
                made.bytes.push_back(static_cast<uint8_t>(bits >> (8 * k)));
        }
    }
    return made;
}

}  // namespace filigree::vulkan
