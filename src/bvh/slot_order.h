// Which child of a node takes which slot, so that rays visit near ones first (in the manner of Ylitie, Karras
// and Laine 2017, section 3.3).
#pragma once

#include "filigree/bvh/node.h"

#include <array>
#include <cstdint>
#include <span>

namespace filigree::bvh {

struct SlotOrder {
    static constexpr uint8_t none = width;
    std::array<uint8_t, width> childOf;  // [slot], none where it is empty
    uint8_t axes = 0;                    // Node::slotAxes
};

// Halves the children three times, each time all parts along the axis on which they are most spread. Unlike
// in the paper bits of slots have no axes of their own: tiles of a surface lie side by side on two of them.
SlotOrder slotOrder(std::span<const Box> children);

}  // namespace filigree::bvh
