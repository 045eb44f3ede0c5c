// What a ray does at a leaf, for the instruction set in use.
#pragma once

#include "filigree/grid/encoded_grids.h"
#include "filigree/grid/paper.h"

#include "grid/block.h"
#include "grid/block_cache.h"
#include "grid/traced_ray.h"

#include <cstdint>

namespace filigree::grid {

// What all rays of a tracer look into.
struct LeafSource {
    const EncodedGrids* grids = nullptr;
    const UnitVectors* vectors = nullptr;
    BlockCache* cache = nullptr;
};

// Tests a ray against a leaf of its kind and keeps the nearest hit in it. True where there is a new one; any
// ends at the first.
struct RayKernels {
    using TestLeaf = bool (*)(const LeafSource& source, uint32_t leaf, TracedRay& ray, bool any);
    TestLeaf tile = nullptr;
    TestLeaf subGrid = nullptr;
    TestLeaf cluster = nullptr;

    // Decode as the tests do, to be compared with the plain decoders.
    void (*decodeTile)(const uint8_t* record, TileBlocks& tile) = nullptr;
    void (*decodeBlock)(const uint8_t* record, const TileBlocks& tile, unsigned place,
                        Block& block) = nullptr;
    void (*decodeSubGrid)(const uint8_t* record, const PaperCode& paper, const UnitVectors& vectors,
                          Block& block) = nullptr;
};

RayKernels rayKernels();

inline const uint8_t* leafRecord(const EncodedGrids& grids, uint32_t leaf) {
    if (grids.offsets.empty()) return grids.records.data() + size_t{leaf} * paperBytes;
    return grids.records.data() +
           size_t{grids.offsets[leaf] & ~EncodedGrids::clusterBit} * EncodedGrids::recordUnit;
}
inline bool isClusterLeaf(const EncodedGrids& grids, uint32_t leaf) {
    return !grids.offsets.empty() && (grids.offsets[leaf] & EncodedGrids::clusterBit) != 0;
}

}  // namespace filigree::grid
