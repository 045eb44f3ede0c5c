// The curve of sRGB (IEC 61966-2-1), both ways.
#pragma once

#include <array>
#include <cstdint>

namespace filigree::trace {

// Of 0..1, and cut beyond.
uint8_t srgbOf(float linear);

// [8-bit value].
const std::array<float, 256>& linearOfSrgb();

}  // namespace filigree::trace
