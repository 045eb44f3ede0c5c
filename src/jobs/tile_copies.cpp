#include "jobs/tile_copies.h"

#include <algorithm>
#include <cmath>

namespace filigree::jobs {
namespace {

constexpr size_t mostAxisCopies = 64;

// How one copy of a triangle comes into the tile along one axis: offset + sign * coordinate.
struct AxisCopy {
    double offset = 0;
    double sign = 1;
    [[nodiscard]] double operator()(double coordinate) const { return offset + sign * coordinate; }
};

std::vector<AxisCopy> copiesAlong(double lo, double hi, image::Wrap wrap) {
    if (wrap == image::Wrap::clampToEdge) return {{0, 1}};
    std::vector<AxisCopy> copies;
    const double first = std::floor(lo);
    const double last = std::max(first, std::ceil(hi) - 1);
    for (double tile = first; tile <= last && copies.size() < mostAxisCopies; ++tile) {
        const bool odd = std::fmod(std::abs(tile), 2) == 1;
        if (odd && wrap == image::Wrap::mirroredRepeat) {
            copies.push_back({tile + 1, -1});
        } else {
            copies.push_back({-tile, 1});
        }
    }
    return copies;
}

bool isNear(const std::array<mesh::Uv, 3>& uv) {
    return std::all_of(uv.begin(), uv.end(), [](const mesh::Uv& corner) {
        return std::abs(corner.u) < 0x1p20F && std::abs(corner.v) < 0x1p20F;
    });
}

}  // namespace

std::vector<std::array<Pixel, 3>> tileCopies(const std::array<mesh::Uv, 3>& uv, image::Wrap wrapU,
                                             image::Wrap wrapV, uint32_t width, uint32_t height) {
    std::vector<std::array<Pixel, 3>> copies;
    if (!isNear(uv)) return copies;
    const auto [u0, u1] = std::minmax({uv[0].u, uv[1].u, uv[2].u});
    const auto [v0, v1] = std::minmax({uv[0].v, uv[1].v, uv[2].v});
    const auto alongV = copiesAlong(v0, v1, wrapV);
    for (const AxisCopy& cu : copiesAlong(u0, u1, wrapU)) {
        for (const AxisCopy& cv : alongV) {
            auto& corners = copies.emplace_back();
            for (size_t k = 0; k < 3; ++k) corners[k] = {cu(uv[k].u) * width, cv(uv[k].v) * height};
        }
    }
    return copies;
}

}  // namespace filigree::jobs
