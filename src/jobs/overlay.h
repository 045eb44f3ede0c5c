// Micro-triangles drawn over the alpha that they stand for.
#pragma once

#include "filigree/image/alpha_image.h"
#include "filigree/mesh/uv_triangle.h"
#include "filigree/micromap/set.h"

#include "jobs/canvas.h"
#include "jobs/overlay_legend.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace filigree::jobs {

struct OverlayTriangle {
    std::array<mesh::Uv, 3> uv;
    const micromap::FlatSet* set = nullptr;
    int32_t index = 0;  // a record of `set`, or special
};

struct Overlay {
    Canvas canvas;
    size_t drawn = 0;  // triangles; fewer than there are where a scene would take too long
};

// The texture's tile, at most 2048 pixels a side, its alpha in grey, with `triangles` in order over it. Parts
// beyond the tile come back into it as the wrap modes say; with clampToEdge they are cut. Triangles that are
// not finite are passed over. Same input, same picture.
Overlay drawOverlay(const image::AlphaTexture& texture, double factor,
                    const std::vector<OverlayTriangle>& triangles, const OverlayLegend& legend);

}  // namespace filigree::jobs
