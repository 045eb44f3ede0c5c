#include "grid/tile_plan.h"

#include <algorithm>
#include <cmath>

namespace filigree::grid {
namespace {

// Sums for least squares of minor = dominant * (a + s x + t y) / 256 over the residuals, those of each group
// scaled by its own size, as each group has its own width.
struct ShearSums {
    std::array<std::array<double, 3>, 3> square{};
    std::array<std::array<double, 3>, 2> right{};  // [minor]
};

ShearSums shearSums(std::span<const TileResidual> residuals, unsigned dominant) {
    std::array<double, residualClasses + 1> weight{};
    for (const TileResidual& residual : residuals)
        weight[residual.group] = std::max(weight[residual.group], std::abs(double(residual.value[dominant])));
    for (double& most : weight) most = most > 0 ? 1 / (most * most) : 0;
    ShearSums sums;
    const auto minors = minorAxes(dominant);
    for (const TileResidual& residual : residuals) {
        const double main = residual.value[dominant] / 256.0;
        const std::array<double, 3> terms{main, main * (residual.x - 8), main * (residual.y - 8)};
        for (unsigned p = 0; p < 3; ++p) {
            const double weighted = weight[residual.group] * terms[p];
            for (unsigned q = 0; q < 3; ++q) sums.square[p][q] += weighted * terms[q];
            for (unsigned m = 0; m < 2; ++m) sums.right[m][p] += weighted * residual.value[minors[m]];
        }
    }
    return sums;
}

// Solves the first `count` equations by elimination; unknowns that nothing fixes are 0.
std::array<double, 3> solveShear(ShearSums sums, unsigned minor, unsigned count) {
    auto& a = sums.square;
    auto& b = sums.right[minor];
    for (unsigned p = 0; p < count; ++p) {
        if (!(a[p][p] > 1e-9 * sums.square[0][0])) {
            for (unsigned q = 0; q < count; ++q) a[q][p] = a[p][q] = 0;
            b[p] = 0;
            a[p][p] = 1;
        }
        for (unsigned row = 0; row < count; ++row) {
            if (row == p) continue;
            const double factor = a[row][p] / a[p][p];
            for (unsigned q = 0; q < count; ++q) a[row][q] -= factor * a[p][q];
            b[row] -= factor * b[p];
        }
    }
    std::array<double, 3> solution{};
    for (unsigned p = 0; p < count; ++p) solution[p] = b[p] / a[p][p];
    return solution;
}

int rounded(double value, int low, int high) {
    return static_cast<int>(std::clamp(std::round(value), double(low), double(high)));
}

void setShear(TileHeader& head, const ShearSums& sums, unsigned unknowns) {
    for (unsigned m = 0; m < 2; ++m) {
        const auto solution = solveShear(sums, m, unknowns);
        head.shear[m] = rounded(solution[0] / 8, -32, 31);
        head.shearColumn[m] = rounded(solution[1], -16, 15);
        head.shearRow[m] = rounded(solution[2], -16, 15);
    }
}

struct Best {
    TileHeader head;
    uint32_t bits;
};

void tryShear(std::span<const TileResidual> residuals, const TileHeader& head, Best& best) {
    std::array<uint8_t, tileBlocks * tileBlocks> drops{};
    TileHeader widths = head;
    const uint32_t bits = chooseWidths(residuals, widths, drops);
    if (bits < best.bits) best = {head, bits};
}

unsigned dominantAxis(std::span<const TileResidual> residuals) {
    std::array<double, 3> energy{};
    for (const TileResidual& residual : residuals)
        for (unsigned k = 0; k < 3; ++k) energy[k] += double(residual.value[k]) * residual.value[k];
    // Most often all of them lie on one axis.
    return static_cast<unsigned>(std::max_element(energy.begin(), energy.end()) - energy.begin());
}

}  // namespace

void chooseShear(std::span<const TileResidual> residuals, TileHeader& head) {
    head.dominant = dominantAxis(residuals);
    Best best{head, 0};
    std::array<uint8_t, tileBlocks * tileBlocks> drops{};
    best.bits = chooseWidths(residuals, best.head, drops);
    const ShearSums sums = shearSums(residuals, head.dominant);
    if (sums.right == ShearSums().right) return;
    for (const unsigned unknowns : {1U, 3U}) {
        TileHeader tried = head;
        setShear(tried, sums, unknowns);
        tryShear(residuals, tried, best);
    }
    head = best.head;
}

}  // namespace filigree::grid
