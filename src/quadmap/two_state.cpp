#include "filigree/quadmap/two_state.h"

#include <array>
#include <bit>
#include <cmath>

namespace filigree::quadmap {
namespace {

// What regions first, first + 1 and first + 2 along one axis count.
struct AxisWeights {
    int first = 0;
    std::array<float, 3> weights{};
};

// `at`: the coordinate in regions, 0..side.
AxisWeights bilinear(float at) {
    const float low = std::floor(at - 0.5F);
    const float part = at - 0.5F - low;
    return {static_cast<int>(low), {1 - part, part, 0}};
}

AxisWeights spline(float at, unsigned region) {
    const float t = at - static_cast<float>(region) - 0.5F;
    const float before = 0.5F - t;
    const float behind = 0.5F + t;
    return {static_cast<int>(region) - 1, {before * before / 2, 0.75F - t * t, behind * behind / 2}};
}

float chanceOf(Region region) {
    return static_cast<float>(region) / 2;
}

float inRegions(float coordinate, unsigned side) {
    return std::min(coordinate > 0 ? coordinate : 0.0F, 1.0F) * static_cast<float>(side);
}

constexpr uint32_t mixed(uint32_t bits) {
    // Two rounds of multiply and xor-shift (Wellons 2018, "lowbias32").
    bits = (bits ^ bits >> 16) * 0x7feb352dU;
    bits = (bits ^ bits >> 15) * 0x846ca68bU;
    return bits ^ bits >> 16;
}

}  // namespace

float opaqueChance(const SquareReader& reader, size_t map, Half half, float u, float v,
                   Neighbourhood neighbourhood) {
    const unsigned side = sideOf(reader.format());
    const SquarePoint point = pointInSquare(half, u, v);
    const unsigned column = regionAlong(point.x, side);
    const unsigned row = regionAlong(point.y, side);
    const Region own = reader.at(map, column, row);
    if (own != Region::mixed) return chanceOf(own);
    const bool two = neighbourhood == Neighbourhood::two;
    const float x = inRegions(point.x, side);
    const float y = inRegions(point.y, side);
    const AxisWeights across = two ? bilinear(x) : spline(x, column);
    const AxisWeights down = two ? bilinear(y) : spline(y, row);
    const auto inside = [&](int at) {
        return static_cast<unsigned>(std::clamp(at, 0, static_cast<int>(side) - 1));
    };
    float chance = 0;
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            const float weight =
                across.weights[static_cast<size_t>(i)] * down.weights[static_cast<size_t>(j)];
            if (weight == 0) continue;
            chance += weight * chanceOf(reader.at(map, inside(across.first + i), inside(down.first + j)));
        }
    }
    return chance;
}

float hashOf(float u, float v, uint32_t seed) {
    const uint32_t bits = mixed(mixed(std::bit_cast<uint32_t>(u) ^ seed) + std::bit_cast<uint32_t>(v));
    return static_cast<float>(bits >> 8) * 0x1p-24F;
}

bool isHit(const SquareReader& reader, size_t map, Half half, float u, float v, Neighbourhood neighbourhood,
           uint32_t seed) {
    return hashOf(u, v, seed) < opaqueChance(reader, map, half, u, v, neighbourhood);
}

}  // namespace filigree::quadmap
