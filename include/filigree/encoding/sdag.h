// Micromaps as one graph whose maps are merged up to the triangle's symmetries, with short codes for the
// parts that occur often: docs/spec/sdag.md.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/bytes.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/encoding/rank.h"
#include "filigree/micromap/quadtree.h"
#include "filigree/micromap/symmetry.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace filigree::encoding {

// MapReader's functions without virtual calls; see there for ranges. A lookup reads a descriptor, one node
// for two levels above height 4, one reference, and one leaf with two small tables.
class FILIGREE_API SdagReader {
  public:
    // Checks all of `set` and looks into its blocks from then on.
    static Result<SdagReader> open(const EncodedView& set);

    [[nodiscard]] uint32_t mapCount() const { return set_.mapCount; }
    [[nodiscard]] unsigned level(uint32_t map) const { return levelOf(descriptor(map)); }
    [[nodiscard]] micromap::State at(uint32_t map, uint32_t index) const {
        const uint64_t from = descriptor(map);
        return stateOf(from, micromap::planesOfIndex(index, levelOf(from)));
    }
    [[nodiscard]] micromap::State at(uint32_t map, float u, float v) const {
        const uint64_t from = descriptor(map);
        const unsigned level = levelOf(from);
        return stateOf(from, micromap::planesOf(micromap::curveCoordinates(u, v, level), level));
    }
    void lookup(std::span<const uint32_t> maps, std::span<const uint32_t> indices,
                std::span<micromap::State> states) const;
    void lookup(std::span<const uint32_t> maps, std::span<const float> u, std::span<const float> v,
                std::span<micromap::State> states) const;

    // From the stored shares where there are some (to within 1/65535), else counted, which takes as long as
    // the part has nodes.
    [[nodiscard]] float opaqueShare(uint32_t map, uint32_t index, unsigned level) const;

    // Bits of at() (docs/spec/bits-read.md).
    [[nodiscard]] uint64_t bitsRead(uint32_t map, uint32_t index) const;
    [[nodiscard]] micromap::Quadtree decode(uint32_t map) const;
    [[nodiscard]] std::vector<Part> parts() const;

    // What the batched lookups need of the layout; offsets count from the payload's begin.
    struct Layout {
        unsigned levelBits = 0;
        unsigned flatBit = 0;  // 1 where descriptors tell flat maps apart, else 0
        unsigned valueBits = 0;
        unsigned descriptorBits = 0;
        unsigned nodeBytes = 0;
        unsigned referenceBits = 0;
        bool hasShares = false;
        std::array<uint8_t, 16> levels{};  // by level number
        uint64_t patterns = 0;
        uint64_t heads = 0;
        std::array<uint64_t, 4> nodes{};  // of heights 6, 8, 10, 12
        std::array<uint64_t, 4> nodeShares{};
        uint64_t shared = 0;
        uint64_t blocks = 0;
        uint64_t padding = 0;
        uint64_t flat = 0;
        uint64_t referenceBytes = 0;  // of the blocks
    };
    // The bytes of a leaf, a step of the lookup on the way to one state.
    struct LeafHead {
        uint32_t mixed = 0;
        uint32_t opaque = 0;
        const uint8_t* codes = nullptr;  // null: raw patterns stand at `raw`
        const uint8_t* raw = nullptr;
    };
    struct NodeHead {
        uint32_t mixed = 0;
        uint32_t opaque = 0;  // of a mixed child of height 4: its leaf is shared
        uint32_t base = 0;
    };

  private:
    SdagReader(const EncodedView& set, const Layout& layout)
        : set_(set),
          layout_(layout),
          descriptors_(set.descriptors.data() + headBytes),
          payload_(set.payload.data()),
          fourState_(set.format == micromap::Format::fourState) {}

    static constexpr size_t headBytes = 48;
    static constexpr uint32_t shortCodes = 192;
    static constexpr uint32_t escape = 255;

    friend class SdagWalk;

    // Fields of a descriptor, lowest bits first: level number, flat or not, symmetry, value.
    [[nodiscard]] uint64_t descriptor(uint32_t map) const {
        const uint64_t bit = uint64_t{map} * layout_.descriptorBits;
        return loadLe<uint64_t>(descriptors_ + bit / 8) >> (bit % 8);
    }
    [[nodiscard]] unsigned levelOf(uint64_t descriptor) const {
        // Most sets have one level; then the place of a point need not wait for the descriptor.
        if (layout_.levelBits == 0) [[likely]]
            return layout_.levels[0];
        return layout_.levels[descriptor & ((1u << layout_.levelBits) - 1)];
    }
    [[nodiscard]] bool isFlat(uint64_t descriptor) const {
        return ((descriptor >> layout_.levelBits) & layout_.flatBit) != 0;
    }
    [[nodiscard]] unsigned symmetryOf(uint64_t descriptor) const {
        return (descriptor >> (layout_.levelBits + layout_.flatBit)) & 7;
    }
    [[nodiscard]] uint32_t valueOf(uint64_t descriptor) const {
        return static_cast<uint32_t>((descriptor >> (layout_.levelBits + layout_.flatBit + 3)) &
                                     ((uint64_t{1} << layout_.valueBits) - 1));
    }

