// Heightfields: grey PNG images as one grid.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/result.h"
#include "filigree/grid/vertex_grid.h"

#include <cstdint>
#include <filesystem>
#include <span>

namespace filigree::io {

// How texels become vertices.
struct HeightfieldOptions {
    double cell = 1;         // world units between neighbouring vertices, positive and finite
    double heightScale = 1;  // world units a grey step (of 255 or 65535), finite, not 0
};

// A grey PNG of 8 or 16 bits as one grid of a vertex a texel: vertex (column, row) stands at (column * cell,
// grey * heightScale, row * cell), diagonals are ac. The source triangles of quad q are 2 q and 2 q + 1. An
// image with a side of one texel is refused, as are options outside their range (ErrorKind::usage).
FILIGREE_API Result<grid::GridMesh> parseHeightfield(std::span<const uint8_t> png,
                                                     const HeightfieldOptions& options);
FILIGREE_API Result<grid::GridMesh> readHeightfield(const std::filesystem::path& path,
                                                    const HeightfieldOptions& options);

}  // namespace filigree::io
