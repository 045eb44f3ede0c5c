// Equal micromaps are stored once.
#pragma once

#include "filigree/micromap/set.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace filigree::bake {

// Collects micromaps in the order they come; the first of equal ones stays.
class Sharer {
  public:
    // The index of a micromap: special when it is uniform, else that of an equal one in list(). Hashes only
    // find candidates; the bits decide.
    int32_t add(const micromap::QuadtreeView& tree);

    micromap::QuadtreeList take() && { return std::move(list_); }

  private:
    micromap::QuadtreeList list_;
    std::unordered_multimap<uint64_t, uint32_t> byHash_;
};

}  // namespace filigree::bake