    [[nodiscard]] micromap::State flatAt(uint64_t descriptor, uint32_t index) const {
        const uint64_t bit = uint64_t{index} << (fourState_ ? 1 : 0);
        const unsigned byte = payload_[layout_.flat + valueOf(descriptor) + bit / 8];
        return static_cast<micromap::State>((byte >> (bit % 8)) & (fourState_ ? 3 : 1));
    }

    // Which grandchild holds a place, from bits `low` and `low` + 1 of both planes.
    static uint32_t grandchildAt(micromap::Planes p, unsigned low) {
        return ((p.a >> low) & 3) << 2 | ((p.b >> low) & 3);
    }

    [[nodiscard]] NodeHead node(unsigned height, uint32_t number) const {
        const uint64_t bytes =
            loadLe<uint64_t>(payload_ + layout_.nodes[height / 2 - 3] + uint64_t{number} * layout_.nodeBytes);
        const uint64_t baseMask = (uint64_t{1} << (8 * (layout_.nodeBytes - 4))) - 1;
        return {static_cast<uint32_t>(bytes & 0xffff), static_cast<uint32_t>((bytes >> 16) & 0xffff),
                static_cast<uint32_t>((bytes >> 32) & baseMask)};
    }

    // The leaf under mixed child `child` of a node of height 6.
    [[nodiscard]] const uint8_t* leafUnder(const NodeHead& head, uint32_t child) const {
        const uint8_t* block = payload_ + layout_.blocks + head.base;
        const uint32_t shared = head.mixed & head.opaque;
        const uint32_t bit =
            8 * rankOf(head.mixed & ~head.opaque, child) + layout_.referenceBits * rankOf(shared, child);
        const uint64_t reference = loadLe<uint64_t>(block + bit / 8) >> (bit % 8);
        // Which of the two is anybody's guess, so no branch.
        const uint64_t isShared = 0 - uint64_t{(shared >> child) & 1};
        const uint64_t referenceMask = pick(isShared, (uint64_t{1} << layout_.referenceBits) - 1, 255);
        return payload_ + pick(isShared, layout_.shared, layout_.blocks + head.base) +
               (reference & referenceMask);
    }
    // `yes` where `mask` is all ones, `no` where it is 0.
    static uint64_t pick(uint64_t mask, uint64_t yes, uint64_t no) { return no ^ ((no ^ yes) & mask); }

    [[nodiscard]] LeafHead leafHead(const uint8_t* leaf) const {
        const uint32_t first = leaf[0];
        if (first == escape) [[unlikely]]
            return escapedHead(leaf);
        const uint32_t isLong = (first + (256 - shortCodes)) >> 8;
        const auto code = static_cast<uint32_t>(
            pick(0 - uint64_t{isLong}, shortCodes + ((first - shortCodes) << 8 | leaf[1]), first));
        const auto head = loadLe<uint32_t>(payload_ + layout_.heads + size_t{4} * code);
        return {head & 0xffff, head >> 16, leaf + 1 + isLong, nullptr};
    }
    static LeafHead escapedHead(const uint8_t* leaf) {
        if (leaf[1] != 0) return {0xffff, 0, nullptr, leaf + 2};
        const auto head = loadLe<uint32_t>(leaf + 2);
        return {head & 0xffff, head >> 16, leaf + 6, nullptr};
    }

    [[nodiscard]] uint32_t loadPattern(const uint8_t* from) const {
        return fourState_ ? loadLe<uint32_t>(from) : loadLe<uint16_t>(from);
    }
    [[nodiscard]] uint32_t tablePattern(uint32_t code) const {
        return loadPattern(payload_ + layout_.patterns + (size_t{code} << (fourState_ ? 2 : 1)));
    }
    // The pattern of mixed child `child` of a leaf.
    [[nodiscard]] uint32_t patternUnder(const LeafHead& head, uint32_t child) const {
        if (head.codes == nullptr) [[unlikely]]
            return loadPattern(head.raw + (size_t{child} << (fourState_ ? 2 : 1)));
        const uint32_t rank = rankOf(head.mixed, child);
        const uint32_t code = head.codes[rank];
        return code < shortCodes ? tablePattern(code) : longPattern(head, rank);
    }
    // A pattern with more bytes, which stand behind the first bytes of all.
    [[nodiscard]] uint32_t longPattern(const LeafHead& head, uint32_t rank) const {
        const uint8_t* seconds = head.codes + rankOf(head.mixed, 15) + (head.mixed >> 15);
        const uint64_t low = loadLe<uint64_t>(head.codes);
        const uint64_t high = loadLe<uint64_t>(head.codes + 8);
        const uint32_t code = head.codes[rank];
        const uint32_t second = seconds[countBytes(longBytes(low), longBytes(high), rank)];
        if (code != escape) return tablePattern(shortCodes + ((code - shortCodes) << 8 | second));
        const auto all = static_cast<uint32_t>(seconds - head.codes);
        const uint8_t* rest = seconds + countBytes(longBytes(low), longBytes(high), all);
        const uint32_t before = countBytes(escapes(low), escapes(high), rank);
        if (!fourState_) return second | static_cast<uint32_t>(rest[before]) << 8;
        return second | (loadLe<uint32_t>(rest + size_t{3} * before) & 0xffffff) << 8;
    }

