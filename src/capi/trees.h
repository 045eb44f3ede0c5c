// Quadtrees in the caller's memory.
#pragma once

#include "filigree/micromap/quadtree.h"

#include "capi/memory.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace filigree::capi {

class Trees {
  public:
    Trees() = default;
    Trees(const Memory& memory, const micromap::QuadtreeList& trees);

    [[nodiscard]] size_t size() const { return places_.size(); }
    micromap::QuadtreeView operator[](size_t k) const {
        const Place& at = places_[k];
        return {words_.values().subspan(at.word, (at.bits + 63) / 64), at.bits, at.level};
    }
    [[nodiscard]] std::vector<micromap::QuadtreeView> views() const;

  private:
    struct Place {
        size_t word;
        uint32_t bits;
        uint32_t level;
    };
    Array<uint64_t> words_;
    Array<Place> places_;
};

}  // namespace filigree::capi
