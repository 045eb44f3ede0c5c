#include "filigree/encoding/flat.h"

#include "encoding/checks.h"

namespace filigree::encoding {

using micromap::Format;

namespace {

// The bits behind the last state of a map are zero. Only levels 0 and 1 have some.
Status checkSpareBits(const EncodedView& set, uint32_t map, uint64_t begin, unsigned level) {
    const uint64_t used = micromap::microTriangleCount(level) * micromap::bitsPerState(set.format);
    if (used % 8 == 0 || (set.payload[begin + used / 8] >> (used % 8)) == 0) return {};
    return formatError("payload: byte {}: spare bits of map {} are set", begin + used / 8, map);
}

// Map `map` stands at `begin`; moves `begin` to its end.
Status checkMap(const EncodedView& set, uint32_t map, uint64_t& begin) {
    const uint8_t* record = set.descriptors.data() + micromap::recordBytes * map;
    const uint64_t offset = loadLe<uint32_t>(record);
    const unsigned level = loadLe<uint16_t>(record + 4);
    const unsigned format = loadLe<uint16_t>(record + 6);
    if (offset != begin)
        return formatError("descriptors: map {}: offset {}, expected {}", map, offset, begin);
    if (level > micromap::maxLevel) {
        return formatError("descriptors: map {}: level {}, expected at most {}", map, level,
                           micromap::maxLevel);
    }
    if (format != static_cast<unsigned>(set.format)) {
        return formatError("descriptors: map {}: format {}, expected {} as the set", map, format,
                           static_cast<unsigned>(set.format));
    }
    const uint64_t bytes = micromap::flatBytes(level, set.format);
    if (bytes > set.payload.size() - begin) {
        return formatError("payload: {} bytes, map {} needs bytes {} to {}", set.payload.size(), map, begin,
                           begin + bytes);
    }
    if (const auto spare = checkSpareBits(set, map, begin, level); !spare) return spare;
    begin += bytes;
    return {};
}

}  // namespace

Result<FlatReader> FlatReader::open(const EncodedView& set) {
    if (const auto size = checkDescriptorBytes(set, micromap::recordBytes); !size) return size.error();
    uint64_t end = 0;
    for (uint32_t map = 0; map < set.mapCount; ++map) {
        if (const auto status = checkMap(set, map, end); !status) return status.error();
    }
    if (end != set.payload.size()) {
        return formatError("payload: {} bytes, expected {} for {} maps", set.payload.size(), end,
                           set.mapCount);
    }
    return FlatReader(set);
}

micromap::Quadtree FlatReader::decode(uint32_t map) const {
    const uint64_t bytes = micromap::flatBytes(level(map), set_.format);
    return micromap::quadtreeFromFlat(set_.payload.subspan(offset(map), bytes), level(map), set_.format);
}

std::vector<Part> FlatReader::parts() const {
    uint64_t states = 0;
    for (uint32_t map = 0; map < mapCount(); ++map) {
        states += micromap::microTriangleCount(level(map)) * micromap::bitsPerState(set_.format);
    }
    return {{"states", states},
            {"padding", 8 * uint64_t{set_.payload.size()} - states},
            {"descriptors", 8 * uint64_t{set_.descriptors.size()}}};
}

}  // namespace filigree::encoding
