#include "filigree/encoding/gruen.h"
#include "filigree/micromap/quadtree_writer.h"

#include "encoding/checks.h"
#include "encoding/gruen_layout.h"
#include "encoding/records.h"

namespace filigree::encoding {
namespace {

using micromap::Format;

// The form that all records of a set have.
uint16_t formOf(const EncodedView& set) {
    if (set.format == Format::fourState) return gruen::threeStates;
    const bool maybe = set.mapCount > 0 && recordOf(set, 0).form == gruen::maybeOpaque;
    return maybe ? gruen::maybeOpaque : gruen::sides;
}

// The value 2 stands for nothing.
Status checkThreeStates(const EncodedView& set) {
    for (uint32_t map = 0; map < set.mapCount; ++map) {
        const MapRecord record = recordOf(set, map);
        const uint64_t end = record.offset + micromap::flatBytes(record.level, set.format);
        for (uint64_t at = record.offset; at < end; ++at) {
            const unsigned byte = set.payload[at];
            if (((byte >> 1) & ~byte & 0x55) == 0) continue;
            return formatError("payload: byte {}: value 2 in map {}, expected 0, 1 or 3", at, map);
        }
    }
    return {};
}

}  // namespace

Result<GruenReader> GruenReader::open(const EncodedView& set) {
    if (const auto size = checkDescriptorBytes(set, micromap::recordBytes); !size) return size.error();
    const uint16_t form = formOf(set);
    if (const auto records = checkRecords(set, "form", form); !records) return records.error();
    if (set.format == Format::fourState) {
        if (const auto states = checkThreeStates(set); !states) return states.error();
    }
    return GruenReader(set, openedAs<filigree_gruen>(filigree_gruen_open, set));
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
    return partsOfRecords(set_);
}

}  // namespace filigree::encoding
