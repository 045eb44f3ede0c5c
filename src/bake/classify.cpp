#include "bake/classify.h"

#include "filigree/micromap/quadtree_writer.h"

#include "bake/majority.h"
#include "bake/trace.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

namespace filigree::bake {
namespace {

constexpr unsigned parallelHeight = 9;  // parts of at least 4^9 micro-triangles are shared out
constexpr double widestTile = 4;        // periods of the texture that a tile may span before it is divided
constexpr double widestMicro = 256;     // cells that a micro-triangle of a tile may span before it is divided

// The side of a part that no outline of a layer crosses: one point tells, and the one furthest from the
// threshold tells best. None where all are too close to call.
std::optional<bool> sideOf(const SubTriangle& part, const Placement& placement,
                           const image::Outline& outline) {
    const auto [a, b, c] = part.corners(placement);
    image::Outline::Side best = outline.sideAt((a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3);
    if (best.distance > 1e-3) return best.opaque;
    for (const Point<double>& p : {a, b, c}) {
        const image::Outline::Side side = outline.sideAt(p.x, p.y);
        if (side.distance > best.distance) best = side;
    }
    return best.distance > 1e-9 ? std::optional(best.opaque) : std::nullopt;
}

micromap::StateCounts countStates(const Tile& tile, bool twoState) {
    micromap::StateCounts counts;
    const uint64_t used = tile.count() < 64 ? (uint64_t{1} << tile.count()) - 1 : ~uint64_t{0};
    for (uint32_t k = 0; k < tile.count(); k += 64) {
        const uint64_t unknown = twoState ? 0 : tile.unknown.word(k / 64);
        const uint64_t side = tile.side.word(k / 64);
        counts.of[0] += static_cast<unsigned>(std::popcount(~unknown & ~side & used));
        counts.of[1] += static_cast<unsigned>(std::popcount(~unknown & side));
        counts.of[2] += static_cast<unsigned>(std::popcount(unknown & ~side));
        counts.of[3] += static_cast<unsigned>(std::popcount(unknown & side));
    }
    return counts;
}

class Classifier {
  public:
    Classifier(const mesh::UvTriangle& triangle, const Field& field, bool twoState)
        : field_(field), twoState_(twoState) {
        for (const Layer& layer : field.layers()) placements_.emplace_back(triangle, layer.outline);
    }

    // Appends the quadtree of `part`. Returns the state when it is one leaf, else -1.
    int visit(const SubTriangle& part, const Executor& executor, Classified& to) const {
        if (part.height > tileLevel || !fitsTile(part)) {
            if (const int state = uniformState(part); state >= 0) {
                return to.appendLeaf(part.height, twoState_ ? state & 1 : state);
            }
            if (part.height > 0) return visitChildren(part, executor, to);
        }
        return visitTile(part, to);
    }

  private:
    // The state of a part that is all one, or -1 where it may not be.
    [[nodiscard]] int uniformState(const SubTriangle& part) const {
        for (size_t k = 0; k < placements_.size(); ++k) {
            if (isCrossed(part, placements_[k], field_.layers()[k].outline, field_.guard())) return -1;
        }
        if (const std::optional<bool> side = commonSide(part)) return *side ? 1 : 0;
        if (isCrossed(part, sidePlacement(), field_.sideOutline(), 0)) return -1;
        return sideOf(part, sidePlacement(), field_.sideOutline()).value_or(true) ? 3 : 2;
    }

    // Where the tracer cannot take over, a part is looked at closely before it is divided: else a triangle
    // much smaller than a texel would be divided to the end for an outline next to it.
    static bool isCrossed(const SubTriangle& part, const Placement& placement, const image::Outline& outline,
                          double guard) {
        if (!mayCross(part, placement, outline, guard)) return false;
        if (isTraceable(part, placement, guard)) return true;
        Tile one;
        one.reset(0);
        markCrossed({part.level, 0, part.corner}, placement, outline, guard, one);
        return one.unknown.test(0);
    }

    // The side of a part that no outline crosses, where all layers agree on it.
    [[nodiscard]] std::optional<bool> commonSide(const SubTriangle& part) const {
        std::optional<bool> common;
        for (size_t k = 0; k < placements_.size(); ++k) {
            const std::optional<bool> side = sideOf(part, placements_[k], field_.layers()[k].outline);
            if (!side || (common && *common != *side)) return std::nullopt;
            common = side;
        }
        return common;
    }

    // False for parts that are better divided: too thin for the lattice, many periods of the texture wide, or
    // so coarse that to follow the outline costs more than to find one piece of it in each micro-triangle.
    [[nodiscard]] bool fitsTile(const SubTriangle& part) const {
        if (part.height == 0) return true;
        for (size_t k = 0; k < placements_.size(); ++k) {
            if (!isTraceable(part, placements_[k], field_.guard())) return false;
            const image::Outline& outline = field_.layers()[k].outline;
            const double coarse = widestMicro * static_cast<double>(int64_t{1} << part.height);
            const double width = std::min(coarse, widestTile * static_cast<double>(outline.axisX().cells));
            const double height = std::min(coarse, widestTile * static_cast<double>(outline.axisY().cells));
            const auto [a, b, c] = part.corners(placements_[k]);
            for (const Point<double>& p : {b, c}) {
                if (std::fabs(p.x - a.x) > width || std::fabs(p.y - a.y) > height) return false;
            }
        }
        return true;
    }

    int visitChildren(const SubTriangle& part, const Executor& executor, Classified& to) const {
        if (part.height < parallelHeight || executor.concurrency() == 1) {
            return micromap::appendInner(to.stream, part.height,
                                         [&](unsigned k) { return visit(part.child(k), executor, to); });
        }
        const size_t start = to.stream.size();
        std::array<Classified, 4> children;
        std::array<int, 4> states{};
        executor.parallelFor(4, 1, [&](size_t begin, size_t end) {
            for (size_t k = begin; k < end; ++k) {
                states[k] = visit(part.child(static_cast<unsigned>(k)), executor, children[k]);
            }
        });
        to.stream.append(1, 1);
        for (const Classified& child : children) {
            to.stream.append(child.stream);
            to.states.add(child.states);
        }
        return micromap::endInner(to.stream, start, part.height, states);
    }

    int visitTile(const SubTriangle& part, Classified& to) const {
        Tile tile;
        tile.reset(part.height);
        for (size_t k = 0; k < placements_.size(); ++k) {
            markCrossed(part, placements_[k], field_.layers()[k].outline, field_.guard(), tile);
        }
        fillClear(part, tile);
        decideUnknown(part, tile);
        to.states.add(countStates(tile, twoState_));
        return appendTile(tile, twoState_, to.stream);
    }

    // Gives each run of clear micro-triangles its state. Neighbours on the curve share a corner, so a run
    // without a crossing lies on one side.
    void fillClear(const SubTriangle& part, Tile& tile) const {
        const TileCurve& curve = TileCurve::of(part.height);
        for (uint32_t first = tile.unknown.find(false, 0, tile.count()); first < tile.count();) {
            const uint32_t end = tile.unknown.find(true, first, tile.count());
            if (const std::optional<bool> side = commonSide(microTriangle(part, curve.triangle(first)))) {
                if (*side) tile.side.setRange(first, end);
            } else {
                tile.unknown.setRange(first, end);
            }
            first = tile.unknown.find(false, end, tile.count());
        }
    }

    static SubTriangle microTriangle(const SubTriangle& part, micromap::LatticeTriangle t) {
        SubTriangle one{part.level, 0, {}};
        const auto lattice = micromap::corners(t);
        for (size_t k = 0; k < 3; ++k) {
            const auto [i, j] = part.global(lattice[k].i, lattice[k].j);
            one.corner[k] = {static_cast<uint32_t>(i), static_cast<uint32_t>(j)};
        }
        return one;
    }

    void decideUnknown(const SubTriangle& part, Tile& tile) const {
        const uint32_t first = tile.unknown.find(true, 0, tile.count());
        if (first == tile.count()) return;
        const TileCurve& curve = TileCurve::of(part.height);
        const SideRule rule(part, sidePlacement(), field_.sideOutline());
        for (uint32_t k = first; k < tile.count(); k = tile.unknown.find(true, k + 1, tile.count())) {
            if (rule.isOpaque(curve.triangle(k))) tile.side.set(k);
        }
    }

    // The side outline lies at mip level 0, as the first layer does.
    [[nodiscard]] const Placement& sidePlacement() const { return placements_.front(); }

    const Field& field_;
    bool twoState_;
    std::vector<Placement> placements_;  // one a layer
};

}  // namespace

int Classified::appendLeaf(unsigned height, int state) {
    states.of[static_cast<size_t>(state)] += micromap::microTriangleCount(height);
    return micromap::appendLeaf(stream, height, state);
}

void classify(const mesh::UvTriangle& triangle, const Field& field, unsigned level, bool twoState,
              const Executor& executor, Classified& to) {
    const Classifier classifier(triangle, field, twoState);
    if (triangle.uv[0] == triangle.uv[1] && triangle.uv[0] == triangle.uv[2]) {
        // All micro-triangles are one point.
        Classified point;
        to.appendLeaf(level, classifier.visit(SubTriangle::whole(0), executor, point));
        return;
    }
    classifier.visit(SubTriangle::whole(level), executor, to);
}

}  // namespace filigree::bake
