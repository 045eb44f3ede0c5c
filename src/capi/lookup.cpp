#include "filigree/micromap/curve.h"

#include "capi/arguments.h"
#include "capi/call.h"
#include "capi/parts.h"
#include "capi/set.h"

#include <algorithm>

namespace filigree::capi {
namespace {

using micromap::State;

constexpr int noState = -1;

int numberOf(State state) {
    return static_cast<int>(state);
}

State stateAt(const filigree_set& set, uint32_t map, float u, float v) {
    return set.maps ? set.maps->at(map, u, v) : set.textures->at(map, u, v);
}

// The caller's lists of a batch.
template <class... Lists>
std::span<State> statesApart(size_t count, uint8_t* states, Lists... lists) {
    const std::span<State> to = listOf(reinterpret_cast<State*>(states), count, "states");
    (checkApart(to, lists, "states", "another list"), ...);
    return to;
}

// True where all of `numbers` are below `limit`. Three plain operations for each, which compilers turn to
// vectors: beside a lookup they cost little.
bool areBelow(std::span<const uint32_t> numbers, uint32_t limit) {
    if (limit == 0 || limit > INT32_MAX)
        return std::ranges::all_of(numbers, [&](uint32_t number) { return number < limit; });
    uint32_t topBits = 0;
    for (const uint32_t number : numbers) topBits |= number | (limit - 1 - number);
    return topBits >> 31 == 0;
}

void checkMaps(const filigree_set& set, std::span<const uint32_t> maps, size_t first) {
    if (areBelow(maps, set.view.mapCount)) return;
    const auto found = std::ranges::find_if(maps, [&](uint32_t map) { return map >= set.view.mapCount; });
    fail(FILIGREE_ERROR_ARGUMENT, "maps: element {} is {}, the set holds {}",
         first + static_cast<size_t>(found - maps.begin()), *found, set.view.mapCount);
}

bool isIn(const filigree_set& set, uint32_t map, uint32_t index) {
    return index < micromap::microTriangleCount(set.levels[map]);
}

void checkIndices(const filigree_set& set, std::span<const uint32_t> maps, std::span<const uint32_t> indices,
                  size_t first) {
    if (set.level && areBelow(indices, static_cast<uint32_t>(micromap::microTriangleCount(*set.level))))
        return;
    for (size_t k = 0; k < maps.size(); ++k) {
        if (isIn(set, maps[k], indices[k])) [[likely]]
            continue;
        fail(FILIGREE_ERROR_ARGUMENT, "indices: element {} is {}, map {} has level {}", first + k, indices[k],
             maps[k], set.levels[maps[k]]);
    }
}

void lookUp(const filigree_set& set, std::span<const uint32_t> maps, std::span<const float> u,
            std::span<const float> v, std::span<State> states) {
    inParts(maps.size(), [&](size_t first, size_t count) {
        const auto some = maps.subspan(first, count);
        checkMaps(set, some, first);
        const auto to = states.subspan(first, count);
        if (set.maps) {
            set.maps->lookup(some, u.subspan(first, count), v.subspan(first, count), to);
        } else {
            set.textures->lookup(some, u.subspan(first, count), v.subspan(first, count), to);
        }
    });
}

void lookUpAt(const filigree_set& set, std::span<const uint32_t> maps, std::span<const uint32_t> indices,
              std::span<State> states) {
    if (!set.maps) fail(FILIGREE_ERROR_UNSUPPORTED, "set: a bitmask is looked up by texture coordinates");
    inParts(maps.size(), [&](size_t first, size_t count) {
        const auto some = maps.subspan(first, count);
        const auto someIndices = indices.subspan(first, count);
        checkMaps(set, some, first);
        checkIndices(set, some, someIndices, first);
        set.maps->lookup(some, someIndices, states.subspan(first, count));
    });
}

}  // namespace
}  // namespace filigree::capi

using namespace filigree::capi;

int filigree_set_state(const filigree_set* set, uint32_t map, float u, float v) {
    if (set == nullptr || map >= set->view.mapCount) return noState;
    return numberOf(stateAt(*set, map, u, v));
}

int filigree_set_state_at(const filigree_set* set, uint32_t map, uint32_t index) {
    if (set == nullptr || !set->maps || map >= set->view.mapCount || !isIn(*set, map, index)) return noState;
    return numberOf(set->maps->at(map, index));
}

int filigree_set_triangle_state(const filigree_set* set, size_t triangle, float u, float v) {
    if (set == nullptr || triangle >= set->indices.size()) return noState;
    const int32_t index = set->indices[triangle];
    if (index < 0) return numberOf(filigree::micromap::stateOfSpecialIndex(index));
    return filigree_set_state(set, static_cast<uint32_t>(index), u, v);
}

filigree_error filigree_set_lookup(const filigree_set* set, size_t count, const uint32_t* maps,
                                   const float* u, const float* v, uint8_t* states,
                                   filigree_error_info* error) {
    return call(error, [&] {
        const filigree_set& in = required(set, "set");
        const auto mapList = listOf(maps, count, "maps");
        const auto uList = listOf(u, count, "u");
        const auto vList = listOf(v, count, "v");
        lookUp(in, mapList, uList, vList, statesApart(count, states, mapList, uList, vList));
    });
}

filigree_error filigree_set_lookup_at(const filigree_set* set, size_t count, const uint32_t* maps,
                                      const uint32_t* indices, uint8_t* states, filigree_error_info* error) {
    return call(error, [&] {
        const filigree_set& in = required(set, "set");
        const auto mapList = listOf(maps, count, "maps");
        const auto indexList = listOf(indices, count, "indices");
        lookUpAt(in, mapList, indexList, statesApart(count, states, mapList, indexList));
    });
}

uint32_t filigree_curve_index(float u, float v, uint32_t level) {
    if (level > filigree::micromap::maxLevel) return UINT32_MAX;
    return filigree::micromap::barycentricsToIndex(u, v, level);
}
