// Sizes in the sections of a .fil of grids.
#pragma once

#include <cstddef>

namespace filigree::io {

inline constexpr size_t filNodeBytes = 80;
inline constexpr size_t filGridBytes = 4;  // of a grid in the table

}  // namespace filigree::io
