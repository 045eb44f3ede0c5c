#include "filigree/micromap/quadtree.h"

#include "filigree/micromap/quadtree_writer.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include <xxhash.h>

namespace filigree::micromap {
namespace {

// Sets `count` bits from bit `first` on. Runs are whole bytes or lie inside one byte, since they start at
// multiples of their power-of-two length.
void setBits(std::span<uint8_t> bytes, uint64_t first, uint64_t count, uint8_t pattern) {
    if (count >= 8) {
        std::memset(bytes.data() + first / 8, pattern, count / 8);
    } else {
        const unsigned mask = ((1u << count) - 1) << (first % 8);
        bytes[first / 8] = static_cast<uint8_t>((bytes[first / 8] & ~mask) | (pattern & mask));
    }
}

int treeFromFlat(std::span<const uint8_t> flat, Format format, uint64_t first, unsigned height,
                 BitWriter& to) {
    if (height == 0) {
        const unsigned bits = bitsPerState(format);
        const unsigned value = flat[first * bits / 8] >> (first * bits % 8);
        return appendLeaf(to, 0, static_cast<int>(value & ((1u << bits) - 1)));
    }
    const uint64_t quarter = microTriangleCount(height - 1);
    return appendInner(to, height, [&](unsigned k) {
        return treeFromFlat(flat, format, first + k * quarter, height - 1, to);
    });
}

}  // namespace

bool isUniform(const QuadtreeView& tree) {
    return tree.bits == (tree.level > 0 ? 3u : 2u);
}

State uniformState(const QuadtreeView& tree) {
    assert(isUniform(tree));
    return static_cast<State>((tree.words[0] >> (tree.level > 0 ? 1 : 0)) & 3);
}

bool equal(const QuadtreeView& a, const QuadtreeView& b) {
    return a.level == b.level && a.bits == b.bits && std::ranges::equal(a.words, b.words);
}

uint64_t hash(const QuadtreeView& tree) {
    return XXH3_64bits_withSeed(tree.words.data(), tree.words.size_bytes(), tree.level);
}

void writeFlat(const QuadtreeView& tree, Format format, std::span<uint8_t> to) {
    assert(to.size() == flatBytes(tree.level, format));
    static constexpr uint8_t patterns[4] = {0x00, 0x55, 0xaa, 0xff};
    std::ranges::fill(to, uint8_t{0});
    forEachLeaf(tree, [&](uint64_t first, unsigned depth, State state) {
        const uint64_t count = microTriangleCount(tree.level - depth);
        if (format == Format::fourState) {
            setBits(to, 2 * first, 2 * count, patterns[static_cast<size_t>(state)]);
        } else {
            setBits(to, first, count, isOpaqueSide(state) ? 0xff : 0x00);
        }
    });
}

Quadtree quadtreeFromFlat(std::span<const uint8_t> flat, unsigned level, Format format) {
    assert(level <= maxLevel && flat.size() >= flatBytes(level, format));
    BitWriter stream;
    treeFromFlat(flat, format, 0, level, stream);
    return {std::move(stream), level};
}

StateCounts countStates(const QuadtreeView& tree) {
    StateCounts counts;
    forEachLeaf(tree, [&](uint64_t, unsigned depth, State state) {
        counts.of[static_cast<size_t>(state)] += microTriangleCount(tree.level - depth);
    });
    return counts;
}

void QuadtreeList::push(const QuadtreeView& tree) {
    entries_.push_back({words_.size(), static_cast<uint32_t>(tree.bits), tree.level});
    words_.insert(words_.end(), tree.words.begin(), tree.words.end());
}

}  // namespace filigree::micromap
