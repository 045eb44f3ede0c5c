// Micromaps as the flat lists of the APIs.
#pragma once

#include "filigree/micromap/set.h"

#include "capi/micromaps.h"
#include "filigree.h"

#include <cstdint>

namespace filigree::capi {

// A map less where there are none: the APIs' lists may not be empty.
inline uint32_t recordCount(const filigree_micromaps& maps) {
    return maps.trees.size() == 0 ? 1 : static_cast<uint32_t>(maps.trees.size());
}
inline unsigned recordLevel(const filigree_micromaps& maps, size_t record) {
    return maps.trees.size() == 0 ? 0 : maps.trees[record].level;
}
inline uint64_t recordBytes(const filigree_micromaps& maps, size_t record) {
    return micromap::flatBytes(recordLevel(maps, record), maps.format);
}

}  // namespace filigree::capi
