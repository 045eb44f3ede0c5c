#include "image/arcs.h"

#include <algorithm>
#include <cmath>

namespace filigree::image {
namespace {

constexpr double splitBulge = 1.0 / 64;  // an arc is split until it bulges less, texels
constexpr int mostSplits = 4;            // halvings of one arc

bool isBetween(double v, double a, double b) {
    return v >= std::min(a, b) && v <= std::max(a, b);
}

double distanceToChord(const Arc& arc, const ArcPoint& p) {
    const double dx = arc.to.x - arc.from.x;
    const double dy = arc.to.y - arc.from.y;
    const double length = std::hypot(dx, dy);
    if (length == 0) return std::hypot(p.x - arc.from.x, p.y - arc.from.y);
    return std::fabs(dx * (p.y - arc.from.y) - dy * (p.x - arc.from.x)) / length;
}

// Appends an arc as pieces, split until they are nearly straight.
void appendArc(const Patch& patch, const Arc& arc, int splits, std::vector<ArcPiece>& to) {
    double bulge = 0;
    if (patch.twist != 0) {
        const std::optional<ArcPoint> middle = middleOf(patch, arc);
        bulge = bulgeOf(arc, middle);
        if (middle && bulge > splitBulge && splits < mostSplits) {
            appendArc(patch, {arc.from, *middle}, splits + 1, to);
            appendArc(patch, {*middle, arc.to}, splits + 1, to);
            return;
        }
    }
    to.push_back({arc, bulge});
}

// Corners of a cell in turn: 00, 10, 11, 01. Edge k runs from corner k to corner k + 1.
constexpr std::array<ArcPoint, 4> cornerAt{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

// Where the outline meets edge k, whose ends take `a` and `b` of opposite sides.
ArcPoint crossing(unsigned k, double a, double b) {
    const double t = std::clamp(a / (a - b), 0.0, 1.0);
    const ArcPoint p = cornerAt[k];
    const ArcPoint q = cornerAt[(k + 1) % 4];
    return {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
}

}  // namespace

std::optional<ArcPoint> middleOf(const Patch& patch, const Arc& arc) {
    const bool alongX = std::fabs(arc.to.x - arc.from.x) >= std::fabs(arc.to.y - arc.from.y);
    const double from = alongX ? arc.from.x : arc.from.y;
    const double to = alongX ? arc.to.x : arc.to.y;
    const double across = alongX ? patch.alongY : patch.alongX;
    const double along = alongX ? patch.alongX : patch.alongY;
    double at = (from + to) / 2;
    if (patch.twist != 0) {
        const double pole = -across / patch.twist;
        const double product = (from - pole) * (to - pole);
        if (!(product > 0)) return std::nullopt;
        at = pole + (from < pole ? -1 : 1) * std::sqrt(product);
        at = std::clamp(at, std::min(from, to), std::max(from, to));
    }
    const double denominator = across + patch.twist * at;
    if (std::fabs(denominator) <= 1e-9 * (std::fabs(across) + std::fabs(patch.twist))) return std::nullopt;
    const double other = (patch.threshold - patch.corner - along * at) / denominator;
    const ArcPoint middle = alongX ? ArcPoint{at, other} : ArcPoint{other, at};
    const bool inside =
        isBetween(middle.x, arc.from.x, arc.to.x) && isBetween(middle.y, arc.from.y, arc.to.y);
    return inside ? std::optional(middle) : std::nullopt;
}

double bulgeOf(const Arc& arc, const std::optional<ArcPoint>& middle) {
    const double most = distanceToChord(arc, {arc.from.x, arc.to.y});
    return middle ? std::min(most, distanceToChord(arc, *middle) * 1.001 + 1e-6) : most;
}

void appendBilinear(const Patch& patch, const std::array<double, 4>& v, std::vector<ArcPiece>& to) {
    std::array<ArcPoint, 4> met{};
    unsigned count = 0;
    for (unsigned k = 0; k < 4; ++k) {
        if ((v[k] >= 0) == (v[(k + 1) % 4] >= 0)) continue;
        met[count++] = crossing(k, v[k], v[(k + 1) % 4]);
    }
    if (count == 2) {
        appendArc(patch, {met[0], met[1]}, 0, to);
    } else if (count == 4) {
        // A saddle: two arcs. Where the saddle's value joins the corners of corner 0's side, they cut off the
        // others.
        const double saddle = patch.corner - patch.threshold - patch.alongX * patch.alongY / patch.twist;
        const bool joinsCorner0 = (saddle >= 0) == (v[0] >= 0);
        const unsigned first = joinsCorner0 ? 0 : 3;
        appendArc(patch, {met[first], met[(first + 1) % 4]}, 0, to);
        appendArc(patch, {met[(first + 2) % 4], met[(first + 3) % 4]}, 0, to);
    }
}

void appendNearest(const std::array<bool, 4>& opaque, std::vector<ArcPiece>& to) {
    for (unsigned k = 0; k < 4; ++k) {
        if (opaque[k] == opaque[(k + 1) % 4]) continue;
        const ArcPoint& p = cornerAt[k];
        const ArcPoint& q = cornerAt[(k + 1) % 4];
        to.push_back({{{(p.x + q.x) / 2, (p.y + q.y) / 2}, {0.5, 0.5}}, 0});
    }
}

}  // namespace filigree::image
