// The handle of encoded squares.
#pragma once

#include "filigree/quadmap/place.h"
#include "filigree/quadmap/reader.h"

#include "capi/memory.h"
#include "filigree.h"

#include <cstdint>
#include <optional>
#include <span>

struct filigree_squares {
    filigree::capi::Memory memory;
    filigree::capi::Array<uint8_t> blocks;
    std::optional<filigree::quadmap::SquareReader> reader;         // of the blocks
    filigree::capi::Array<int32_t> indices;                        // [triangle_count]
    filigree::capi::Array<filigree::quadmap::SquarePlace> places;  // [triangle_count]
    filigree::capi::Array<filigree_primitive> primitives;          // that these belong to
};

namespace filigree::capi {

// Squares over a copy of the blocks.
Owned<filigree_squares> squaresOf(const Memory& memory, quadmap::SquareFormat format,
                                  std::span<const uint8_t> blocks, Array<int32_t> indices,
                                  Array<quadmap::SquarePlace> places);

}  // namespace filigree::capi
