#include "filigree/vulkan/grid_lookup.h"

#include "filigree/grid/check.h"

#include "vulkan/lookup_run.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace filigree::vulkan {
namespace {

// As lookup_grids.comp has them.
struct GridQuery {
    uint32_t offset = 0;
    uint32_t column = 0;
    uint32_t row = 0;
};
using FoundVertex = std::array<uint32_t, 4>;

Status checkForShaders(const grid::EncodedGrids& grids, const Executor& executor) {
    if (grids.codec != grid::Codec::lattice)
        return Error{ErrorKind::unsupported, "sub-grids of the codec paper have no shader"};
    return check(grids, executor);
}

Status findVertices(Device::Data& device, const grid::EncodedGrids& grids,
                    const std::vector<GridQuery>& asked, std::vector<FoundVertex>& found) {
    auto kernel =
        Kernel::make(device, {ShaderKind::gridLookup, Decoder::none}, {3, sizeof(LookupRange), false}, {});
    if (!kernel) return kernel.error();
    const auto records = uploadedOf(device, grids.records, "the grids");
    if (!records) return records.error();
    const auto queries = uploadedOf(device, asked, "places in grids");
    if (!queries) return queries.error();
    kernel->bindings().bind(0, *records);
    kernel->bindings().bind(1, *queries);
    return answerQueries(device, *kernel, 2, found.size(), "look vertices up",
                         {reinterpret_cast<uint8_t*>(found.data()), found.size() * sizeof(FoundVertex)});
}

GridVertex vertexOf(const FoundVertex& found) {
    GridVertex vertex;
    for (size_t k = 0; k < 3; ++k) vertex.point[k] = static_cast<int32_t>(found[k]);
    vertex.isBd = found[3] != 0;
    return vertex;
}

}  // namespace

Result<std::vector<GridVertex>> lookup(const Device& device, const grid::EncodedGrids& grids,
                                       std::span<const GridPlace> places, const Executor& executor) {
    if (auto good = checkForShaders(grids, executor); !good) return good.error();
    std::vector<GridQuery> asked;
    for (const GridPlace& place : places) {
        assert(place.record < grids.leafCount());
        asked.push_back({grids.offsets[place.record], place.column, place.row});
    }
    std::vector<FoundVertex> found(asked.size());
    if (!found.empty()) {
        auto ran = findVertices(device.data(), grids, asked, found);
        if (!ran) return ran.error();
    }
    std::vector<GridVertex> vertices(found.size());
    std::ranges::transform(found, vertices.begin(), vertexOf);
    return vertices;
}

}  // namespace filigree::vulkan
