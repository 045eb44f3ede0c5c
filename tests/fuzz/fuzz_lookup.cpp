// Any bytes as a set or a .fil for filigree_lookup.h: open() stays inside of them; what the library accepts
// is accepted, and every lookup finds what the library's reader finds.
#include "filigree/encoding/bitmask.h"
#include "filigree/encoding/map_reader.h"

#include "exact_bytes.h"
#include "filigree_lookup.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace filigree;
using encoding::EncodedView;

void fail(const char* what) {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
}

void compareMaps(const filigree_view& view, const encoding::MapReader& reader) {
    for (uint32_t map = 0; map < std::min(reader.mapCount(), 16u); ++map) {
        if (filigree_view_level(&view, map) != reader.level(map)) fail("another level");
        const uint64_t last = micromap::microTriangleCount(reader.level(map)) - 1;
        for (unsigned k = 0; k < 32; ++k) {
            const auto index = static_cast<uint32_t>(k * last / 31);
            if (filigree_view_at(&view, map, index) != static_cast<unsigned>(reader.at(map, index)))
                fail("another state");
            const float u = static_cast<float>(k % 5) / 4;
            const float v = static_cast<float>(k) / 32 * (1 - u);
            if (filigree_view_at_point(&view, map, u, v) != static_cast<unsigned>(reader.at(map, u, v)))
                fail("another state at a point");
        }
    }
}

void compareTextures(const filigree_view& view, const encoding::BitmaskReader& reader) {
    for (uint32_t texture = 0; texture < std::min(reader.textureCount(), 16u); ++texture) {
        for (unsigned k = 0; k < 32; ++k) {
            const float u = static_cast<float>(k) / 8 - 2;
            const float v = 1 / (static_cast<float>(k % 7) - 2);
            if (filigree_view_at_point(&view, texture, u, v) !=
                static_cast<unsigned>(reader.at(texture, u, v)))
                fail("another state of a texture");
        }
    }
}

filigree_lookup_error openAll(filigree_view& view, const EncodedView& set) {
    return filigree_view_open(&view, static_cast<unsigned>(set.encoding), static_cast<unsigned>(set.format),
                              set.mapCount, set.descriptors.data(), set.descriptors.size(),
                              set.payload.data(), set.payload.size());
}

void readSet(const EncodedView& set) {
    filigree_view view;
    const filigree_lookup_error error = openAll(view, set);
    if (set.encoding == encoding::Encoding::bitmask) {
        const auto reader = encoding::BitmaskReader::open(set);
        if (!reader) return;
        if (error != FILIGREE_LOOKUP_OK) fail("a good bitmask is refused");
        compareTextures(view, *reader);
    } else {
        const auto reader = encoding::openReader(set);
        if (!reader) return;
        if (error != FILIGREE_LOOKUP_OK) fail("a good set is refused");
        compareMaps(view, **reader);
    }
}

// All that a file tells stays inside of it; squares of any bytes can be looked up.
void readFil(std::span<const uint8_t> bytes) {
    filigree_fil fil;
    if (filigree_fil_open(&fil, bytes.data(), bytes.size()) != FILIGREE_LOOKUP_OK) return;
    uint64_t first = 0;
    uint32_t count = 0;
    static_cast<void>(filigree_fil_triangles(&fil, 0, 0, &first, &count));
    for (uint64_t triangle = 0; triangle < 64; ++triangle) {
        if (filigree_fil_index(&fil, triangle * triangle) < -4) fail("an index is out of range");
        if (filigree_fil_place(&fil, triangle * triangle) > 15) fail("a place is out of range");
    }
    filigree_vq squares;
    if (filigree_vq_open_fil(&squares, &fil) == FILIGREE_LOOKUP_OK) {
        for (uint32_t square = 0; square < std::min(squares.count, 8u); ++square) {
            for (unsigned k = 0; k < 32; ++k) {
                const float u = static_cast<float>(k) / 31;
                if (filigree_vq_at_triangle(&squares, square, k % 16, u, 1 - u) > FILIGREE_VQ_OPAQUE)
                    fail("a region is no state");
            }
        }
    }
    if (fil.encoding < encoding::encodingCount && (fil.format == 1 || fil.format == 2)) {
        readSet({static_cast<encoding::Encoding>(fil.encoding),
                 static_cast<micromap::Format>(fil.format),
                 fil.map_count,
                 {fil.descriptors.bytes, fil.descriptors.size},
                 {fil.payload.bytes, fil.payload.size}});
    }
}

}  // namespace

// A .fil; or, where it does not begin as one, encoding, format, number of maps (2 bytes), bytes of
// descriptors (2 bytes), then both blocks.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    if (size < 6) return 0;
    if (data[0] == 0x89) {
        readFil(tests::ExactBytes({data, size}).view());
        return 0;
    }
    const std::span<const uint8_t> blocks(data + 6, size - 6);
    const size_t descriptorBytes = std::min<size_t>(data[4] | data[5] << 8, blocks.size());
    const tests::ExactBytes descriptors(blocks.first(descriptorBytes));
    const tests::ExactBytes payload(blocks.subspan(descriptorBytes));
    readSet({static_cast<encoding::Encoding>(data[0] % encoding::encodingCount),
             (data[1] & 1) != 0 ? micromap::Format::twoState : micromap::Format::fourState,
             static_cast<uint32_t>(data[2] | data[3] << 8), descriptors.view(), payload.view()});
    return 0;
}