    // Bit 7 of each byte that is at least 192, or 255.
    static uint64_t longBytes(uint64_t bytes) { return bytes & (bytes << 1) & 0x8080808080808080u; }
    static uint64_t escapes(uint64_t bytes) {
        const uint64_t low = (bytes & 0x7f7f7f7f7f7f7f7fu) + 0x0101010101010101u;
        return bytes & low & 0x8080808080808080u;
    }
    // How many of the first `count` <= 16 bytes are marked in bit 7.
    static uint32_t countBytes(uint64_t low, uint64_t high, uint32_t count) {
        const uint64_t ones = 0x0101010101010101u;
        low = (low >> 7) & lowBytes(count < 8 ? count : 8);
        high = (high >> 7) & lowBytes(count < 8 ? 0 : count - 8);
        return static_cast<uint32_t>(((low + high) * ones) >> 56);
    }
    static uint64_t lowBytes(uint32_t count) { return count == 0 ? 0 : ~uint64_t{0} >> (64 - 8 * count); }

    [[nodiscard]] static micromap::State known(uint32_t opaque, uint32_t child) {
        return static_cast<micromap::State>((opaque >> child) & 1);
    }

    // `place` in the map's own frame.
    [[nodiscard]] micromap::State stateOf(uint64_t descriptor, micromap::Planes place) const {
        if (!isFlat(descriptor)) [[likely]]
            return stateAt(descriptor, place);
        return flatAt(descriptor, micromap::indexOfPlanes(place, levelOf(descriptor)));
    }
    [[nodiscard]] micromap::State stateAt(uint64_t descriptor, micromap::Planes place) const {
        const micromap::Planes p = micromap::turned(place, symmetryOf(descriptor));
        const unsigned level = levelOf(descriptor);
        uint32_t number = valueOf(descriptor);
        if (level <= 4) return stateInLeaf(payload_ + layout_.shared + number, p);
        for (unsigned height = (level + 1) & ~1u;; height -= 2) {
            const NodeHead head = node(height, number);
            const uint32_t child = grandchildAt(p, height - 2);
            if (((head.mixed >> child) & 1) == 0) return known(head.opaque, child);
            if (height == 6) return stateInLeaf(leafUnder(head, child), p);
            number = head.base + rankOf(head.mixed, child);
        }
    }
    [[nodiscard]] micromap::State stateInLeaf(const uint8_t* leaf, micromap::Planes p) const {
        const LeafHead head = leafHead(leaf);
        const uint32_t child = grandchildAt(p, 2);
        if (((head.mixed >> child) & 1) == 0) return known(head.opaque, child);
        const uint32_t pattern = patternUnder(head, child);
        const uint32_t at = grandchildAt(p, 0);
        return static_cast<micromap::State>(fourState_ ? (pattern >> (2 * at)) & 3 : (pattern >> at) & 1);
    }

    [[nodiscard]] uint64_t bitsReadInLeaf(const uint8_t* leaf, micromap::Planes p) const;
    [[nodiscard]] bool fitsLanes() const;
    template <class PlanesOfSome>
    void lookupInChunks(std::span<const uint32_t> maps, std::span<micromap::State> states,
                        const PlanesOfSome& planesOfSome) const;

    EncodedView set_;
    Layout layout_;
    const uint8_t* descriptors_;  // behind what stands before them
    const uint8_t* payload_;
    bool fourState_;
};

// All of `maps` as one graph. Never larger than flat, descriptors aside. With `shares` the opaque shares of
// nodes are stored, 2 bytes a node, so that SdagReader::opaqueShare is quick at every level. ErrorKind::limit
// above 4 GiB in one part.
FILIGREE_API Result<EncodedSet> encodeSdag(std::span<const micromap::QuadtreeView> maps,
                                           micromap::Format format, bool shares,
                                           const Executor& executor = serialExecutor(),
                                           ProgressSink& progress = silentProgress());

}  // namespace filigree::encoding
