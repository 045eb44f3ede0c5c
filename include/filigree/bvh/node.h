// The compressed node of an 8-wide hierarchy (Ylitie, Karras and Laine 2017, section 3.1; docs/spec/bvh.md).
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/box.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace filigree::bvh {

// Children of a node.
inline constexpr size_t width = 8;
inline constexpr int minExponent = -126;  // so that 2^exponent is a normal float

// Child boxes lie on a lattice of the node's own: low and high are bytes q for origin + q * 2^exponent on
// each axis, rounded outwards; places of the lattice fit in 24 bits, so that floats hold them exactly. A
// child is empty, another node, or one leaf. Inner children stand at firstChild, firstChild + 1, ... in slot
// order, leaves are numbered firstLeaf, firstLeaf + 1, ... in slot order.
//
// Slots lie in the order in which rays meet them: on axis slotAxis(b) children whose bit b of the slot is 0
// come before those where it is 1, higher bits first. So a ray visits slots s by s ^ turn, with bit b of the
// turn set where its direction is negative on that axis.
struct FILIGREE_API Node {
    std::array<float, 3> origin{};
    std::array<int8_t, 3> exponent{};
    uint8_t innerMask = 0;  // bit k: child k is a node
    uint32_t firstChild = 0;
    uint32_t firstLeaf = 0;
    uint8_t leafMask = 0;  // bit k: child k is a leaf
    uint8_t slotAxes = 0;  // slotAxis(b) in bits 2 b and 2 b + 1
    std::array<uint8_t, 6> zeros{};
    std::array<std::array<uint8_t, width>, 3> low{};
    std::array<std::array<uint8_t, width>, 3> high{};

    // The box of child k, exact in float.
    [[nodiscard]] Box childBox(size_t k) const;
    // Of bit b of slots, 0 to 2.
    [[nodiscard]] unsigned slotAxis(size_t b) const { return slotAxes >> 2 * b & 3U; }
    // Whether there is a child k.
    [[nodiscard]] bool hasChild(size_t k) const { return ((innerMask | leafMask) >> k & 1) != 0; }
};
static_assert(sizeof(Node) == 80);

}  // namespace filigree::bvh
