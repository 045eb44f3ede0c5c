// The meta section of a .fil of grids.
#pragma once

#include "filigree/core/result.h"
#include "filigree/grid/encoded_grids.h"
#include "filigree/io/fil.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::io {

// What the meta section says.
struct FilGridHead {
    FilAsset asset;
    grid::Codec codec = grid::Codec::lattice;
    grid::Lattice lattice;
    grid::PaperCode paper;
    uint32_t records = 0;
    uint32_t grids = 0;  // at most as many as records
    uint32_t looseTriangles = 0;
    uint32_t looseVertices = 0;  // at most three for each loose triangle
};

std::vector<uint8_t> encodeGridMeta(const FilGridHead& head);

// Checks every field, but for lattice and exponent base, which grid::check does; errors name the byte in the
// section.
Result<FilGridHead> decodeGridMeta(std::span<const uint8_t> bytes);

}  // namespace filigree::io
