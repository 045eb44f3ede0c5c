// Micromaps as one graph of merged subtrees (Chernaik, Modisett and Billeter 2026): docs/spec/dag.md.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/bytes.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/encoding/rank.h"
#include "filigree/micromap/curve.h"
#include "filigree/micromap/quadtree.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace filigree::encoding {

// MapReader's functions without virtual calls; see there for ranges.
class FILIGREE_API DagReader {
  public:
    // Checks all of `set` and looks into its blocks from then on.
    static Result<DagReader> open(const EncodedView& set);

    [[nodiscard]] uint32_t mapCount() const { return set_.mapCount; }
    [[nodiscard]] unsigned level(uint32_t map) const { return descriptor(map) >> rootBits; }
    // Two reads for two levels: a node's head and one pointer, or one word of masks.
    [[nodiscard]] micromap::State at(uint32_t map, uint32_t index) const {
        const uint32_t from = descriptor(map);
        uint32_t node = from & rootMask;
        for (unsigned shift = rootShift(from >> rootBits); shift > 4; shift -= 4) {
            const uint32_t head = word(node);
            const uint32_t child = (index >> shift) & 15;
            if (((head >> child) & 1) == 0) return micromap::State::transparent;
            node = word(node + 1 + rankOf(head, child));
        }
        const uint32_t head = word(node);
        const uint32_t child = (index >> 4) & 15;
        const uint32_t bit = (16 * rankOf(head, child) + (index & 15)) << widthShift_;
        // Whether a block is absent is hard to predict: so an absent one reads the head instead.
        const uint32_t present = (head >> child) & 1;
        const uint32_t at = node + (present != 0 ? 1 + bit / 32 : 0);
        return static_cast<micromap::State>((word(at) >> (bit % 32)) & stateMask_ & (0 - present));
    }
    [[nodiscard]] micromap::State at(uint32_t map, float u, float v) const {
        return at(map, micromap::barycentricsToIndex(u, v, level(map)));
    }
    void lookup(std::span<const uint32_t> maps, std::span<const uint32_t> indices,
                std::span<micromap::State> states) const;
    void lookup(std::span<const uint32_t> maps, std::span<const float> u, std::span<const float> v,
                std::span<micromap::State> states) const;

    // From the stored shares; to within 1/65535, exact for parts of up to 64 micro-triangles.
    [[nodiscard]] float opaqueShare(uint32_t map, uint32_t index, unsigned level) const;

    // Bits of at() (docs/spec/bits-read.md).
    [[nodiscard]] uint64_t bitsRead(uint32_t map, uint32_t index) const;
    [[nodiscard]] micromap::Quadtree decode(uint32_t map) const;
    [[nodiscard]] std::vector<Part> parts() const;

  private:
    static constexpr unsigned rootBits = 28;  // of a descriptor; the others hold the level
    static constexpr uint32_t rootMask = (1u << rootBits) - 1;

    // Words of each kind.
    struct Words {
        uint64_t heads = 0;
        uint64_t pointers = 0;
        uint64_t masks = 0;
        uint64_t paddingBits = 0;  // of `masks`
    };

    DagReader(const EncodedView& set, const Words& words)
        : set_(set),
          words_(words),
          widthShift_(set.format == micromap::Format::fourState ? 1 : 0),
          stateMask_((1u << micromap::bitsPerState(set.format)) - 1) {}

    // How far the index is shifted to number a root's children: four bits a node, the last four in a mask.
    static constexpr unsigned rootShift(unsigned level) { return level <= 4 ? 4 : 4 * ((level + 1) / 2) - 4; }
    [[nodiscard]] uint32_t descriptor(uint32_t map) const {
        return load(set_.descriptors.data() + size_t{4} * map);
    }
    [[nodiscard]] uint32_t word(uint32_t at) const { return load(set_.payload.data() + size_t{4} * at); }
    // loadLe in one instruction.
    [[nodiscard]] static uint32_t load(const uint8_t* from) {
        if constexpr (std::endian::native != std::endian::little) return loadLe<uint32_t>(from);
        uint32_t value;
        std::memcpy(&value, from, sizeof value);
        return value;
    }
    // State `at` of those that a leaf holds.
    [[nodiscard]] micromap::State stateIn(uint32_t leaf, uint32_t at) const {
        const uint32_t bit = at << widthShift_;
        return static_cast<micromap::State>((word(leaf + 1 + bit / 32) >> (bit % 32)) & stateMask_);
    }
    [[nodiscard]] float shareInLeaf(uint32_t leaf, uint32_t index, unsigned height) const;

    EncodedView set_;
    Words words_;
    unsigned widthShift_;  // log2 of a state's bits
    unsigned stateMask_;
};

// All of `maps` as one graph. ErrorKind::limit above 1 GiB of payload.
FILIGREE_API Result<EncodedSet> encodeDag(std::span<const micromap::QuadtreeView> maps,
                                          micromap::Format format,
                                          const Executor& executor = serialExecutor(),
                                          ProgressSink& progress = silentProgress());

}  // namespace filigree::encoding
