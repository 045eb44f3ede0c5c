// Constants of docs/spec/gruen.md.
#pragma once

#include <cstdint>

namespace filigree::encoding::gruen {

// The format field of a record.
inline constexpr uint16_t sides = 1;
inline constexpr uint16_t threeStates = 2;
inline constexpr uint16_t maybeOpaque = 3;

}  // namespace filigree::encoding::gruen
