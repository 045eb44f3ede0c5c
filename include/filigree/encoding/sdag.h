// Micromaps as one graph whose maps are merged up to the triangle's symmetries, with short codes for the
// parts that occur often: docs/spec/sdag.md.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/micromap/quadtree.h"
#include "filigree/micromap/symmetry.h"

#include "filigree_lookup.h"

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
    [[nodiscard]] unsigned level(uint32_t map) const { return filigree_sdag_level(&view_, map); }
    [[nodiscard]] micromap::State at(uint32_t map, uint32_t index) const {
        return static_cast<micromap::State>(filigree_sdag_at(&view_, map, index));
    }
    [[nodiscard]] micromap::State at(uint32_t map, float u, float v) const {
        return static_cast<micromap::State>(filigree_sdag_at_point(&view_, map, u, v));
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

  private:
    SdagReader(const EncodedView& set, const filigree_sdag& view, uint64_t referenceBytes)
        : set_(set), view_(view), referenceBytes_(referenceBytes) {}

    friend class SdagWalk;

    [[nodiscard]] bool fitsLanes() const;
    template <class PlanesOfSome>
    void lookupInChunks(std::span<const uint32_t> maps, std::span<micromap::State> states,
                        const PlanesOfSome& planesOfSome) const;

    EncodedView set_;
    filigree_sdag view_;
    uint64_t referenceBytes_;  // of the blocks
};

// All of `maps` as one graph. Never larger than flat, descriptors aside. With `shares` the opaque shares of
// nodes are stored, 2 bytes a node, so that SdagReader::opaqueShare is quick at every level. ErrorKind::limit
// above 4 GiB in one part.
FILIGREE_API Result<EncodedSet> encodeSdag(std::span<const micromap::QuadtreeView> maps,
                                           micromap::Format format, bool shares,
                                           const Executor& executor = serialExecutor(),
                                           ProgressSink& progress = silentProgress());

}  // namespace filigree::encoding
