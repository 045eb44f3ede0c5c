#include "filigree/grid/cluster.h"
#include "filigree/grid/rays.h"
#include "filigree/grid/tile.h"

#include "grid/cluster_layout.h"
#include "grid/ray_kernels.h"
#include "grid/traced_ray.h"

#include <cassert>

namespace filigree::grid {

struct Tracer::Data {
    explicit Data(const EncodedGrids& encoded)
        : grids(encoded), scene(encoded), kernels(rayKernels()), nextLeaf(bvh::nextLeafFunction()) {
        source = {&encoded, &unitVectors(), &cache};
        testLeaf = encoded.codec == Codec::paper ? kernels.subGrid : kernels.tile;
    }

    const EncodedGrids& grids;
    TracedScene scene;
    RayKernels kernels;
    bvh::NextLeaf nextLeaf;
    RayKernels::TestLeaf testLeaf;
    BlockCache cache;
    LeafSource source;
    bvh::Walk walk;
    TracedRay traced;

    void trace(const Ray& ray, bool any) {
        traced.hit = {};
        if (!traced.start(scene, ray)) return;
        walk.start(traced.segment());
        for (;;) {
            const uint32_t leaf = nextLeaf(grids.nodes.data(), walk);
            if (leaf == bvh::noLeaf) return;
            const auto test = isClusterLeaf(grids, leaf) ? kernels.cluster : testLeaf;
            if (test(source, leaf, traced, any) && any) return;
            walk.tMax = traced.tMax;
        }
    }
    [[nodiscard]] bool isHit() const { return traced.hit.leaf != bvh::noLeaf; }

    // What of the grid was hit.
    void setPlace(Hit& hit) const;
    [[nodiscard]] Hit hitOf(const Ray& ray) const;
};

void Tracer::Data::setPlace(Hit& hit) const {
    const TracedHit& from = traced.hit;
    const uint8_t* record = leafRecord(grids, from.leaf);
    if (isClusterLeaf(grids, from.leaf)) {
        hit.grid = looseGrid;
        hit.column = loadClusterHeader(record).firstTriangle + from.quad;
        return;
    }
    hit.half = from.half;
    if (grids.codec == Codec::paper) {
        const PaperPlace place = paperPlace(record);
        hit.grid = place.grid;
        hit.column = place.gridColumn + from.quad % 4U;
        hit.row = place.gridRow + from.quad / 4U;
        return;
    }
    const TileHeader head = loadTileHeader(record);
    const unsigned i = stepsAtPlaces[head.blockColumns()][from.block % 4U];
    const unsigned j = stepsAtPlaces[head.blockRows()][from.block / 4U];
    hit.grid = head.grid;
    hit.column =
        tileQuads * head.tileColumn + blockQuads * i + stepsAtPlaces[head.columnsOf(i)][from.quad % 4U];
    hit.row = tileQuads * head.tileRow + blockQuads * j + stepsAtPlaces[head.rowsOf(j)][from.quad / 4U];
}

Hit Tracer::Data::hitOf(const Ray& ray) const {
    Hit hit;
    if (!isHit()) return hit;
    hit.t = traced.worldT(ray);
    hit.u = traced.hit.u;
    hit.v = traced.hit.v;
    setPlace(hit);
    const auto& corners = traced.hit.corners;
    std::array<std::array<double, 3>, 2> side{};
    for (size_t k = 0; k < 3; ++k) {
        side[0][k] = (double{corners[1][k]} - corners[0][k]) * scene.step[k];
        side[1][k] = (double{corners[2][k]} - corners[0][k]) * scene.step[k];
    }
    for (size_t k = 0; k < 3; ++k) {
        const size_t x = (k + 1) % 3, y = (k + 2) % 3;
        hit.normal[k] = static_cast<float>(side[0][x] * side[1][y] - side[0][y] * side[1][x]);
    }
    return hit;
}

Tracer::Tracer(const EncodedGrids& grids) : data_(std::make_unique<Data>(grids)) {}
Tracer::Tracer(Tracer&&) noexcept = default;
Tracer& Tracer::operator=(Tracer&&) noexcept = default;
Tracer::~Tracer() = default;

Hit Tracer::closest(const Ray& ray) {
    data_->trace(ray, false);
    return data_->hitOf(ray);
}

bool Tracer::any(const Ray& ray) {
    data_->trace(ray, true);
    return data_->isHit();
}

void Tracer::closest(std::span<const Ray> rays, std::span<Hit> hits) {
    assert(hits.size() == rays.size());
    for (size_t k = 0; k < rays.size(); ++k) hits[k] = closest(rays[k]);
}

void Tracer::any(std::span<const Ray> rays, std::span<uint8_t> answers) {
    assert(answers.size() == rays.size());
    for (size_t k = 0; k < rays.size(); ++k) answers[k] = any(rays[k]) ? 1 : 0;
}

uint64_t Tracer::bytes() const {
    return sizeof(Data) + data_->cache.bytes();
}

}  // namespace filigree::grid
