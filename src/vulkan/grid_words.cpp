#include "vulkan/grid_words.h"

#include "filigree/bvh/walk.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace filigree::vulkan {
namespace {

// Appends what stands in memory as words.
template <class T>
uint32_t appendWords(std::span<const T> values, std::vector<uint32_t>& words) {
    static_assert(sizeof(T) % sizeof(uint32_t) == 0);
    const size_t first = words.size();
    words.resize(first + values.size_bytes() / sizeof(uint32_t));
    if (!values.empty()) std::memcpy(words.data() + first, values.data(), values.size_bytes());
    return static_cast<uint32_t>(first);
}
template <class T>
uint32_t appendWords(const std::vector<T>& values, std::vector<uint32_t>& words) {
    return appendWords(std::span(values), words);
}
// Where there are any.
template <class T>
uint32_t appendSome(const std::vector<T>& values, std::vector<uint32_t>& words) {
    return values.empty() ? noWord : appendWords(values, words);
}

bool hasNormals(const GridPart& part) {
    return part.attributes != nullptr &&
           !(part.attributes->normals.empty() && part.attributes->looseNormals.empty());
}

uint32_t appendNormals(const GridPart& part, std::vector<uint32_t>& words) {
    GridNormalWords head;
    const uint32_t at = appendWords(std::span<const GridNormalWords>(&head, 1), words);
    for (const grid::VertexGrid& grid : part.table) {
        words.push_back(grid.columns);
        words.push_back(static_cast<uint32_t>(grid.firstVertex));
    }
    head.vertices = appendSome(part.attributes->normals, words);
    if (!part.attributes->looseTriangles.empty())
        head.loose = appendSome(part.attributes->looseNormals, words);
    head.looseTriangles = appendSome(part.attributes->looseTriangles, words);
    std::memcpy(words.data() + at, &head, sizeof(head));
    return at;
}

// Rays are told in floats.
bool floatsHold(const grid::Lattice& lattice) {
    return std::ranges::all_of(lattice.step, [](double step) { return step > 1e-30 && step < 1e30; });
}

GridWords wordsOf(const grid::Lattice& lattice, std::span<const Box> boxes) {
    GridWords head;
    for (size_t k = 0; k < 3; ++k) {
        head.origin[k] = static_cast<float>(lattice.origin[k]);
        head.originRest[k] = static_cast<float>(lattice.origin[k] - double{head.origin[k]});
        head.step[k] = static_cast<float>(lattice.step[k]);
        head.perStep[k] = static_cast<float>(1 / lattice.step[k]);
        for (const Box& box : boxes) head.largest[k] = std::max(head.largest[k], box.high[k]);
    }
    return head;
}

uint64_t wordCount(const GridPart& part) {
    uint64_t count = sizeof(GridWords) / 4 + part.grids->offsets.size() + part.grids->records.size() / 4;
    if (!hasNormals(part)) return count;
    count += 3 + 2 * part.table.size() + 3 * part.attributes->normals.size();
    return count + 3 * (part.attributes->looseNormals.size() + part.attributes->looseTriangles.size());
}

}  // namespace

Result<uint32_t> appendGrids(const GridPart& part, std::span<const Box> boxes, std::vector<uint32_t>& words) {
    const grid::EncodedGrids& grids = *part.grids;
    if (!floatsHold(grids.lattice))
        return Error{ErrorKind::limit,
                     "the steps of the grids' lattice are beyond what shaders compute with"};
    if (words.size() + wordCount(part) > mostSceneWords)
        return Error{ErrorKind::limit, "the scene's grids, geometry and textures take more than 4 GiB"};
    GridWords head = wordsOf(grids.lattice, boxes);
    const uint32_t at = appendWords(std::span<const GridWords>(&head, 1), words);
    appendWords(grids.offsets, words);
    head.recordsAt = static_cast<uint32_t>(words.size());
    words.resize(words.size() + grids.records.size() / 4);
    std::memcpy(words.data() + head.recordsAt, grids.records.data(), grids.records.size() / 4 * 4);
    if (hasNormals(part)) head.normalsAt = appendNormals(part, words);
    std::memcpy(words.data() + at, &head, sizeof(head));
    return at;
}

std::vector<VkAabbPositionsKHR> gridAabbs(const grid::Lattice& lattice, std::span<const Box> boxes) {
    std::array<float, 3> slack{};
    const auto world = [&](size_t k, float coordinate) {
        return static_cast<float>(lattice.origin[k] + lattice.step[k] * double{coordinate});
    };
    for (size_t k = 0; k < 3; ++k) {
        for (const Box& box : boxes)
            slack[k] =
                std::max({slack[k], std::fabs(world(k, box.low[k])), std::fabs(world(k, box.high[k]))});
        slack[k] *= bvh::walkSlack;
    }
    std::vector<VkAabbPositionsKHR> aabbs;
    aabbs.reserve(boxes.size());
    for (const Box& box : boxes) {
        const auto low = [&](size_t k) { return world(k, box.low[k]) - slack[k]; };
        const auto high = [&](size_t k) { return world(k, box.high[k]) + slack[k]; };
        aabbs.push_back({low(0), low(1), low(2), high(0), high(1), high(2)});
    }
    return aabbs;
}

}  // namespace filigree::vulkan
