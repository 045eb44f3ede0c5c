// Micromaps as masks in row order (Gruen, Benthin and Woop 2020; Waldemarson and Doggett 2024, figure 2):
// docs/spec/gruen.md.
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

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace filigree::encoding {

// The place of a micro-triangle in row order. Row r, counted from vertex 0, starts at r * r.
constexpr uint32_t rowOrderIndex(micromap::LatticeTriangle t) {
    const uint32_t flipped = t.flipped ? 1 : 0;
    const uint32_t row = t.i + t.j + flipped;
    return row * row + 2 * t.j + flipped;
}

// The same from a curve index.
constexpr uint32_t rowOrderOfCurve(uint32_t index) {
    return rowOrderIndex(micromap::latticeTriangle(index, 15));
}

// The same from barycentrics, without the curve: the micro-triangle that micromap::barycentricsToIndex finds,
// ties included.
inline uint32_t rowOrderIndex(float u, float v, unsigned level) {
    const auto n = static_cast<float>(1u << level);
    const float scaledU = (u > 0 ? std::min(u, 1.0f) : 0.0f) * n;
    const float scaledV = (v > 0 ? std::min(v, 1.0f) : 0.0f) * n;
    const auto floorU = static_cast<int32_t>(scaledU);
    const auto floorV = static_cast<int32_t>(scaledV);
    const float fractions = (scaledU - static_cast<float>(floorU)) + (scaledV - static_cast<float>(floorV));
    const int32_t last = (1 << level) - 1;
    const int32_t j = std::min(floorV, last);
    const int32_t sum = std::min(floorU, last) + j;
    const int32_t flipped = fractions >= 1.0f && sum < last ? 1 : 0;
    const int32_t row = std::min(sum, last) + flipped;
    return static_cast<uint32_t>(row * row + 2 * j + flipped);
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
    [[nodiscard]] unsigned level(uint32_t map) const { return loadLe<uint16_t>(record(map) + 4); }
    [[nodiscard]] micromap::State at(uint32_t map, uint32_t index) const {
        return atRowOrder(map, rowOrderOfCurve(index));
    }
    [[nodiscard]] micromap::State at(uint32_t map, float u, float v) const {
        return atRowOrder(map, rowOrderIndex(u, v, level(map)));
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

    // True when a set bit of a 1-bit mask says no more than "maybe opaque".
    [[nodiscard]] bool isMaybeOpaque() const { return stateMask_ == 1 && stateScale_ == 3; }

  private:
    GruenReader(const EncodedView& set, bool maybeOpaque)
        : set_(set),
          widthShift_(set.format == micromap::Format::fourState ? 1 : 0),
          stateMask_((1u << micromap::bitsPerState(set.format)) - 1),
          stateScale_(maybeOpaque ? 3 : 1) {}

    [[nodiscard]] const uint8_t* record(uint32_t map) const {
        return set_.descriptors.data() + micromap::recordBytes * map;
    }
    [[nodiscard]] micromap::State atRowOrder(uint32_t map, uint32_t at) const {
        const uint32_t bit = at << widthShift_;
        const unsigned byte = set_.payload.data()[size_t{loadLe<uint32_t>(record(map))} + bit / 8];
        return static_cast<micromap::State>(((byte >> (bit % 8)) & stateMask_) * stateScale_);
    }

    // atRowOrder() of all, in SIMD.
    void lookupAt(std::span<const uint32_t> maps, std::span<const uint32_t> places,
                  std::span<micromap::State> states) const;

    EncodedView set_;
    unsigned widthShift_;  // log2 of a state's bits
    unsigned stateMask_;
    unsigned stateScale_;  // of a stored value to a State
};

// `maps` one after another; `bit` matters with Format::twoState only. ErrorKind::limit above 4 GiB - 1 of
// payload.
FILIGREE_API Result<EncodedSet> encodeGruen(std::span<const micromap::QuadtreeView> maps,
                                            micromap::Format format, GruenBit bit,
                                            const Executor& executor = serialExecutor(),
                                            ProgressSink& progress = silentProgress());

}  // namespace filigree::encoding
