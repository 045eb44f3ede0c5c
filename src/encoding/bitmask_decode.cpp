#include "filigree/core/bytes.h"
#include "filigree/encoding/bitmask.h"

#include "encoding/bitmask_layout.h"
#include "encoding/checks.h"

namespace filigree::encoding {
namespace {

Status checkFlags(const uint8_t* descriptor, uint32_t texture) {
    const unsigned flags = descriptor[bitmask::flagsAt];
    if ((flags & 3) == 3 || ((flags >> bitmask::wrapVShift) & 3) == 3) {
        return formatError("descriptors: texture {}: flags {:#x}, expected wrap modes 0 to 2", texture,
                           flags);
    }
    if (flags >= 2 * bitmask::nearestFlag) {
        return formatError("descriptors: texture {}: flags {:#x}, expected below {:#x}", texture, flags,
                           2 * bitmask::nearestFlag);
    }
    for (size_t at = bitmask::flagsAt + 1; at < bitmask::descriptorBytes; ++at) {
        if (descriptor[at] != 0) {
            return formatError("descriptors: texture {}: byte {} is {}, expected 0", texture, at,
                               descriptor[at]);
        }
    }
    return {};
}

// Texture `texture` stands at `begin`; moves `begin` to its end.
Status checkMask(const EncodedView& set, uint32_t texture, uint64_t& begin) {
    const uint8_t* descriptor = set.descriptors.data() + bitmask::descriptorBytes * texture;
    if (const auto flags = checkFlags(descriptor, texture); !flags) return flags;
    const auto offset = loadLe<uint32_t>(descriptor);
    if (offset != begin) {
        return formatError("descriptors: texture {}: offset {}, expected {}", texture, offset, begin);
    }
    const BitmaskAxis columns = BitmaskAxis::of(filigree_bitmask_axis_u_(descriptor));
    const BitmaskAxis rows = BitmaskAxis::of(filigree_bitmask_axis_v_(descriptor));
    const uint64_t end = begin + bitmask::maskBytes(columns, rows, set.format);
    if (end > set.payload.size()) {
        return formatError("payload: {} bytes, texture {} needs bytes {} to {}", set.payload.size(), texture,
                           begin, end);
    }
    const uint64_t used = bitmask::cellCount(columns, rows) * micromap::bitsPerState(set.format);
    if (used % 8 != 0 && (set.payload[end - 1] >> (used % 8)) != 0) {
        return formatError("payload: byte {}: spare bits of texture {} are set", end - 1, texture);
    }
    begin = end;
    return {};
}

}  // namespace

Result<BitmaskReader> BitmaskReader::open(const EncodedView& set) {
    if (const auto size = checkDescriptorBytes(set, bitmask::descriptorBytes); !size) return size.error();
    uint64_t end = 0;
    for (uint32_t texture = 0; texture < set.mapCount; ++texture) {
        if (const auto status = checkMask(set, texture, end); !status) return status.error();
    }
    if (end != set.payload.size()) {
        return formatError("payload: {} bytes, expected {} for {} textures", set.payload.size(), end,
                           set.mapCount);
    }
    return BitmaskReader(set, openedAs<filigree_bitmask>(filigree_bitmask_open, set));
}

std::vector<Part> BitmaskReader::parts() const {
    uint64_t states = 0;
    for (uint32_t texture = 0; texture < textureCount(); ++texture) {
        states += bitmask::cellCount(axisU(texture), axisV(texture)) * micromap::bitsPerState(set_.format);
    }
    return {{"states", states},
            {"padding", 8 * uint64_t{set_.payload.size()} - states},
            {"descriptors", 8 * uint64_t{set_.descriptors.size()}}};
}

}  // namespace filigree::encoding
