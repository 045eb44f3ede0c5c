#include "grid/growth.h"

#include <algorithm>

namespace filigree::grid {
namespace {

constexpr uint32_t mostQuadsAlong = 65535;
constexpr std::array<Side, 2> columnSides{Side::right, Side::left};
constexpr std::array<Side, 2> rowSides{Side::top, Side::bottom};
constexpr std::array<Side, 4> allSides{Side::right, Side::top, Side::left, Side::bottom};

// Whether a quad of the mesh, if the triangle of `edge` belongs to one, is halved there.
bool mayBeDiagonal(const Topology& topology, uint32_t edge) {
    const uint8_t diagonal = topology.diagonal[edge / 3];
    return diagonal == noCorner || diagonal == edge % 3;
}

double squareOff(const Vec3& at, const Vec3& before, const Vec3& reached) {
    double sum = 0;
    for (size_t k = 0; k < 3; ++k) {
        const double off = double{reached[k]} - (2 * double{at[k]} - double{before[k]});
        sum += off * off;
    }
    return sum;
}

}  // namespace

bool partsOf(const Topology& topology, const PlacedQuad& quad, QuadParts& parts) {
    const uint32_t inside = quad.bd ? nextEdge(quad.edge) : previousEdge(quad.edge);
    const uint32_t twin = topology.twins[inside];
    if (twin == noEdge || twin / 3 == quad.edge / 3) return false;
    if (!mayBeDiagonal(topology, inside) || !mayBeDiagonal(topology, twin)) return false;
    const uint32_t one = nextEdge(twin);
    const uint32_t two = previousEdge(twin);
    parts.second = twin / 3;
    if (quad.bd) {
        parts.right = one;
        parts.top = two;
        parts.left = previousEdge(quad.edge);
    } else {
        parts.right = nextEdge(quad.edge);
        parts.top = one;
        parts.left = two;
    }
    parts.c = topology.from(parts.top);
    parts.d = topology.from(parts.left);
    return quad.bd ? parts.c != topology.from(quad.edge) : parts.d != topology.from(nextEdge(quad.edge));
}

void Growth::Border::clear() {
    front.clear();
    back.clear();
}

void Growth::Border::copyTo(std::vector<BorderEdge>& all) const {
    all.assign(front.rbegin(), front.rend());
    all.insert(all.end(), back.begin(), back.end());
}

Growth::Growth(const Topology& topology, std::span<const Vec3> positions, const GrowthRules& rules)
    : topology_(topology), positions_(positions), rules_(rules), marks_(topology.triangles.size()) {
    for (uint32_t t = 0; t < marks_.size(); ++t) {
        if (!topology.hasThreeVertices(t)) take(t);
    }
}

const GrownGrid& Growth::grow(uint32_t diagonal, GrowthOrder order) {
    if (!seed(diagonal)) return grid_;
    bool goesOn = growInTurn(allSides);
    if (order != GrowthOrder::inTurn) {
        const auto first = order == GrowthOrder::columnsFirst ? columnSides : rowSides;
        while (goesOn && !isStrip()) goesOn = growInTurn(first);
        goesOn = true;
    }
    while (goesOn && !isStrip()) goesOn = growInTurn(allSides);
    return grid_;
}

// One quad wide for good: not worth a grid, and it may be long.
bool Growth::isStrip() const {
    const auto blocked = [&](std::span<const Side> sides) {
        return std::ranges::all_of(sides, [&](Side side) { return blocked_[static_cast<size_t>(side)]; });
    };
    return (grid_.columns == 1 && blocked(columnSides)) || (grid_.rows == 1 && blocked(rowSides));
}

void Growth::take(const GrownGrid& grid) {
    for (const PlacedQuad& quad : grid.quads) {
        QuadParts parts;
        if (!partsOf(topology_, quad, parts)) continue;
        take(quad.edge / 3);
        take(parts.second);
    }
}

void Growth::beginEpoch() {
    if (++epoch_ < taken) return;
    for (uint32_t& mark : marks_) mark = mark == taken ? taken : 0;
    epoch_ = 1;
}

bool Growth::seed(uint32_t diagonal) {
    beginEpoch();
    grid_.lines.clear();
    grid_.quads.clear();
    blocked_ = {};
    for (Border& border : borders_) border.clear();
    // The half-edge c -> a of the quad a b c d.
    const PlacedQuad quad{nextEdge(diagonal), false};
    QuadParts parts;
    if (!partsOf(topology_, quad, parts) || !isFree(diagonal / 3) || !isFree(parts.second)) return false;
    marks_[diagonal / 3] = marks_[parts.second] = epoch_;
    grid_.columns = grid_.rows = 1;
    grid_.lines.push_back({Side::top, 0});
    grid_.quads.push_back(quad);
    const uint32_t a = topology_.from(quad.edge);
    const uint32_t b = topology_.from(nextEdge(quad.edge));
    borders_[0].back.push_back({quad.edge, parts.d, parts.c});
    borders_[1].back.push_back({parts.right, a, parts.d});
    borders_[2].back.push_back({parts.top, b, a});
    borders_[3].back.push_back({parts.left, parts.c, b});
    return true;
}

bool Growth::growInTurn(std::span<const Side> sides) {
    bool any = false;
    for (const Side side : sides) {
        if (!blocked_[static_cast<size_t>(side)]) any = growSide(side) || any;
    }
    return any;
}

// Over the first edge of a side a line can begin with either diagonal; both may run through where all
// vertices have six neighbours. Then the line goes on as the lines before it did, which the straighter one
// shows.
bool Growth::growSide(Side side) {
    borders_[static_cast<size_t>(side)].copyTo(border_);
    const bool ac = countAlong(side) < mostQuadsAlong && sweep(side, false, trials_[0]);
    if (ac) unmark(trials_[0]);
    const bool bd = countAlong(side) < mostQuadsAlong && sweep(side, true, trials_[1]);
    if (bd) unmark(trials_[1]);
    if (!ac && !bd) {
        blocked_[static_cast<size_t>(side)] = true;
        return false;
    }
    add(side, trials_[ac && (!bd || bend(trials_[0]) <= bend(trials_[1])) ? 0 : 1]);
    return true;
}

bool Growth::sweep(Side side, bool firstIsBd, Trial& trial) {
    trial.quads.clear();
    trial.parts.clear();
    for (size_t at = 0; at < border_.size(); ++at) {
        if (!sweepOne(side, at, firstIsBd, trial)) {
            unmark(trial);
            return false;
        }
        marks_[trial.quads.back().edge / 3] = marks_[trial.parts.back().second] = epoch_;
    }
    return true;
}

bool Growth::breaksRules(Side side, const PlacedQuad& quad) const {
    const bool turned = side == Side::right || side == Side::left;
    const bool mayTurn = rules_.turnQuads && topology_.diagonal[quad.edge / 3] != noCorner;
    return rules_.uniformDiagonals && !mayTurn && quad.bd != turned;
}

// In a quad's own frame the line runs from right to left: its corner c is the corner d of the quad before.
bool Growth::sweepOne(Side side, size_t at, bool firstIsBd, Trial& trial) {
    PlacedQuad quad{topology_.twins[border_[at].edge], firstIsBd};
    if (quad.edge == noEdge || !isUnmarked(quad.edge / 3)) return false;
    if (at > 0) quad.bd = topology_.from(previousEdge(quad.edge)) != trial.parts.back().d;
    if (breaksRules(side, quad)) return false;
    QuadParts parts;
    if (!partsOf(topology_, quad, parts) || !isUnmarked(parts.second)) return false;
    if (at > 0 && parts.c != trial.parts.back().d) return false;
    trial.quads.push_back(quad);
    trial.parts.push_back(parts);
    return true;
}

void Growth::unmark(const Trial& trial) {
    for (size_t k = 0; k < trial.quads.size(); ++k)
        marks_[trial.quads[k].edge / 3] = marks_[trial.parts[k].second] = 0;
}

// How far the line's new vertices are from where they would be if the lines across went straight on: squares
// summed over some of them.
double Growth::bend(const Trial& trial) const {
    constexpr size_t samples = 64;
    const size_t step = std::max<size_t>(1, trial.quads.size() / samples);
    double sum = 0;
    for (size_t k = 0; k < trial.quads.size(); k += step) {
        const BorderEdge& border = border_[k];
        const Vec3& b = positions_[topology_.from(border.edge)];
        const Vec3& a = positions_[topology_.from(nextEdge(border.edge))];
        sum += squareOff(b, positions_[border.beforeFrom], positions_[trial.parts[k].c]);
        sum += squareOff(a, positions_[border.beforeTo], positions_[trial.parts[k].d]);
    }
    return sum;
}

void Growth::add(Side side, const Trial& trial) {
    grid_.lines.push_back({side, grid_.quads.size()});
    grid_.quads.insert(grid_.quads.end(), trial.quads.begin(), trial.quads.end());
    Border& border = borders_[static_cast<size_t>(side)];
    border.clear();
    for (size_t k = 0; k < trial.quads.size(); ++k) {
        const QuadParts& parts = trial.parts[k];
        marks_[trial.quads[k].edge / 3] = marks_[parts.second] = epoch_;
        const uint32_t a = topology_.from(trial.quads[k].edge);
        const uint32_t b = topology_.from(nextEdge(trial.quads[k].edge));
        border.back.push_back({parts.top, b, a});
    }
    const QuadParts& first = trial.parts.front();
    const QuadParts& last = trial.parts.back();
    const uint32_t firstA = topology_.from(trial.quads.front().edge);
    const uint32_t lastB = topology_.from(nextEdge(trial.quads.back().edge));
    borders_[static_cast<size_t>(sideBefore(side))].back.push_back({first.right, firstA, first.d});
    borders_[static_cast<size_t>(sideAfter(side))].front.push_back({last.left, last.c, lastB});
    ++countAlong(side);
}

// How many lines lie on one another where the grid grows at `side`.
uint32_t& Growth::countAlong(Side side) {
    return side == Side::right || side == Side::left ? grid_.columns : grid_.rows;
}

}  // namespace filigree::grid
