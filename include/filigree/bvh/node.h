// The compressed node of an 8-wide hierarchy (Ylitie, Karras and Laine 2017, section 3.1; docs/spec/bvh.md).
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/box.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace filigree::bvh {

inline constexpr size_t width = 8;
inline constexpr int minExponent = -126;  // so that 2^exponent is a normal float

// Child boxes lie on a lattice of the node's own: low and high are bytes q for origin + q * 2^exponent on
// each axis, rounded outwards; places of the lattice fit in 24 bits, so that floats hold them exactly. A
// child is empty, another node, or one leaf. Inner children stand at firstChild, firstChild + 1, ... in slot
// order, leaves are numbered firstLeaf, firstLeaf + 1, ... in slot order.
struct FILIGREE_API Node {
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
    // Bit k: child k is a leaf.
    [[nodiscard]] unsigned leafMask() const {
        unsigned mask = 0;
        for (size_t k = 0; k < width; ++k) mask |= static_cast<unsigned>(meta[k]) << k;
        return mask;
    }
};
static_assert(sizeof(Node) == 80);

}  // namespace filigree::bvh
