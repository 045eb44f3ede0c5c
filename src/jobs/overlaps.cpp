#include "jobs/overlaps.h"

#include "jobs/tile_copies.h"

#include <algorithm>

namespace filigree::jobs {
namespace {

constexpr uint32_t mostSide = 2048;

uint32_t cells(uint32_t side, uint32_t longest) {
    const uint32_t every = (longest + mostSide - 1) / mostSide;
    return std::max(1U, side / every);
}

}  // namespace

std::map<uint32_t, double> overlapShares(const image::AlphaTexture& texture,
                                         const std::vector<OverlayTriangle>& triangles) {
    const uint32_t longest = std::max(texture.image.width, texture.image.height);
    const uint32_t width = cells(texture.image.width, longest);
    const uint32_t height = cells(texture.image.height, longest);
    std::vector<uint32_t> counts(size_t{width} * height, 0);
    for (const OverlayTriangle& t : triangles) {
        for (const auto& corners : tileCopies(t.uv, texture.wrapU, texture.wrapV, width, height)) {
            forEachSpan(corners, width, height, [&](uint32_t y, uint32_t first, uint32_t end) {
                for (uint32_t x = first; x < end; ++x) ++counts[size_t{y} * width + x];
            });
        }
    }
    std::map<uint32_t, uint64_t> texels;
    for (const uint32_t count : counts) ++texels[count];
    std::map<uint32_t, double> shares;
    for (const auto& [count, number] : texels)
        shares[count] = static_cast<double>(number) / static_cast<double>(counts.size());
    return shares;
}

}  // namespace filigree::jobs
