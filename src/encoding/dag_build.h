// Quadtrees to nodes, from the bottom up.
#pragma once

#include "filigree/micromap/quadtree.h"

#include "encoding/dag_layout.h"
#include "encoding/dag_nodes.h"

#include <array>
#include <cstdint>

namespace filigree::encoding::dag {

// Reads quadtrees as a stream and adds their nodes to `nodes`, whose pointers are node numbers. Costs what
// the quadtrees cost, whatever their level.
class Builder {
  public:
    Builder(Nodes& nodes, micromap::Format format) : nodes_(nodes), format_(format) {}

    // The number of the root node of `tree`.
    uint32_t add(const micromap::QuadtreeView& tree);

  private:
    // A child of a node: number + 1 of a node, or the mask of a block below a leaf; 0 where all of it is
    // transparent.
    struct Part {
        uint32_t value = 0;
        uint32_t opaque = 0;  // micro-triangles of it on the opaque side
    };
    using Parts = std::array<Part, children>;

    Part part(unsigned height);
    void fill(unsigned height, unsigned partHeight, Part* parts);
    Part block();
    Part paddedBlock(unsigned level);
    Part blockOf(uint32_t states) const;
    Part uniform(unsigned height, uint32_t state);
    Part node(unsigned height, const Parts& parts);
    uint32_t intern(unsigned height, const Parts& parts, uint64_t opaque);

    // The next bits of the quadtree, at least 57 where there are so many; others are zero.
    [[nodiscard]] uint64_t peek() const {
        const size_t word = at_ / 64;
        const unsigned used = at_ % 64;
        const uint64_t low = word < tree_.words.size() ? tree_.words[word] >> used : 0;
        if (used == 0 || word + 1 >= tree_.words.size()) return low;
        return low | (tree_.words[word + 1] << (64 - used));
    }

    Nodes& nodes_;
    micromap::Format format_;
    micromap::QuadtreeView tree_;
    size_t at_ = 0;  // bit
    // Number + 1 of the node of each half height and state, 0 where there is none yet.
    std::array<std::array<Part, 4>, micromap::maxLevel / 2 + 1> uniform_{};
};

}  // namespace filigree::encoding::dag
