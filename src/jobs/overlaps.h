// How many triangles lie over each place of a texture (Waldemarson and Doggett 2024, figure 11).
#pragma once

#include "filigree/image/alpha_image.h"

#include "jobs/overlay.h"

#include <cstdint>
#include <map>
#include <vector>

namespace filigree::jobs {

// The share of the texture's texels, of one, over which so many of `triangles` lie, 0 too. Texels count by
// their centres; of a texture above 2048 texels a side, every n-th.
std::map<uint32_t, double> overlapShares(const image::AlphaTexture& texture,
                                         const std::vector<OverlayTriangle>& triangles);

}  // namespace filigree::jobs
