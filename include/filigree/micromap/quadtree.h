// Micromaps as quadtrees: what the baker makes and every encoder takes. A uniform part of any size is one
// leaf, so a level-12 micromap costs what its outline costs.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/bits.h"
#include "filigree/micromap/state.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace filigree::micromap {

// A bit stream, depth first, child 0 first. A node above the finest level is bit 1 and its four children, or
// bit 0 and a 2-bit state for the whole of it; a node at the finest level is the 2-bit state alone.
// Canonical: four children that are leaves of one state never stand; they are their parent's leaf. So equal
// micromaps of one level have equal streams.
struct QuadtreeView {
    std::span<const uint64_t> words;  // unused high bits of the last word are zero
    size_t bits = 0;
    unsigned level = 0;  // 0..maxLevel
};

// True when all of a quadtree is one leaf.
FILIGREE_API bool isUniform(const QuadtreeView& tree);

// The state of a uniform quadtree.
FILIGREE_API State uniformState(const QuadtreeView& tree);

// True when both hold the same states at the same level.
FILIGREE_API bool equal(const QuadtreeView& a, const QuadtreeView& b);

// A hash of level and states, the same on every machine.
FILIGREE_API uint64_t hash(const QuadtreeView& tree);

// Calls leaf(first, depth, state) for each leaf in curve order: it covers the 4^(level - depth)
// micro-triangles from curve index `first` on.
template <class Leaf>
void forEachLeaf(const QuadtreeView& tree, Leaf&& leaf) {
    BitReader reader(tree.words, tree.bits);
    uint64_t first = 0;
    unsigned depth = 0;
    const uint64_t count = microTriangleCount(tree.level);
    while (first < count) {
        if (depth < tree.level && reader.takeBit()) {
            ++depth;
            continue;
        }
        leaf(first, depth, static_cast<State>(reader.take(2)));
        first += microTriangleCount(tree.level - depth);
        // Climb to the ancestor that has another child to come.
        while (depth > 0 && (first & (microTriangleCount(tree.level - depth + 1) - 1)) == 0) --depth;
    }
}

// Writes the flat micromap: flatBytes(level, format) bytes at `to`, one state after another in curve order,
// least significant bits first, by filling runs. 2-state keeps bit 0 of each state.
FILIGREE_API void writeFlat(const QuadtreeView& tree, Format format, std::span<uint8_t> to);

// The quadtree of a flat micromap of flatBytes(level, format) bytes. Spare bits of the last byte are ignored.
class Quadtree;
FILIGREE_API Quadtree quadtreeFromFlat(std::span<const uint8_t> flat, unsigned level, Format format);

// The same micromap at a coarser level, 0 <= level <= tree.level: a micro-triangle is known where all it
// covers is known alike. The opaque side of an unknown one is that of the greater part, opaque on a tie.
FILIGREE_API Quadtree coarsened(const QuadtreeView& tree, unsigned level, Format format = Format::fourState);

// An order of a triangle's vertices: new vertex k is old vertex order[k].
using VertexOrder = std::array<uint8_t, 3>;

// The micromap of the same triangle with its vertices in another order.
FILIGREE_API Quadtree permuted(const QuadtreeView& tree, const VertexOrder& order);

// How many micro-triangles have each state, by State.
struct StateCounts {
    uint64_t of[4] = {0, 0, 0, 0};
    [[nodiscard]] uint64_t total() const { return of[0] + of[1] + of[2] + of[3]; }
    [[nodiscard]] uint64_t known() const { return of[0] + of[1]; }
    void add(const StateCounts& other) {
        for (size_t s = 0; s < 4; ++s) of[s] += other.of[s];
    }
};
FILIGREE_API StateCounts countStates(const QuadtreeView& tree);

// One micromap that owns its stream.
class Quadtree {
  public:
    Quadtree() = default;
    Quadtree(BitWriter stream, unsigned level) : stream_(std::move(stream)), level_(level) {}
    [[nodiscard]] QuadtreeView view() const { return {stream_.words(), stream_.size(), level_}; }

  private:
    BitWriter stream_;
    unsigned level_ = 0;
};

// Many micromaps in one block of memory.
class FILIGREE_API QuadtreeList {
  public:
    void push(const QuadtreeView& tree);
    [[nodiscard]] size_t size() const { return entries_.size(); }
    [[nodiscard]] QuadtreeView operator[](size_t index) const {
        const Entry& e = entries_[index];
        return {std::span(words_).subspan(e.word, (e.bits + 63) / 64), e.bits, e.level};
    }
    [[nodiscard]] size_t memoryBytes() const {
        return words_.capacity() * sizeof(uint64_t) + entries_.capacity() * sizeof(Entry);
    }

  private:
    struct Entry {
        size_t word;
        uint32_t bits;
        uint32_t level;
    };
    std::vector<uint64_t> words_;
    std::vector<Entry> entries_;
};

}  // namespace filigree::micromap
