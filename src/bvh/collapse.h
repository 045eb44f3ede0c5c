// From a binary tree to nodes of eight children (Ylitie, Karras and Laine 2017, section 3.2).
#pragma once

#include "filigree/bvh/node.h"

#include "bvh/bounds.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace filigree::bvh {

struct Children {
    std::array<uint32_t, width> branches{};
    size_t count = 0;
};

// The cheapest choice of nodes. A node costs its area, since that is how often rays visit it, and a fixed
// price for its memory, which is what makes nodes full.
class Collapse {
  public:
    // `nodePrice` in the units of Bounds::area().
    Collapse(std::span<const Branch> tree, double nodePrice);

    // The children of the node made of `branch`, from left to right; a leaf is its own only child.
    [[nodiscard]] Children childrenOf(uint32_t branch) const;

  private:
    // [k]: the branch as at most k + 1 children of a node above.
    struct Choices {
        std::array<double, width> cost{};
        std::array<uint8_t, width> leftShare{};  // of the k + 1 to the left; 0: as with one fewer
        uint8_t inside = 0;                      // of eight children to the left, once it is a node
    };
    struct Share {
        double cost;
        uint8_t left;
    };

    [[nodiscard]] Share bestShare(const Branch& branch, size_t places) const;
    void choose(const Branch& branch, double nodePrice, Choices& choices) const;
    void gather(uint32_t branch, size_t places, Children& into) const;

    std::span<const Branch> tree_;
    std::vector<Choices> choices_;
};

}  // namespace filigree::bvh
