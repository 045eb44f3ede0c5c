#include "grid/ray_kernels.h"

#include "filigree/grid/cluster.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "grid/ray_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// After Highway, which includes this file once a target.
#include "grid/block_test-inl.h"
#include "grid/paper_block-inl.h"
#include "grid/tile_blocks-inl.h"
#include "grid/triangle_test-inl.h"

HWY_BEFORE_NAMESPACE();
namespace filigree::grid::HWY_NAMESPACE {

inline void keepCorners(const Block& block, TracedHit& hit) {
    const bool isBd = (block.bd >> hit.quad & 1) != 0;
    const unsigned a = hit.quad / 4U * 5 + hit.quad % 4U;
    const unsigned b = a + 1, c = a + 6, d = a + 5;
    const auto at = [&](unsigned k) {
        return Vec3{block.points[0][k], block.points[1][k], block.points[2][k]};
    };
    if (isBd)
        hit.corners = hit.half == 0 ? std::array{at(a), at(b), at(d)} : std::array{at(b), at(c), at(d)};
    else
        hit.corners = hit.half == 0 ? std::array{at(a), at(b), at(c)} : std::array{at(a), at(c), at(d)};
}

HWY_INLINE bool testBlock(const Block& block, TracedRay& ray, uint32_t leaf, unsigned place) {
    if (!BlockTest(block, ray).run()) return false;
    ray.hit.leaf = leaf;
    ray.hit.block = static_cast<uint8_t>(place);
    keepCorners(block, ray.hit);
    return true;
}

// The blocks whose boxes the ray meets, and when it does.
HWY_INLINE uint32_t enteredBlocks(const TileBlocks& tile, const TracedRay& ray, float* near) {
    F16 entry = all(ray.tMin), exit = all(ray.tMax);
    for (size_t k = 0; k < 3; ++k) {
        const F16 reciprocal = all(ray.reciprocal[k]);
        const F16 low = (load(tile.low[k].data()) - all(ray.boxLow[k])) * reciprocal;
        const F16 high = (load(tile.high[k].data()) - all(ray.boxHigh[k])) * reciprocal;
        entry = greatest(entry, least(low, high));
        exit = least(exit, greatest(low, high));
    }
    store(entry, near);
    return bitsNotAbove(entry, exit) & tile.blocks;
}

bool testTile(const LeafSource& source, uint32_t leaf, TracedRay& ray, bool any) {
    const uint8_t* record = leafRecord(*source.grids, leaf);
    const TileBlocks& tile =
        source.cache->tiles.get(leaf, [&](TileBlocks& to) { decodeTileBlocks(record, to); });
    alignas(64) std::array<float, 16> near;
    uint32_t left = enteredBlocks(tile, ray, near.data());
    bool isHit = false;
    while (left != 0) {
        auto place = static_cast<unsigned>(std::countr_zero(left));
        for (uint32_t others = any ? 0 : left & (left - 1); others != 0; others &= others - 1) {
            const auto other = static_cast<unsigned>(std::countr_zero(others));
            if (near[other] < near[place]) place = other;
        }
        left &= ~(1U << place);
        if (near[place] > ray.tMax) break;
        const Block& block = source.cache->blocks.get(
            uint64_t{leaf} * 16 + place, [&](Block& to) { decodeTileBlock(record, tile, place, to); });
        if (!testBlock(block, ray, leaf, place)) continue;
        isHit = true;
        if (any) break;
    }
    return isHit;
}

bool testSubGrid(const LeafSource& source, uint32_t leaf, TracedRay& ray, bool) {
    const uint8_t* record = leafRecord(*source.grids, leaf);
    const Block& block = source.cache->blocks.get(
        leaf, [&](Block& to) { decodePaperBlock(record, source.grids->paper, *source.vectors, to); });
    return testBlock(block, ray, leaf, 0);
}

bool testCluster(const LeafSource& source, uint32_t leaf, TracedRay& ray, bool any) {
    ClusterTriangles cluster;
    decodeCluster(leafRecord(*source.grids, leaf), cluster);
    std::array<PlaceOnLattice, 3> axes{};
    if (source.grids->codec == Codec::paper) {
        for (size_t k = 0; k < 3; ++k)
            axes[k] = {source.grids->lattice.origin[k], source.grids->lattice.step[k]};
    }
    if (!TriangleTest(cluster, axes, ray).run(any)) return false;
    ray.hit.leaf = leaf;
    return true;
}

RayKernels kernelsHere() {
    return {&testTile, &testSubGrid, &testCluster, &decodeTileBlocks, &decodeTileBlock, &decodePaperBlock};
}

}  // namespace filigree::grid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace filigree::grid {

HWY_EXPORT(kernelsHere);

RayKernels rayKernels() {
    return HWY_DYNAMIC_DISPATCH(kernelsHere)();
}

}  // namespace filigree::grid
#endif
