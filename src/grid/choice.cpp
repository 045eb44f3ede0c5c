#include "grid/choice.h"

#include <algorithm>
#include <limits>

namespace filigree::grid {
namespace {

// The bytes that a grid saves over as many loose triangles: estimates of what the codec `lattice` needs for a
// leaf, a vertex in it, and a loose triangle.
double savingOf(const GrownGrid& grid) {
    constexpr double leafBytes = 50;
    constexpr double vertexBytes = 3;
    constexpr double triangleBytes = 3.2;
    constexpr uint32_t tileQuads = 16;
    const auto tilesAlong = [](uint32_t quads) { return 1.0 + (quads - 1) / tileQuads; };
    const double leaves = tilesAlong(grid.columns) * tilesAlong(grid.rows);
    const double vertices = (grid.columns + 1.0) * (grid.rows + 1.0);
    const double triangles = 2.0 * static_cast<double>(grid.quadCount());
    return triangleBytes * triangles - leafBytes * leaves - vertexBytes * vertices;
}

// Largest grids first, lazily: a seed is tried again only where it, or a grid it was in, came up to the size
// that is looked for.
class Choosing {
  public:
    Choosing(const Topology& topology, std::span<const Vec3> positions, const GrowthRules& rules,
             const Stage& stage)
        : stage_(stage),
          topology_(topology),
          growth_(topology, positions, rules),
          hopes_(topology.triangles.size(), UINT32_MAX),
          free_(topology.triangles.size()) {}

    Choice choose() {
        for (uint64_t least = uint64_t{1} << 22; least > 0; least /= 4) takeFrom(least);
        stage_.advance(free_);
        for (uint32_t t = 0; t < hopes_.size(); ++t) {
            if (growth_.isFree(t) || !topology_.hasThreeVertices(t)) choice_.loose.push_back(t);
        }
        return std::move(choice_);
    }

  private:
    // Takes the grids of `least` quads or more.
    void takeFrom(uint64_t least) {
        for (uint32_t t = 0; t < hopes_.size(); ++t) {
            if (hopes_[t] < least || !growth_.isFree(t)) continue;
            if (stage_.cancelled()) return;
            growAround(t);
            if (best_.quadCount() >= least && saving_ > 0) {
                growth_.take(best_);
                free_ -= 2 * best_.quadCount();
                stage_.advance(2 * best_.quadCount());
                choice_.grids.push_back(std::move(best_));
            } else {
                lowerHopes(t, std::min(best_.quadCount(), least - 1));
            }
        }
    }

    // The largest grid around a triangle: over each of its edges as a diagonal, then with that of the largest
    // in other orders.
    void growAround(uint32_t triangle) {
        best_ = {};
        saving_ = -std::numeric_limits<double>::infinity();
        const uint8_t diagonal = topology_.diagonal[triangle];
        uint32_t bestDiagonal = noEdge;
        for (uint8_t k = 0; k < 3; ++k) {
            if (diagonal != noCorner && diagonal != k) continue;
            if (growOver(3 * triangle + k, GrowthOrder::inTurn)) bestDiagonal = 3 * triangle + k;
            if (isAlmostAll(best_)) return;
        }
        if (bestDiagonal == noEdge) return;
        growOver(bestDiagonal, GrowthOrder::columnsFirst);
        growOver(bestDiagonal, GrowthOrder::rowsFirst);
    }

    // Whether that is the best so far.
    bool growOver(uint32_t diagonal, GrowthOrder order) {
        const GrownGrid& grown = growth_.grow(diagonal, order);
        if (grown.quads.empty() || savingOf(grown) <= saving_) return false;
        best_ = grown;
        saving_ = savingOf(grown);
        return true;
    }

    [[nodiscard]] bool isAlmostAll(const GrownGrid& grid) const {
        return 2 * grid.quadCount() > free_ / 4 * 3;
    }

    void lowerHopes(uint32_t seed, uint64_t hope) {
        for (const PlacedQuad& quad : best_.quads) {
            QuadParts parts;
            if (!partsOf(topology_, quad, parts)) continue;
            for (const uint32_t t : {quad.edge / 3, parts.second})
                hopes_[t] = static_cast<uint32_t>(std::min<uint64_t>(hopes_[t], hope));
        }
        hopes_[seed] = saving_ > 0 ? static_cast<uint32_t>(hope) : 0;
    }

    const Stage& stage_;
    const Topology& topology_;
    Growth growth_;
    std::vector<uint32_t> hopes_;  // [triangle_count], quads of the grid that it may come into
    uint64_t free_;                // triangles
    GrownGrid best_;
    double saving_ = 0;  // of best_
    Choice choice_;
};

}  // namespace

Choice chooseGrids(const Topology& topology, std::span<const Vec3> positions, const GrowthRules& rules,
                   const Stage& stage) {
    return Choosing(topology, positions, rules, stage).choose();
}

}  // namespace filigree::grid
