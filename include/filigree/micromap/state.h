// States, formats and special indices of opacity micromaps, as in VK_KHR_opacity_micromap, DXR 1.2 and glTF.
#pragma once

#include <cstddef>
#include <cstdint>

namespace filigree::micromap {

// Bit 0: which side covers more. Bit 1: unknown. The numbers are those of the APIs.
enum class State : uint8_t { transparent = 0, opaque = 1, unknownTransparent = 2, unknownOpaque = 3 };

// What a state says: known or not, and of which side.
constexpr bool isKnown(State state) {
    return static_cast<uint8_t>(state) < 2;
}
constexpr bool isOpaqueSide(State state) {
    return (static_cast<uint8_t>(state) & 1) != 0;
}
// The state of a side.
constexpr State unknownOf(bool opaqueSide) {
    return opaqueSide ? State::unknownOpaque : State::unknownTransparent;
}
constexpr State knownOf(bool opaqueSide) {
    return opaqueSide ? State::opaque : State::transparent;
}

// The formats' API numbers.
enum class Format : uint16_t { twoState = 1, fourState = 2 };

// Bits of a micro-triangle, 1 or 2.
constexpr unsigned bitsPerState(Format format) {
    return format == Format::twoState ? 1 : 2;
}

// Subdivision levels run from 0 to maxLevel; level L has 4^L micro-triangles.
inline constexpr unsigned maxLevel = 12;
constexpr uint64_t microTriangleCount(unsigned level) {
    return uint64_t{1} << (2 * level);
}

// Bytes of a flat micromap.
constexpr uint64_t flatBytes(unsigned level, Format format) {
    return (microTriangleCount(level) * bitsPerState(format) + 7) / 8;
}

// A triangle whose micro-triangles all have one state needs no micromap: its index is special, -1..-4.
constexpr int32_t specialIndex(State state) {
    return -1 - static_cast<int32_t>(state);
}
constexpr bool isSpecialIndex(int32_t index) {
    return index < 0 && index >= -4;
}
constexpr State stateOfSpecialIndex(int32_t index) {
    return static_cast<State>(-1 - index);
}

}  // namespace filigree::micromap
