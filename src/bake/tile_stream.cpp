// Tiles as quadtree streams.

#include "filigree/micromap/quadtree_writer.h"

#include "bake/tile.h"

namespace filigree::bake {
namespace {

// A stretch of a tile's bits: `length` states that start at a multiple of it.
struct Bits {
    uint64_t unknown = 0;
    uint64_t side = 0;
};

// The state of all of them, or -1. `full` has their bits set.
int uniformState(const Bits& bits, uint64_t full) {
    const bool alike = (bits.unknown == 0 || bits.unknown == full) && (bits.side == 0 || bits.side == full);
    if (!alike) return -1;
    return (bits.side != 0 ? 1 : 0) + (bits.unknown != 0 ? 2 : 0);
}

Bits part(const Bits& bits, unsigned first, unsigned count) {
    const uint64_t mask = (uint64_t{1} << count) - 1;
    return {(bits.unknown >> first) & mask, (bits.side >> first) & mask};
}

// A few bits of stream gathered in a register.
struct Code {
    uint64_t bits = 0;
    unsigned count = 0;
    void append(uint64_t more, unsigned moreCount) {
        bits |= more << count;
        count += moreCount;
    }
};

// Four micro-triangles at the finest level: a leaf, or bit 1 and four states. Indexed by unknown * 16 + side.
struct QuadCodes {
    std::array<uint16_t, 256> bits{};
    std::array<uint8_t, 256> count{};
};

constexpr QuadCodes makeQuadCodes() {
    QuadCodes codes;
    for (unsigned unknown = 0; unknown < 16; ++unknown) {
        for (unsigned side = 0; side < 16; ++side) {
            const unsigned at = unknown * 16 + side;
            if ((unknown == 0 || unknown == 15) && (side == 0 || side == 15)) {
                codes.bits[at] = static_cast<uint16_t>(((side & 1) | (unknown & 1) << 1) << 1);
                codes.count[at] = 3;
                continue;
            }
            unsigned bits = 1;
            for (unsigned k = 0; k < 4; ++k) {
                bits |= (((side >> k) & 1) | ((unknown >> k) & 1) << 1) << (1 + 2 * k);
            }
            codes.bits[at] = static_cast<uint16_t>(bits);
            codes.count[at] = 9;
        }
    }
    return codes;
}

constexpr QuadCodes quadCodes = makeQuadCodes();

void appendQuad(const Bits& bits, Code& code) {
    const size_t at = bits.unknown * 16 + bits.side;
    code.append(quadCodes.bits[at], quadCodes.count[at]);
}

// Sixteen micro-triangles: at most 1 + 4 * 9 bits.
void appendSixteen(const Bits& bits, BitWriter& stream) {
    Code code;
    if (const int state = uniformState(bits, 0xffff); state >= 0) {
        code.append(static_cast<uint64_t>(state) << 1, 3);
    } else {
        code.append(1, 1);
        for (unsigned k = 0; k < 4; ++k) appendQuad(part(bits, 4 * k, 4), code);
    }
    stream.append(code.bits, code.count);
}

// Sixty-four micro-triangles: one word of each plane.
int appendWord(const Bits& bits, BitWriter& stream) {
    if (const int state = uniformState(bits, ~uint64_t{0}); state >= 0)
        return micromap::appendLeaf(stream, 3, state);
    stream.append(1, 1);
    for (unsigned k = 0; k < 4; ++k) appendSixteen(part(bits, 16 * k, 16), stream);
    return -1;
}

// A node of 4^height micro-triangles, height >= 3, from word `word` on.
template <class WordAt>
int appendNode(size_t word, unsigned height, WordAt&& wordAt, BitWriter& stream) {
    if (height == 3) return appendWord(wordAt(word), stream);
    const size_t quarter = size_t{1} << (2 * height - 8);
    return micromap::appendInner(stream, height, [&](unsigned k) {
        return appendNode(word + k * quarter, height - 1, wordAt, stream);
    });
}

// Tiles smaller than a word.
int appendSmall(const Bits& bits, unsigned height, BitWriter& stream) {
    const unsigned count = 1u << (2 * height);
    const int state = uniformState(bits, (uint64_t{1} << count) - 1);
    if (state >= 0) return micromap::appendLeaf(stream, height, state);
    if (height == 2) {
        appendSixteen(bits, stream);
    } else {
        Code code;
        appendQuad(bits, code);
        stream.append(code.bits, code.count);
    }
    return -1;
}

}  // namespace

int appendTile(const Tile& tile, bool twoState, BitWriter& stream) {
    const auto wordAt = [&](size_t k) {
        return Bits{twoState ? 0 : tile.unknown.word(k), tile.side.word(k)};
    };
    if (tile.height >= 3) return appendNode(0, tile.height, wordAt, stream);
    return appendSmall(part(wordAt(0), 0, tile.count()), tile.height, stream);
}

}  // namespace filigree::bake
