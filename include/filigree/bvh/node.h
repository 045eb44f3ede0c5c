// The compressed node of an 8-wide hierarchy (Ylitie, Karras and Laine 2017, section 3.1; docs/spec/bvh.md).
#pragma once

#include "filigree/core/box.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace filigree::bvh {

inline constexpr size_t width = 8;

// Child boxes lie on a lattice of the node's own: low and high are bytes q for origin + q * 2^exponent on
// each axis, rounded outwards. A child is empty, another node, or one leaf. Inner children stand at
// firstChild, firstChild + 1, ... in slot order, leaves are numbered firstLeaf, firstLeaf + 1, ... in slot
// order.
struct Node {
    std::array<float, 3> origin{};
    std::array<int8_t, 3> exponent{};
    uint8_t innerMask = 0;  // bit k: child k is a node
    uint32_t firstChild = 0;
    uint32_t firstLeaf = 0;
    std::array<uint8_t, width> meta{};  // 1 for a leaf, 0 otherwise
    std::array<std::array<uint8_t, width>, 3> low{};
    std::array<std::array<uint8_t, width>, 3> high{};

    // The box of child k, exact in float.
    [[nodiscard]] Box childBox(size_t k) const;
};
static_assert(sizeof(Node) == 80);

}  // namespace filigree::bvh
