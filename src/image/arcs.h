// The outline inside one cell: arcs of hyperbolas under bilinear filtering, half lines under nearest.
#pragma once

#include "filigree/image/patch.h"

#include <array>
#include <optional>
#include <vector>

namespace filigree::image {

// A point relative to the cell.
struct ArcPoint {
    double x = 0;
    double y = 0;
};

// The curve patch == 0 between two points of a cell. It is one branch of a hyperbola (or a line): convex, and
// monotone in x and in y, so it stays inside the rectangle that its ends span.
struct Arc {
    ArcPoint from;
    ArcPoint to;
};

// An arc and how far it may lie from its chord, in texels.
struct ArcPiece {
    Arc arc;
    double bulge = 0;
};

// The furthest point of an arc from its chord: where the tangent is parallel to it. On y = A + B / (x - s)
// that is the geometric mean of the ends' distances to s. None where rounding could move it far, next to a
// saddle at the threshold.
std::optional<ArcPoint> middleOf(const Patch& patch, const Arc& arc);

// How far an arc may stray from its chord. Whatever it does, it stays in the rectangle of its ends.
double bulgeOf(const Arc& arc, const std::optional<ArcPoint>& middle);

// Appends the arcs of a bilinear cell whose corners 00, 10, 11, 01 take the values `v` (minus the threshold;
// opaque where
// >= 0), in pieces that are nearly straight.
void appendBilinear(const Patch& patch, const std::array<double, 4>& v, std::vector<ArcPiece>& to);

// Appends the outline of a cell under nearest filtering, given which of its corners 00, 10, 11, 01 are
// opaque: texel squares meet at the cell's middle, along half lines between texels of unlike side.
void appendNearest(const std::array<bool, 4>& opaque, std::vector<ArcPiece>& to);

}  // namespace filigree::image
