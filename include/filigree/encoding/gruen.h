// Micromaps as masks in row order (Gruen, Benthin and Woop 2020; Waldemarson and Doggett 2024, figure 2):
// docs/spec/gruen.md.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/micromap/curve.h"
#include "filigree/micromap/quadtree.h"
#include "filigree/micromap/set.h"

#include "filigree_lookup.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::encoding {

// The place of a micro-triangle in row order. Row r, counted from vertex 0, starts at r * r.
constexpr uint32_t rowOrderIndex(micromap::LatticeTriangle t) {
    return filigree_row_order_of({t.i, t.j, t.flipped ? 1u : 0u});
}

// The same from a curve index.
constexpr uint32_t rowOrderOfCurve(uint32_t index) {
    return filigree_row_order_of_curve(index);
}

// The same from barycentrics, without the curve: the micro-triangle that micromap::barycentricsToIndex finds,
// ties included.
inline uint32_t rowOrderIndex(float u, float v, unsigned level) {
    return filigree_row_order_at(u, v, level);
}

// What a set bit of a 1-bit mask means.
enum class GruenBit : uint8_t {
    opaqueSide,   // the state's side, as in all 2-state encodings; known
    maybeOpaque,  // not known to be transparent: conservative; unknown-opaque
};

// MapReader's functions without virtual calls; see there for ranges. An unknown state reads as
// unknown-opaque.
class FILIGREE_API GruenReader {
  public:
    // Checks all of `set` and looks into its blocks from then on.
    static Result<GruenReader> open(const EncodedView& set);

    [[nodiscard]] uint32_t mapCount() const { return set_.mapCount; }
    [[nodiscard]] unsigned level(uint32_t map) const { return filigree_gruen_level(&view_, map); }
    [[nodiscard]] micromap::State at(uint32_t map, uint32_t index) const {
        return static_cast<micromap::State>(filigree_gruen_at(&view_, map, index));
    }
    [[nodiscard]] micromap::State at(uint32_t map, float u, float v) const {
        return static_cast<micromap::State>(filigree_gruen_at_point(&view_, map, u, v));
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

    // True when a set bit of a 1-bit mask says no more than "maybe opaque".
    [[nodiscard]] bool isMaybeOpaque() const { return view_.state_scale == 3; }

  private:
    GruenReader(const EncodedView& set, const filigree_gruen& view) : set_(set), view_(view) {}

    [[nodiscard]] micromap::State atRowOrder(uint32_t map, uint32_t at) const {
        return static_cast<micromap::State>(filigree_gruen_at_row_order(&view_, map, at));
    }

    // atRowOrder() of all, in SIMD.
    void lookupAt(std::span<const uint32_t> maps, std::span<const uint32_t> places,
                  std::span<micromap::State> states) const;

    EncodedView set_;
    filigree_gruen view_;
};

// `maps` one after another; `bit` matters with Format::twoState only. ErrorKind::limit above 4 GiB - 1 of
// payload.
FILIGREE_API Result<EncodedSet> encodeGruen(std::span<const micromap::QuadtreeView> maps,
                                            micromap::Format format, GruenBit bit,
                                            const Executor& executor = serialExecutor(),
                                            ProgressSink& progress = silentProgress());

}  // namespace filigree::encoding
