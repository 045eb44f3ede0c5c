#include "grid/tile_fields.h"

namespace filigree::grid {
namespace {

template <class T, class Of>
void setAxisLanes(std::array<T, 16>& lanes, const Of& of) {
    lanes = {};
    for (unsigned axis = 0; axis < 3; ++axis)
        for (unsigned k = 0; k < 4; ++k) lanes[4 * axis + k] = static_cast<T>(of(axis));
}

unsigned fieldBits(const std::array<uint8_t, 16>& widths, unsigned drop) {
    unsigned bits = 0;
    for (unsigned axis = 0; axis < 3; ++axis)
        bits += widths[4 * axis] - std::min<unsigned>(widths[4 * axis], drop);
    return bits;
}

void setWidths(const TileHeader& head, TilePlan& plan) {
    for (unsigned c = 0; c < residualClasses; ++c) {
        setAxisLanes(plan.widths[c], [&](unsigned axis) { return head.width[axis][c]; });
        setAxisLanes(plan.biases[c],
                     [&](unsigned axis) { return axis == head.dominant ? head.bias[c] : evenBias; });
    }
    setAxisLanes(plan.widths[coarseClass], [&](unsigned axis) { return head.coarseWidth[axis]; });
    setAxisLanes(plan.biases[coarseClass], [](unsigned) { return evenBias; });
    unsigned widest = 0;
    for (const auto& widths : plan.widths) widest = std::max(widest, fieldBits(widths, 0));
    // With up to 7 bits before it.
    plan.isNarrow = widest <= 25 ? 1 : 0;
}

void setShear(const TileHeader& head, TilePlan& plan) {
    const auto minors = minorAxes(head.dominant);
    std::array<int, 3> slope{}, perColumn{}, perRow{};
    for (unsigned m = 0; m < 2; ++m) {
        slope[minors[m]] = 8 * head.shear[m];
        perColumn[minors[m]] = head.shearColumn[m];
        perRow[minors[m]] = head.shearRow[m];
    }
    setAxisLanes(plan.slope, [&](unsigned axis) { return slope[axis]; });
    setAxisLanes(plan.slopePerColumn, [&](unsigned axis) { return perColumn[axis]; });
    setAxisLanes(plan.slopePerRow, [&](unsigned axis) { return perRow[axis]; });
}

void setInsides(const uint8_t* record, const TileHeader& head, uint32_t first, TilePlan& plan) {
    for (unsigned drop = 0; drop < 4; ++drop)
        for (unsigned c = insideCentre; c <= insideDiagonal; ++c)
            plan.insideBits[drop][c - insideCentre] = static_cast<uint16_t>(fieldBits(plan.widths[c], drop));
    uint32_t at = first;
    for (unsigned j = 0, block = 0; j < head.blockRows(); ++j)
        for (unsigned i = 0; i < head.blockColumns(); ++i, ++block) {
            plan.drops[block] = record[tileHeaderBytes + block] & 3U;
            plan.inside[block] = at;
            const auto& bits = plan.insideBits[plan.drops[block]];
            const InsideCounts n = insideCounts(head.columnsOf(i), head.rowsOf(j));
            at += n.centres * bits[0] + n.crosses * bits[1] + n.diagonals * bits[2];
        }
}

}  // namespace

TilePlan tilePlan(const uint8_t* record, const TileHeader& head) {
    const TileParts parts = tileParts(head);
    TilePlan plan;
    setWidths(head, plan);
    setShear(head, plan);
    setInsides(record, head, parts.insides, plan);
    plan.bits = static_cast<uint32_t>(parts.bits);
    plan.coarse = parts.coarse;
    plan.edgeMids = parts.edgeMids;
    plan.edgeQuarters = parts.edgeQuarters;
    plan.edgeMidBits = static_cast<uint16_t>(fieldBits(plan.widths[edgeMid], 0));
    plan.edgeQuarterBits = static_cast<uint16_t>(fieldBits(plan.widths[edgeQuarter], 0));
    plan.coarseBits = static_cast<uint16_t>(fieldBits(plan.widths[coarseClass], 0));
    plan.columns = static_cast<uint8_t>(head.columns);
    plan.rows = static_cast<uint8_t>(head.rows);
    plan.curve = static_cast<uint8_t>(head.curve);
    plan.dominant = static_cast<uint8_t>(head.dominant);
    plan.isSheared = loadLe<uint32_t>(record + 36) != 0 ? 1 : 0;
    return plan;
}

}  // namespace filigree::grid
