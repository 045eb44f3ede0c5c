// One way to read micromaps in any encoding.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/micromap/quadtree.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace filigree::encoding {

// Looks states up in a set that was checked when it was opened, so that no lookup can leave its bytes. Looks
// into the view that it was opened from. For code where one virtual call a lookup does not matter; the
// readers behind it (FlatReader, TreeReader, ...) have the same functions without.
class FILIGREE_API MapReader {
  public:
    virtual ~MapReader() = default;

    [[nodiscard]] virtual uint32_t mapCount() const = 0;

    // 0..maxLevel, of map < mapCount().
    [[nodiscard]] virtual unsigned level(uint32_t map) const = 0;

    // The state of micro-triangle `index` < 4^level(map), counted along the curve.
    [[nodiscard]] virtual micromap::State at(uint32_t map, uint32_t index) const = 0;

    // The state at a point, as micromap::barycentricsToIndex finds its micro-triangle.
    [[nodiscard]] virtual micromap::State at(uint32_t map, float u, float v) const = 0;

    // at(maps[k], indices[k]), or at(maps[k], u[k], v[k]), into states[k] for all k, in SIMD. All spans have
    // one length.
    virtual void lookup(std::span<const uint32_t> maps, std::span<const uint32_t> indices,
                        std::span<micromap::State> states) const = 0;
    virtual void lookup(std::span<const uint32_t> maps, std::span<const float> u, std::span<const float> v,
                        std::span<micromap::State> states) const = 0;

    // The opaque share, 0..1, of part `index` < 4^level of the map at a coarser level, 0..level(map): how
    // many of its micro-triangles are opaque or unknown-opaque. Unknown ones count by their side. From the
    // shares that the encoding stores (dag; sdag with EncodeOptions::aggregates) to within 1/65535; else
    // slow: it looks at every micro-triangle of the part.
    [[nodiscard]] virtual float opaqueShare(uint32_t map, uint32_t index, unsigned level) const = 0;

    // How many bits at(map, index) reads, as docs/spec/bits-read.md counts them.
    [[nodiscard]] virtual uint64_t bitsRead(uint32_t map, uint32_t index) const = 0;

    // All of one map.
    [[nodiscard]] virtual micromap::Quadtree decode(uint32_t map) const = 0;

    // What the bits are spent on; adds up to 8 * (descriptors + payload).
    [[nodiscard]] virtual std::vector<Part> parts() const = 0;
};

// Checks every byte of `set` and opens it. ErrorKind::format names the block and the byte or the map.
// Encoding::bitmask holds no micromaps: ErrorKind::usage.
FILIGREE_API Result<std::unique_ptr<MapReader>> openReader(const EncodedView& set);

}  // namespace filigree::encoding
