// Marks the micro-triangles that the outline crosses.
#pragma once

#include "filigree/image/outline.h"

#include "bake/tile.h"

namespace filigree::bake {

// True when `part`, widened by `guard` texels, may touch the outline. False is proven.
bool mayCross(const SubTriangle& part, const Placement& placement, const image::Outline& outline,
              double guard);

// True when the lattice of `part` can be measured in double: false for triangles too thin, lines and points.
// Those are classified one micro-triangle at a time.
bool isTraceable(const SubTriangle& part, const Placement& placement, double guard);

// Sets tile.unknown for each micro-triangle of `part` (part.height == tile.height <= tileLevel) that the
// outline crosses. A micro-triangle left clear is proven clear. The work is that of the outline: pieces are
// carried into the lattice and only micro-triangles next to them are looked at.
void markCrossed(const SubTriangle& part, const Placement& placement, const image::Outline& outline,
                 double guard, Tile& tile);

}  // namespace filigree::bake
