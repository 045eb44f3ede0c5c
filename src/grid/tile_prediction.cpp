#include "grid/tile_shear.h"

#include <algorithm>
#include <limits>

namespace filigree::grid {
namespace {

struct Prediction {
    unsigned dominant = 0;
    unsigned curve = 0;
    std::array<Shear, 2> shear;
    double cost = std::numeric_limits<double>::max();
};

// Tries curves, axes and shears of one tile.
class PredictionSearch {
  public:
    explicit PredictionSearch(std::span<const TileResidual> residuals) : residuals_(residuals) {
        for (const TileResidual& residual : residuals)
            for (unsigned k = 0; k < 3; ++k) {
                energy_[k] += double(residual.value[k]) * residual.value[k];
                if (residual.value[k] != 0 || residual.bend[k] != 0) isFlat_[k] = false;
            }
    }

    Prediction find() {
        const double most = *std::max_element(energy_.begin(), energy_.end());
        for (unsigned k = 0; k < 3; ++k)
            if (energy_[k] >= most / 2 && !isFlat_[k]) tryDominant(k);
        for (unsigned m = 0; m < 2; ++m)
            if (const unsigned minor = minorAxes(best_.dominant)[m]; !isFlat_[minor])
                best_.shear[m] =
                    refineShear({residuals_, best_.dominant, minor, best_.curve}, best_.shear[m]).shear;
        return best_;
    }

  private:
    // The shear hardly depends on the curve.
    void tryDominant(unsigned dominant) {
        constexpr unsigned middleCurve = 2;
        Prediction of{dominant, middleCurve, {}, 0};
        for (unsigned m = 0; m < 2; ++m)
            if (const unsigned minor = minorAxes(dominant)[m]; !isFlat_[minor])
                of.shear[m] = estimateShear({residuals_, dominant, minor, middleCurve}).shear;
        for (const unsigned curve : {0U, 2U, 4U, 6U}) tryCurve(of, curve);
        const unsigned coarse = best_.curve;
        if (best_.dominant != dominant) return;
        if (coarse > 0) tryCurve(of, coarse - 1);
        tryCurve(of, coarse + 1);
    }
    void tryCurve(Prediction of, unsigned curve) {
        of.curve = curve;
        const auto minors = minorAxes(of.dominant);
        for (unsigned m = 0; m < 2; ++m) {
            if (m == 1 && isFlat_[minors[1]]) break;
            const ShearedAxes axes(residuals_, of.dominant, minors[m], curve);
            if (m == 0) of.cost += costOfMain(axes);
            if (!isFlat_[minors[m]]) of.cost += costOfShear(axes, of.shear[m]);
        }
        if (of.cost < best_.cost) best_ = of;
    }

    GroupedResiduals residuals_;
    std::array<double, 3> energy_{};
    std::array<bool, 3> isFlat_{true, true, true};
    Prediction best_;
};

}  // namespace

void choosePrediction(std::span<const TileResidual> residuals, TileHeader& head) {
    const Prediction best = PredictionSearch(residuals).find();
    head.dominant = best.dominant;
    head.curve = best.curve;
    for (unsigned m = 0; m < 2; ++m) {
        head.shear[m] = best.shear[m].even;
        head.shearColumn[m] = best.shear[m].column;
        head.shearRow[m] = best.shear[m].row;
    }
}

}  // namespace filigree::grid
