#include "grid/tile_plan.h"

namespace filigree::grid {
namespace {

TileFrame tileFrameOf(const Tile& tile, const TileHeader& head) {
    TileFrame frame;
    for (unsigned row = 0; row <= head.rows; ++row)
        for (unsigned column = 0; column <= head.columns; ++column)
            frame.fineAt(framePlace(head.columns, column), framePlace(head.rows, row)) = tile.at(column, row);
    for (unsigned j = 0; j <= head.blockRows(); ++j)
        for (unsigned i = 0; i <= head.blockColumns(); ++i)
            frame.coarseAt(placesOfSteps[head.blockColumns()][i], placesOfSteps[head.blockRows()][j]) =
                frame.fineAt(4 * i, 4 * j);
    return frame;
}

LatticePoint residualFrom(const LatticePoint& point, const LatticePoint& prediction) {
    LatticePoint residual{};
    for (unsigned k = 0; k < 3; ++k) residual[k] = wrappedResidual(point[k] - prediction[k]);
    return residual;
}

}  // namespace

TileResiduals residualsOf(const Tile& tile, const TileHeader& head) {
    TileFrame frame = tileFrameOf(tile, head), less, bends;
    TileHeader straight = head;
    straight.curve = 0;
    Patch coarse = frame.coarsePatch(head);
    coarse.walk([&](unsigned px, unsigned py, ResidualClass, const LatticePoint& prediction) {
        less.coarseAt(px, py) = residualFrom(coarse.at(px, py), prediction);
    });
    for (unsigned j = 0; j < head.blockRows(); ++j)
        for (unsigned i = 0; i < head.blockColumns(); ++i) {
            Patch patch = frame.blockPatch(straight, i, j);
            patch.walk([&](unsigned px, unsigned py, ResidualClass c, const LatticePoint& prediction) {
                less.fineAt(4 * i + px, 4 * j + py) = residualFrom(patch.at(px, py), prediction);
                if (c == edgeQuarter || c == insideCross)
                    bends.fineAt(4 * i + px, 4 * j + py) = patch.bendAt(px, py);
            });
        }

    TileResiduals residuals;
    const auto narrow = [](unsigned value) { return static_cast<uint8_t>(value); };
    walkCoarse(head, [&](unsigned px, unsigned py) {
        residuals.add({less.coarseAt(px, py), {}, narrow(4 * px), narrow(4 * py), coarseGroup, noBlock});
    });
    walkFine(head, [&](ResidualClass c, unsigned x, unsigned y, unsigned block) {
        residuals.add(
            {less.fineAt(x, y), bends.fineAt(x, y), narrow(x), narrow(y), narrow(c), narrow(block)});
    });
    return residuals;
}

LatticePoint fieldValue(const TileHeader& head, const TileResidual& residual) {
    LatticePoint value{};
    for (unsigned k = 0; k < 3; ++k) value[k] = straightened(residual, k, head.curve);
    const int32_t main = value[head.dominant];
    const auto minors = minorAxes(head.dominant);
    for (unsigned m = 0; m < 2; ++m)
        value[minors[m]] = wrappedResidual(
            wrappedDifference(value[minors[m]], shearOf(head, m, residual.x, residual.y, main)));
    return value;
}

}  // namespace filigree::grid
