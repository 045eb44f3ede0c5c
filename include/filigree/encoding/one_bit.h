// Micromaps of one bit a micro-triangle that still know what is unknown: docs/spec/one-bit.md. Waldemarson
// and Doggett 2024, section 7, ask for such modes.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/micromap/quadtree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::encoding {

// The two states that a map has. The numbers are those of the container's pairs.
enum class StatePair : uint8_t {
    transparentOpaque = 0,
    transparentUnknown = 1,  // transparent, unknown-opaque
    unknownOpaque = 2,       // unknown-transparent, opaque
};
inline constexpr unsigned statePairCount = 3;

// The pair that loses least of `map`: both known states where nothing is unknown, else the known state that
// covers more; on a tie transparentUnknown where at least half is on the opaque side.
FILIGREE_API StatePair bestPair(const micromap::QuadtreeView& map);

// `map` in the states of `pair`: known states outside of it become unknown, and unknown ones take its side.
// Its 2-state form (the sides) and the pair say all of it. With StatePair::transparentOpaque `map` has no
// unknown state.
FILIGREE_API micromap::Quadtree inPair(const micromap::QuadtreeView& map, StatePair pair);

// The way back: what a 2-state map means under `pair`.
FILIGREE_API micromap::Quadtree fromPair(const micromap::QuadtreeView& sides, StatePair pair);

// Two bits for each map, map 0 lowest.
FILIGREE_API std::vector<uint8_t> packPairs(std::span<const StatePair> pairs);

// The pairs of an encoded set.
class FILIGREE_API PairReader {
  public:
    // Checks all of `bytes` and looks into them from then on. ErrorKind::format where they are not the pairs
    // of a 2-state set of set.mapCount maps.
    static Result<PairReader> open(const EncodedView& set, std::span<const uint8_t> bytes);

    // That of map < mapCount.
    [[nodiscard]] StatePair operator[](uint32_t map) const {
        return static_cast<StatePair>((bytes_[map / 4] >> (2 * (map % 4))) & 3);
    }

  private:
    explicit PairReader(std::span<const uint8_t> bytes) : bytes_(bytes) {}

    std::span<const uint8_t> bytes_;
};

}  // namespace filigree::encoding
