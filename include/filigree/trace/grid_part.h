// Compressed grids as a part of a world.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/box.h"
#include "filigree/core/vec3.h"
#include "filigree/grid/attributes.h"
#include "filigree/grid/encoded_grids.h"
#include "filigree/grid/rays.h"
#include "filigree/grid/vertex_grid.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>

namespace filigree::trace {

// Opaque, in world units, beside what Embree holds. All that it points to must outlive the world.
struct GridPart {
    const grid::EncodedGrids* grids = nullptr;  // checked (grid/check.h); null: none
    std::span<const grid::VertexGrid> table;
    uint64_t triangles = 0;
    // For smooth normals; null or without normals: flat triangles.
    const grid::GridAttributes* attributes = nullptr;
    // The diffuse colour where a ray hits, linear; empty: as bare earth.
    std::function<Vec3(const grid::Hit& hit)> albedo;
};

// The linear colour of one in 8-bit sRGB, for GridPart::albedo.
FILIGREE_API Vec3 albedoOfSrgb(const std::array<uint8_t, 3>& srgb);

// Around all of it, up to the rounding of the hierarchy's boxes.
FILIGREE_API Box boundsOf(const GridPart& part);

}  // namespace filigree::trace
