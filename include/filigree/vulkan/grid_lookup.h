// Vertices of compressed grids by the shaders of shaders/decode, to compare them with the decoders of the
// CPU.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/core/result.h"
#include "filigree/grid/encoded_grids.h"
#include "filigree/vulkan/device.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::vulkan {

// A vertex of a tile, columns and rows counted in vertices from the tile's first; or a corner of a cluster's
// triangle.
struct GridPlace {
    uint32_t record = 0;  // below EncodedGrids::leafCount()
    uint32_t column = 0;  // 0 to 16, not beyond the tile; or the triangle in the cluster
    uint32_t row = 0;     // the same; or the corner, 0 to 2
};

// A vertex to decode.
struct GridVertex {
    grid::LatticePoint point{};
    bool isBd = false;  // the tile has a quad to the right of and below the vertex, with Diagonal::bd
    bool operator==(const GridVertex&) const = default;
};

// What stands at places that are there. The grids are checked first (grid/check.h). ErrorKind::unsupported
// for Codec::paper, which has no shader, ErrorKind::limit where the grids do not fit the device.
FILIGREE_API Result<std::vector<GridVertex>> lookup(const Device& device, const grid::EncodedGrids& grids,
                                                    std::span<const GridPlace> places,
                                                    const Executor& executor = serialExecutor());

}  // namespace filigree::vulkan
