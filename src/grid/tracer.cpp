#include "filigree/grid/cluster.h"
#include "filigree/grid/rays.h"
#include "filigree/grid/tile.h"

#include "grid/cluster_layout.h"
#include "grid/ray_kernels.h"
#include "grid/traced_ray.h"

#include <array>
#include <cassert>
#include <utility>

#include <hwy/cache_control.h>

namespace filigree::grid {

// Rays that are traced by turns: while one waits for memory or for what it computed last, others go on.
class RayTurns {
  public:
    static constexpr size_t count = 16;

    bvh::Walk& walk(size_t k) { return walks_[k]; }
    TracedRay& traced(size_t k) { return traced_[k]; }
    size_t& ray(size_t k) { return rays_[k]; }

    // Those that walk come first.
    std::array<bvh::Walk*, count> order{};
    size_t walking = 0;
    [[nodiscard]] size_t numberOf(size_t place) const {
        return static_cast<size_t>(order[place] - walks_.data());
    }

  private:
    std::array<bvh::Walk, count> walks_;
    std::array<TracedRay, count> traced_;
    std::array<size_t, count> rays_{};
};

struct Tracer::Data {
    explicit Data(const EncodedGrids& encoded)
        : grids(encoded),
          scene(encoded),
          kernels(rayKernels()),
          near(bvh::walkFunctions(bvh::WalkOrder::near)),
          first(bvh::walkFunctions(bvh::WalkOrder::any)) {
        source = {&encoded, &unitVectors(), &cache};
        testLeaf = encoded.codec == Codec::paper ? kernels.subGrid : kernels.tile;
    }

    const EncodedGrids& grids;
    TracedScene scene;
    RayKernels kernels;
    bvh::WalkFunctions near;
    bvh::WalkFunctions first;
    RayKernels::TestLeaf testLeaf;
    BlockCache cache;
    LeafSource source;
    bvh::Walk oneWalk;
    TracedRay oneRay;
    std::unique_ptr<RayTurns> batch = std::make_unique<RayTurns>();

    void trace(const Ray& ray, bool any) {
        if (!oneRay.start(scene, ray)) return;
        oneWalk.start(oneRay.segment(), scene.largest);
        const bvh::WalkFunctions& walks = any ? first : near;
        do {
            walks.nextLeaf(grids.nodes.data(), oneWalk);
        } while (!testLeafOf(oneWalk, oneRay, any));
    }
    // done(k, traced) for each ray once its hit is known, in any order.
    template <class Done>
    void traceAll(std::span<const Ray> rays, bool any, const Done& done);

    // What of the grid was hit.
    void setPlace(const TracedHit& from, Hit& hit) const;
    [[nodiscard]] Hit hitOf(const Ray& ray, const TracedRay& traced) const;

  private:
    // Tests a walk's leaf; true where nothing more can come.
    bool testLeafOf(bvh::Walk& walk, TracedRay& traced, bool any) {
        if (walk.leaf == bvh::noLeaf) return true;
        const auto test = isClusterLeaf(grids, walk.leaf) ? kernels.cluster : testLeaf;
        if (test(source, walk.leaf, traced, any) && any) return true;
        walk.tMax = traced.tMax;
        return false;
    }
    void prefetch(uint32_t leaf) const;
};

void Tracer::Data::prefetch(uint32_t leaf) const {
    if (leaf == bvh::noLeaf) return;
    const uint8_t* record = leafRecord(grids, leaf);
    hwy::Prefetch(record);
    hwy::Prefetch(record + 64);
    hwy::Prefetch(record + 128);
}

template <class Done>
void Tracer::Data::traceAll(std::span<const Ray> rays, bool any, const Done& done) {
    RayTurns& turns = *batch;
    const bvh::WalkFunctions& walks = any ? first : near;
    size_t next = 0;
    // Puts the next ray that may hit something into a place; false when there is none left.
    const auto begin = [&](size_t number) {
        for (; next < rays.size(); ++next) {
            TracedRay& ray = turns.traced(number);
            if (!ray.start(scene, rays[next])) {
                done(next, ray);
                continue;
            }
            turns.walk(number).start(ray.segment(), scene.largest);
            turns.ray(number) = next++;
            return true;
        }
        return false;
    };
    size_t walking = 0;
    for (size_t k = 0; k < RayTurns::count && begin(k); ++k) turns.order[walking++] = &turns.walk(k);
    while (walking > 0) {
        const size_t before = walking;
        walking = walks.nextLeaves(grids.nodes.data(), turns.order.data(), walking, walking / 4);
        for (size_t k = walking; k < before; ++k) prefetch(turns.order[k]->leaf);
        for (size_t k = walking; k < before; ++k) {
            const size_t number = turns.numberOf(k);
            if (testLeafOf(*turns.order[k], turns.traced(number), any)) {
                done(turns.ray(number), turns.traced(number));
                if (!begin(number)) continue;
            }
            std::swap(turns.order[walking++], turns.order[k]);
        }
    }
}

void Tracer::Data::setPlace(const TracedHit& from, Hit& hit) const {
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

Hit Tracer::Data::hitOf(const Ray& ray, const TracedRay& traced) const {
    Hit hit;
    if (!traced.isHit()) return hit;
    hit.t = traced.worldT(ray);
    hit.u = traced.hit.u;
    hit.v = traced.hit.v;
    setPlace(traced.hit, hit);
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
    return data_->hitOf(ray, data_->oneRay);
}

bool Tracer::any(const Ray& ray) {
    data_->trace(ray, true);
    return data_->oneRay.isHit();
}

void Tracer::closest(std::span<const Ray> rays, std::span<Hit> hits) {
    assert(hits.size() == rays.size());
    data_->traceAll(rays, false,
                    [&](size_t k, const TracedRay& traced) { hits[k] = data_->hitOf(rays[k], traced); });
}

void Tracer::any(std::span<const Ray> rays, std::span<uint8_t> answers) {
    assert(answers.size() == rays.size());
    data_->traceAll(rays, true,
                    [&](size_t k, const TracedRay& traced) { answers[k] = traced.isHit() ? 1 : 0; });
}

uint64_t Tracer::bytes() const {
    return sizeof(Data) + sizeof(RayTurns) + data_->cache.bytes();
}

}  // namespace filigree::grid
