// Flat micromaps, as the APIs take them: docs/spec/flat.md.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/bytes.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/micromap/curve.h"
#include "filigree/micromap/quadtree.h"
#include "filigree/micromap/set.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::encoding {

// MapReader's functions without virtual calls; see there for ranges.
class FILIGREE_API FlatReader {
  public:
    // Checks all of `set` and looks into its blocks from then on.
    static Result<FlatReader> open(const EncodedView& set);

    [[nodiscard]] uint32_t mapCount() const { return set_.mapCount; }
    [[nodiscard]] unsigned level(uint32_t map) const { return loadLe<uint16_t>(record(map) + 4); }
    [[nodiscard]] micromap::State at(uint32_t map, uint32_t index) const {
        const uint32_t bit = index << widthShift_;
        const unsigned byte = set_.payload.data()[size_t{offset(map)} + bit / 8];
        return static_cast<micromap::State>((byte >> (bit % 8)) & stateMask_);
    }
    [[nodiscard]] micromap::State at(uint32_t map, float u, float v) const {
        return at(map, micromap::barycentricsToIndex(u, v, level(map)));
    }
    void lookup(std::span<const uint32_t> maps, std::span<const uint32_t> indices,
                std::span<micromap::State> states) const;
    void lookup(std::span<const uint32_t> maps, std::span<const float> u, std::span<const float> v,
                std::span<micromap::State> states) const;
    // Bits of at(): the record and the state (docs/spec/bits-read.md).
    [[nodiscard]] uint64_t bitsRead(uint32_t, uint32_t) const {
        return 8 * micromap::recordBytes + (1u << widthShift_);
    }
    [[nodiscard]] micromap::Quadtree decode(uint32_t map) const;
    [[nodiscard]] std::vector<Part> parts() const;

  private:
    explicit FlatReader(const EncodedView& set)
        : set_(set),
          widthShift_(set.format == micromap::Format::fourState ? 1 : 0),
          stateMask_((1u << micromap::bitsPerState(set.format)) - 1) {}

    [[nodiscard]] const uint8_t* record(uint32_t map) const {
        return set_.descriptors.data() + micromap::recordBytes * map;
    }
    [[nodiscard]] uint32_t offset(uint32_t map) const { return loadLe<uint32_t>(record(map)); }

    EncodedView set_;
    unsigned widthShift_;  // log2 of a state's bits
    unsigned stateMask_;
};

// `maps` one after another. ErrorKind::limit above 4 GiB - 1 of payload.
FILIGREE_API Result<EncodedSet> encodeFlat(std::span<const micromap::QuadtreeView> maps,
                                           micromap::Format format,
                                           const Executor& executor = serialExecutor(),
                                           ProgressSink& progress = silentProgress());

}  // namespace filigree::encoding
