#include "jobs/grid_methods.h"

#include "filigree/core/progress.h"
#include "filigree/grid/decode_grids.h"
#include "filigree/grid/encode_grids.h"
#include "filigree/grid/rays.h"

#include "jobs/grid_lattice.h"
#include "jobs/stopwatch.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

namespace filigree::jobs {
namespace {

constexpr std::string_view robustMethod = "triangles-robust";
constexpr std::array<std::string_view, 8> gridMethodList{"triangles", "triangles-compact", "triangles-qbvh8",
                                                         "grids",     "grids-compact",     "paper",
                                                         "lattice",   robustMethod};

// Rays asked for at once, few enough that what is found stays in the cache, as in a tile of a picture.
constexpr size_t raysAtOnce = 1024;

// Calls body(first, count) on chunks of rays.
template <class Body>
void forChunks(size_t count, const Body& body) {
    for (size_t first = 0; first < count; first += raysAtOnce)
        body(first, std::min(raysAtOnce, count - first));
}

class EmbreeMethod final : public GridMethod {
  public:
    EmbreeMethod(trace::EmbreeGrids grids, const grid::GridMesh& mesh, bool streams)
        : grids_(std::move(grids)), mesh_(mesh), streams_(streams) {}

    [[nodiscard]] uint64_t bytes() const override { return grids_.bytes(); }
    [[nodiscard]] double buildSeconds() const override { return grids_.buildSeconds(); }

    [[nodiscard]] bool hasBatches() const override { return streams_; }

    void closest(std::span<const grid::Ray> rays, bool batched, std::span<float> distances) override {
        std::array<trace::EmbreeHit, raysAtOnce> hits;
        forChunks(rays.size(), [&](size_t first, size_t count) {
            const auto chunk = rays.subspan(first, count);
            const std::span found(hits.data(), count);
            batched ? grids_.closestStreamed(chunk, found) : grids_.closest(chunk, found);
            for (size_t k = 0; k < count; ++k) distances[first + k] = hits[k].t;
        });
    }
    void any(std::span<const grid::Ray> rays, bool batched, std::span<uint8_t> answers) override {
        batched ? grids_.anyStreamed(rays, answers) : grids_.any(rays, answers);
    }

    [[nodiscard]] grid::GridMesh surface(const Executor&) const override { return mesh_; }

  private:
    trace::EmbreeGrids grids_;
    const grid::GridMesh& mesh_;
    bool streams_;
};

class EncodedMethod final : public GridMethod {
  public:
    EncodedMethod(std::unique_ptr<grid::EncodedGrids> encoded, const grid::GridMesh& mesh,
                  double buildSeconds)
        : encoded_(std::move(encoded)), mesh_(mesh), tracer_(*encoded_), buildSeconds_(buildSeconds) {}

    [[nodiscard]] uint64_t bytes() const override { return grid::bytesOf(*encoded_).total(); }
    [[nodiscard]] double buildSeconds() const override { return buildSeconds_; }
    [[nodiscard]] uint64_t cacheBytes() const override { return tracer_.bytes(); }
    [[nodiscard]] bool hasBatches() const override { return true; }

    void closest(std::span<const grid::Ray> rays, bool batched, std::span<float> distances) override {
        std::array<grid::Hit, raysAtOnce> hits;
        forChunks(rays.size(), [&](size_t first, size_t count) {
            const auto chunk = rays.subspan(first, count);
            if (batched) {
                tracer_.closest(chunk, std::span(hits.data(), count));
            } else {
                for (size_t k = 0; k < count; ++k) hits[k] = tracer_.closest(chunk[k]);
            }
            for (size_t k = 0; k < count; ++k) distances[first + k] = hits[k].t;
        });
    }
    void any(std::span<const grid::Ray> rays, bool batched, std::span<uint8_t> answers) override {
        if (batched) return tracer_.any(rays, answers);
        for (size_t k = 0; k < rays.size(); ++k) answers[k] = tracer_.any(rays[k]) ? 1 : 0;
    }

    [[nodiscard]] grid::GridMesh surface(const Executor& executor) const override {
        return grid::decodedMesh(*encoded_, mesh_, executor);
    }

  private:
    std::unique_ptr<grid::EncodedGrids> encoded_;
    const grid::GridMesh& mesh_;
    grid::Tracer tracer_;
    double buildSeconds_;
};

Result<std::unique_ptr<GridMethod>> makeEncodedMethod(grid::Codec codec, GridScene& scene,
                                                      const Executor& executor) {
    grid::EncodeOptions encoding;
    encoding.codec = codec;
    grid::GridMesh& mesh = scene.meshFor(codec);
    if (codec == grid::Codec::lattice) {
        const auto chosen = chooseLattice(mesh, scene.precision, encoding.displacement, executor);
        if (!chosen) return chosen.error();
        encoding.lattice = chosen->lattice;
    }
    const Stopwatch building;
    auto encoded = grid::encodeGrids(mesh, encoding, executor, silentProgress());
    if (!encoded) return encoded.error();
    const double seconds = building.seconds();
    return std::unique_ptr<GridMethod>(std::make_unique<EncodedMethod>(
        std::make_unique<grid::EncodedGrids>(std::move(*encoded)), mesh, seconds));
}

}  // namespace

std::span<const std::string_view> gridMethodNames() {
    return gridMethodList;
}
bool isGridMethod(std::string_view name) {
    return std::ranges::find(gridMethodList, name) != gridMethodList.end();
}

Result<std::unique_ptr<GridMethod>> makeGridMethod(std::string_view name, GridScene& scene,
                                                   const Executor& executor) {
    assert(isGridMethod(name));
    if (const auto codec = grid::codecNamed(name)) return makeEncodedMethod(*codec, scene, executor);
    const bool robust = name == robustMethod;
    const auto layout = robust ? trace::EmbreeLayout::triangles : trace::embreeLayoutNamed(name);
    auto grids =
        trace::EmbreeGrids::build(scene.mesh, *layout, {.robust = robust, .threads = executor.concurrency()});
    if (!grids) return grids.error();
    const bool streams = layout == trace::EmbreeLayout::triangles && !robust;
    return std::unique_ptr<GridMethod>(
        std::make_unique<EmbreeMethod>(std::move(*grids), scene.mesh, streams));
}

}  // namespace filigree::jobs
