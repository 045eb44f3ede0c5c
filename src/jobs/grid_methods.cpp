#include "jobs/grid_methods.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

namespace filigree::jobs {
namespace {

constexpr std::string_view robustMethod = "triangles-robust";
constexpr std::array<std::string_view, 6> methodNames{"triangles", "triangles-compact", "triangles-qbvh8",
                                                      "grids",     "grids-compact",     robustMethod};

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
    EmbreeMethod(trace::EmbreeGrids grids, bool streams) : grids_(std::move(grids)), streams_(streams) {}

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

  private:
    trace::EmbreeGrids grids_;
    bool streams_;
};

}  // namespace

std::span<const std::string_view> gridMethodNames() {
    return methodNames;
}
bool isGridMethod(std::string_view name) {
    return std::ranges::find(methodNames, name) != methodNames.end();
}

Result<std::unique_ptr<GridMethod>> makeGridMethod(std::string_view name, const grid::GridMesh& mesh,
                                                   const Executor& executor) {
    assert(isGridMethod(name));
    const bool robust = name == robustMethod;
    const auto layout = robust ? trace::EmbreeLayout::triangles : trace::embreeLayoutNamed(name);
    auto grids =
        trace::EmbreeGrids::build(mesh, *layout, {.robust = robust, .threads = executor.concurrency()});
    if (!grids) return grids.error();
    const bool streams = layout == trace::EmbreeLayout::triangles && !robust;
    return std::unique_ptr<GridMethod>(std::make_unique<EmbreeMethod>(std::move(*grids), streams));
}

}  // namespace filigree::jobs
