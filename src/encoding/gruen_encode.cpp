#include "filigree/core/bytes.h"
#include "filigree/core/stage.h"
#include "filigree/encoding/gruen.h"

#include "encoding/checks.h"
#include "encoding/gruen_layout.h"

#include <cstring>

namespace filigree::encoding {
namespace {

using micromap::Format;
using micromap::LatticeTriangle;
using micromap::State;

// One map's mask.
struct Mask {
    std::span<uint8_t> bytes;  // zero so far
    unsigned bits;             // of a value

    // Sets `count` values from place `first` on, which are 0, to `value`.
    void fill(uint32_t first, uint32_t count, unsigned value) {
        static constexpr unsigned patterns[4] = {0x00, 0x55, 0xaa, 0xff};
        const unsigned pattern = bits == 1 ? 0xff * value : patterns[value];
        const uint32_t begin = first * bits;
        const uint32_t end = begin + count * bits;
        const unsigned low = 0xffu << (begin % 8);
        const unsigned high = ~(0xffu << (end % 8));
        if (begin / 8 == end / 8) {
            bytes[begin / 8] |= static_cast<uint8_t>(pattern & low & high);
            return;
        }
        bytes[begin / 8] |= static_cast<uint8_t>(pattern & low);
        std::memset(bytes.data() + begin / 8 + 1, static_cast<int>(pattern), end / 8 - begin / 8 - 1);
        if (end % 8 != 0) bytes[end / 8] |= static_cast<uint8_t>(pattern & high);
    }

    // Sets all micro-triangles of a part: one of the triangles of a lattice `side` times as coarse. In each
    // row of the mask they are one run.
    void fill(LatticeTriangle part, uint32_t side, unsigned value) {
        const uint32_t i = part.i * side;
        const uint32_t j = part.j * side;
        for (uint32_t k = 0; k < side; ++k) {
            if (part.flipped) {
                const uint32_t row = i + j + side + k;
                fill(row * row + 2 * (j + k) + 1, 2 * (side - k) - 1, value);
            } else {
                const uint32_t row = i + j + k;
                fill(row * row + 2 * j, 2 * k + 1, value);
            }
        }
    }
};

unsigned valueOf(State state, uint16_t form) {
    switch (form) {
        case gruen::sides:
            return micromap::isOpaqueSide(state) ? 1 : 0;
        case gruen::maybeOpaque:
            return state == State::transparent ? 0 : 1;
        default:
            return static_cast<unsigned>(micromap::isKnown(state) ? state : State::unknownOpaque);
    }
}

void writeMask(const micromap::QuadtreeView& map, uint16_t form, Mask mask) {
    micromap::forEachLeaf(map, [&](uint64_t first, unsigned depth, State state) {
        const unsigned value = valueOf(state, form);
        if (value == 0) return;
        const unsigned height = map.level - depth;
        const auto part = static_cast<uint32_t>(first >> (2 * height));
        mask.fill(micromap::latticeTriangle(part, depth), 1u << height, value);
    });
}

uint16_t formOf(Format format, GruenBit bit) {
    if (format == Format::fourState) return gruen::threeStates;
    return bit == GruenBit::maybeOpaque ? gruen::maybeOpaque : gruen::sides;
}

}  // namespace

Result<EncodedSet> encodeGruen(std::span<const micromap::QuadtreeView> maps, Format format, GruenBit bit,
                               const Executor& executor, ProgressSink& progress) {
    const Stage stage(executor, progress, "encode", maps.size(), "micromaps");
    std::vector<uint64_t> offsets{0};
    for (const auto& map : maps) offsets.push_back(offsets.back() + micromap::flatBytes(map.level, format));
    if (const auto reach = checkOffsetsReach(Encoding::gruen, offsets.back()); !reach) return reach.error();

    const uint16_t form = formOf(format, bit);
    EncodedSet set{Encoding::gruen, format, static_cast<uint32_t>(maps.size()), {}, {}};
    set.descriptors.resize(micromap::recordBytes * maps.size());
    set.payload.resize(offsets.back());
    stage.parallelFor(maps.size(), 16, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k) {
            uint8_t* record = set.descriptors.data() + micromap::recordBytes * k;
            storeLe(record, static_cast<uint32_t>(offsets[k]));
            storeLe(record + 4, static_cast<uint16_t>(maps[k].level));
            storeLe(record + 6, form);
            const auto bytes = std::span(set.payload).subspan(offsets[k], offsets[k + 1] - offsets[k]);
            writeMask(maps[k], form, {bytes, micromap::bitsPerState(format)});
        }
        stage.advance(end - begin);
    });
    if (const Status status = stage.status(); !status) return status.error();
    return set;
}

}  // namespace filigree::encoding
