// Any bytes as an encoded set: an error, or every lookup stays inside and agrees with the others.
#include "filigree/core/target.h"
#include "filigree/encoding/map_reader.h"

#include "exact_bytes.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

using namespace filigree;
using encoding::EncodedView;
using encoding::MapReader;
using micromap::State;

void fail(const char* what) {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
}

struct Points {
    std::vector<uint32_t> maps, indices;
    std::vector<float> u, v;
};

Points pointsIn(const MapReader& reader) {
    Points points;
    for (uint32_t map = 0; map < std::min(reader.mapCount(), 16u); ++map) {
        const uint64_t last = micromap::microTriangleCount(reader.level(map)) - 1;
        for (unsigned k = 0; k < 16; ++k) {
            points.maps.push_back(map);
            points.indices.push_back(static_cast<uint32_t>(k * last / 15));
            points.u.push_back(static_cast<float>(k % 4) / 3);
            points.v.push_back(static_cast<float>(k) / 16 * (1 - points.u.back()));
        }
    }
    return points;
}

void compareLookups(const MapReader& reader) {
    const Points points = pointsIn(reader);
    const size_t count = points.maps.size();
    std::vector<State> byIndex(count);
    std::vector<State> byPoint(count);
    reader.lookup(points.maps, points.indices, byIndex);
    reader.lookup(points.maps, points.u, points.v, byPoint);
    for (size_t k = 0; k < count; ++k) {
        if (byIndex[k] != reader.at(points.maps[k], points.indices[k])) fail("a batch differs from at()");
        if (byPoint[k] != reader.at(points.maps[k], points.u[k], points.v[k]))
            fail("a batch of points differs");
    }
}

// Decodes small maps, and finds in them what at() finds.
void decodeSome(const MapReader& reader) {
    for (uint32_t map = 0; map < std::min(reader.mapCount(), 8u); ++map) {
        const unsigned level = reader.level(map);
        if (level > micromap::maxLevel) fail("a level is out of range");
        if (level > 5) continue;
        uint64_t next = 0;
        const auto tree = reader.decode(map);
        forEachLeaf(tree.view(), [&](uint64_t first, unsigned depth, State state) {
            if (reader.at(map, static_cast<uint32_t>(first)) != state) fail("decode() differs from at()");
            next = first + micromap::microTriangleCount(level - depth);
        });
        if (next != micromap::microTriangleCount(level)) fail("decode() does not cover the map");
    }
}

void askShares(const MapReader& reader) {
    for (uint32_t map = 0; map < std::min(reader.mapCount(), 4u); ++map) {
        const unsigned level = reader.level(map);
        if (level > 6) continue;
        for (unsigned coarse = 0; coarse <= level; ++coarse) {
            const float share = reader.opaqueShare(map, 0, coarse);
            if (!(share >= 0 && share <= 1)) fail("a share is out of range");
        }
    }
}

}  // namespace

// Encoding, format and target, number of maps (2 bytes), bytes of descriptors (2 bytes), then both blocks.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    if (size < 6) return 0;
    const std::span<const uint8_t> blocks(data + 6, size - 6);
    const size_t descriptorBytes = std::min<size_t>(data[4] | data[5] << 8, blocks.size());
    const tests::ExactBytes descriptors(blocks.first(descriptorBytes));
    const tests::ExactBytes payload(blocks.subspan(descriptorBytes));
    const EncodedView set{static_cast<encoding::Encoding>(data[0] % encoding::encodingCount),
                          (data[1] & 1) != 0 ? micromap::Format::twoState : micromap::Format::fourState,
                          static_cast<uint32_t>(data[2] | data[3] << 8), descriptors.view(), payload.view()};
    // Sanitizers see no gathers; so half of the inputs run on the scalar target.
    static_cast<void>(forceTarget((data[1] & 2) != 0 ? "best" : "scalar").ok());

    const auto reader = encoding::openReader(set);
    if (!reader) return 0;
    compareLookups(**reader);
    decodeSome(**reader);
    askShares(**reader);
    uint64_t bits = 0;
    for (const encoding::Part& part : (*reader)->parts()) bits += part.bits;
    if (bits != 8 * uint64_t{set.descriptors.size() + set.payload.size()}) fail("parts do not add up");
    return 0;
}
