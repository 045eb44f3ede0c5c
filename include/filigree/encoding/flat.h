// Flat micromaps, as the APIs take them: docs/spec/flat.md.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/micromap/quadtree.h"
#include "filigree/micromap/set.h"

#include "filigree_lookup.h"

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
    [[nodiscard]] unsigned level(uint32_t map) const { return filigree_flat_level(&view_, map); }
    [[nodiscard]] micromap::State at(uint32_t map, uint32_t index) const {
        return static_cast<micromap::State>(filigree_flat_at(&view_, map, index));
    }
    [[nodiscard]] micromap::State at(uint32_t map, float u, float v) const {
        return static_cast<micromap::State>(filigree_flat_at_point(&view_, map, u, v));
    }
    void lookup(std::span<const uint32_t> maps, std::span<const uint32_t> indices,
                std::span<micromap::State> states) const;
    void lookup(std::span<const uint32_t> maps, std::span<const float> u, std::span<const float> v,
                std::span<micromap::State> states) const;
    // Bits of at(): the record and the state (docs/spec/bits-read.md).
    [[nodiscard]] uint64_t bitsRead(uint32_t, uint32_t) const {
        return 8 * micromap::recordBytes + micromap::bitsPerState(set_.format);
    }
    [[nodiscard]] micromap::Quadtree decode(uint32_t map) const;
    [[nodiscard]] std::vector<Part> parts() const;

  private:
    FlatReader(const EncodedView& set, const filigree_flat& view) : set_(set), view_(view) {}

    EncodedView set_;
    filigree_flat view_;
};

// `maps` one after another. ErrorKind::limit above 4 GiB - 1 of payload.
FILIGREE_API Result<EncodedSet> encodeFlat(std::span<const micromap::QuadtreeView> maps,
                                           micromap::Format format,
                                           const Executor& executor = serialExecutor(),
                                           ProgressSink& progress = silentProgress());

}  // namespace filigree::encoding
