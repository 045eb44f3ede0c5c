#include "encoding/records.h"

#include "encoding/checks.h"

namespace filigree::encoding {
namespace {

uint64_t stateBits(const EncodedView& set, unsigned level) {
    return micromap::microTriangleCount(level) * micromap::bitsPerState(set.format);
}

// Only levels 0 and 1 have spare bits.
Status checkSpareBits(const EncodedView& set, uint32_t map, const MapRecord& record) {
    const uint64_t used = stateBits(set, record.level);
    const uint64_t last = record.offset + used / 8;
    if (used % 8 == 0 || (set.payload[last] >> (used % 8)) == 0) return {};
    return formatError("payload: byte {}: spare bits of map {} are set", last, map);
}

// Map `map` stands at `begin`; moves `begin` to its end.
Status checkRecord(const EncodedView& set, std::string_view name, unsigned form, uint32_t map,
                   uint64_t& begin) {
    const MapRecord record = recordOf(set, map);
    if (record.offset != begin)
        return formatError("descriptors: map {}: offset {}, expected {}", map, record.offset, begin);
    if (record.level > micromap::maxLevel) {
        return formatError("descriptors: map {}: level {}, expected at most {}", map, record.level,
                           micromap::maxLevel);
    }
    if (record.form != form)
        return formatError("descriptors: map {}: {} {}, expected {} as the set", map, name, record.form,
                           form);
    const uint64_t end = begin + micromap::flatBytes(record.level, set.format);
    if (end > set.payload.size()) {
        return formatError("payload: {} bytes, map {} needs bytes {} to {}", set.payload.size(), map, begin,
                           end);
    }
    begin = end;
    return checkSpareBits(set, map, record);
}

}  // namespace

Status checkRecords(const EncodedView& set, std::string_view name, unsigned form) {
    uint64_t end = 0;
    for (uint32_t map = 0; map < set.mapCount; ++map) {
        if (const auto status = checkRecord(set, name, form, map, end); !status) return status;
    }
    if (end == set.payload.size()) return {};
    return formatError("payload: {} bytes, expected {} for {} maps", set.payload.size(), end, set.mapCount);
}

std::vector<Part> partsOfRecords(const EncodedView& set) {
    uint64_t states = 0;
    for (uint32_t map = 0; map < set.mapCount; ++map) states += stateBits(set, recordOf(set, map).level);
    return {{"states", states},
            {"padding", 8 * uint64_t{set.payload.size()} - states},
            {"descriptors", 8 * uint64_t{set.descriptors.size()}}};
}

}  // namespace filigree::encoding
