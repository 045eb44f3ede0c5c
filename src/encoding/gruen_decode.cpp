#include "filigree/encoding/gruen.h"
#include "filigree/micromap/quadtree_writer.h"

#include "encoding/checks.h"
#include "encoding/gruen_layout.h"

namespace filigree::encoding {
namespace {

using micromap::Format;

struct Record {
    uint32_t offset = 0;
    uint16_t level = 0;
    uint16_t form = 0;
};

Record recordOf(const EncodedView& set, uint32_t map) {
    const uint8_t* from = set.descriptors.data() + micromap::recordBytes * map;
    return {loadLe<uint32_t>(from), loadLe<uint16_t>(from + 4), loadLe<uint16_t>(from + 6)};
}

// The form that all records of a set have.
uint16_t formOf(const EncodedView& set) {
    if (set.format == Format::fourState) return gruen::threeStates;
    const bool maybe = set.mapCount > 0 && recordOf(set, 0).form == gruen::maybeOpaque;
    return maybe ? gruen::maybeOpaque : gruen::sides;
}

Status checkStates(const EncodedView& set, uint32_t map, uint64_t begin, uint64_t end) {
    const uint64_t used =
        micromap::microTriangleCount(recordOf(set, map).level) * micromap::bitsPerState(set.format);
    if (used % 8 != 0 && (set.payload[end - 1] >> (used % 8)) != 0) {
        return formatError("payload: byte {}: spare bits of map {} are set", end - 1, map);
    }
    if (set.format == Format::twoState) return {};
    for (uint64_t at = begin; at < end; ++at) {
        const unsigned byte = set.payload[at];
        if (((byte >> 1) & ~byte & 0x55) == 0) continue;
        return formatError("payload: byte {}: value 2 in map {}, expected 0, 1 or 3", at, map);
    }
    return {};
}

// Map `map` stands at `begin`; moves `begin` to its end.
Status checkMap(const EncodedView& set, uint32_t map, uint16_t form, uint64_t& begin) {
    const Record record = recordOf(set, map);
    if (record.offset != begin) {
        return formatError("descriptors: map {}: offset {}, expected {}", map, record.offset, begin);
    }
    if (record.level > micromap::maxLevel) {
        return formatError("descriptors: map {}: level {}, expected at most {}", map, record.level,
                           micromap::maxLevel);
    }
    if (record.form != form) {
        return formatError("descriptors: map {}: form {}, expected {} as the set", map, record.form, form);
    }
    const uint64_t end = begin + micromap::flatBytes(record.level, set.format);
    if (end > set.payload.size()) {
        return formatError("payload: {} bytes, map {} needs bytes {} to {}", set.payload.size(), map, begin,
                           end);
    }
    if (const auto status = checkStates(set, map, begin, end); !status) return status;
    begin = end;
    return {};
}

}  // namespace

Result<GruenReader> GruenReader::open(const EncodedView& set) {
    if (const auto size = checkDescriptorBytes(set, micromap::recordBytes); !size) return size.error();
    const uint16_t form = formOf(set);
    uint64_t end = 0;
    for (uint32_t map = 0; map < set.mapCount; ++map) {
        if (const auto status = checkMap(set, map, form, end); !status) return status.error();
    }
    if (end != set.payload.size()) {
        return formatError("payload: {} bytes, expected {} for {} maps", set.payload.size(), end,
                           set.mapCount);
    }
    return GruenReader(set, form == gruen::maybeOpaque);
}

namespace {

int appendPart(const GruenReader& reader, uint32_t map, uint32_t first, unsigned height, BitWriter& to) {
    if (height == 0) return micromap::appendLeaf(to, 0, static_cast<int>(reader.at(map, first)));
    const auto quarter = static_cast<uint32_t>(micromap::microTriangleCount(height - 1));
    return micromap::appendInner(
        to, height, [&](unsigned k) { return appendPart(reader, map, first + k * quarter, height - 1, to); });
}

}  // namespace

micromap::Quadtree GruenReader::decode(uint32_t map) const {
    BitWriter stream;
    appendPart(*this, map, 0, level(map), stream);
    return {std::move(stream), level(map)};
}

std::vector<Part> GruenReader::parts() const {
    uint64_t states = 0;
    for (uint32_t map = 0; map < mapCount(); ++map) {
        states += micromap::microTriangleCount(level(map)) * micromap::bitsPerState(set_.format);
    }
    return {{"states", states},
            {"padding", 8 * uint64_t{set_.payload.size()} - states},
            {"descriptors", 8 * uint64_t{set_.descriptors.size()}}};
}

}  // namespace filigree::encoding
