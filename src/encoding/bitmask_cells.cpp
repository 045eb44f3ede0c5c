#include "encoding/bitmask_cells.h"

#include "filigree/core/bounded.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace filigree::encoding::bitmask {

using image::AlphaTexture;
using image::Filter;
using micromap::State;

namespace {

uint16_t texelAt(const AlphaTexture& texture, int64_t x, int64_t y) {
    return texture.image.at(image::wrapTexel(x, texture.image.width, texture.wrapU),
                            image::wrapTexel(y, texture.image.height, texture.wrapV));
}

// Bilinear alpha minus a threshold at a point of sample space, in texel values.
Bounded alphaAt(const AlphaTexture& texture, double threshold, double x, double y) {
    const double cellX = std::floor(x);
    const double cellY = std::floor(y);
    const auto texel = [&](int64_t dx, int64_t dy) -> double {
        return texelAt(texture, static_cast<int64_t>(cellX) + dx, static_cast<int64_t>(cellY) + dy);
    };
    const auto patch = image::Patch::of(texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1), threshold);
    return patch.at(image::PatchPoint<Bounded>{Bounded(x) - Bounded(cellX), Bounded(y) - Bounded(cellY)});
}

// The next point on an axis where the patch or the extent ends.
double nextStop(double at, double high) {
    return std::min(std::floor(at) + 1, high);
}

int64_t floorDivide(int64_t a, int64_t b) {
    return a >= 0 ? a / b : -((-a + b - 1) / b);
}

}  // namespace

Cells::Cells(const BitmaskSource& source)
    : filter_(source.texture->filter),
      sideThreshold_(image::sideThreshold(source.test, 1, source.texture->image.steps)) {
    const AlphaTexture& finest = *source.texture;
    const bool betweenTexels = filter_ != Filter::nearest;
    columns_ = {finest.image.width, finest.wrapU, betweenTexels};
    rows_ = {finest.image.height, finest.wrapV, betweenTexels};
    addLevel(finest, source.test);
    const unsigned mips = std::min(source.test.mips, image::coarserLevels(finest.image));
    for (unsigned mip = 0; mip < mips; ++mip) {
        const AlphaTexture& finer = *levels_.back().texture;
        coarser_.push_back({image::halve(finer.image), finer.wrapU, finer.wrapV, finer.filter});
        addLevel(coarser_.back(), source.test);
    }
}

void Cells::addLevel(const AlphaTexture& texture, const image::AlphaTest& test) {
    Level level{&texture, image::thresholdsOf(test, 1, texture.image.steps), {}, {}};
    const auto addExtents = [&](const BitmaskAxis& axis, uint32_t size, std::vector<Extent>& to) {
        for (uint32_t k = 0; k < axis.cells(); ++k) {
            to.push_back(extentOf(axis, axis.firstCell() + k, size, test.guard));
        }
    };
    addExtents(columns_, texture.image.width, level.columns);
    addExtents(rows_, texture.image.height, level.rows);
    levels_.push_back(std::move(level));
}

// `size`: texels of the axis at that mip level.
Cells::Extent Cells::extentOf(const BitmaskAxis& axis, int64_t cell, uint32_t size, double guard) const {
    // In half texels of level 0: cells begin at texel borders or at centres.
    const int64_t begin = 2 * cell + (axis.betweenTexels ? 1 : 0);
    const auto scaled = [&](int64_t halves) {
        return Bounded(static_cast<double>(halves)) * Bounded(size) / Bounded(2.0 * axis.size);
    };
    const Bounded low = scaled(begin) - Bounded(guard);
    const Bounded high = scaled(begin + 2) + Bounded(guard);
    const Bounded half(0.5);
    Extent extent;
    extent.low = (low - half).value() - (low - half).error();
    extent.high = (high - half).value() + (high - half).error();
    if (guard == 0 && filter_ == Filter::nearest) {
        // Half open: a border belongs to the texel after it.
        extent.firstTexel = floorDivide(begin * size, 2 * int64_t{axis.size});
        extent.lastTexel = -floorDivide(-(begin + 2) * size, 2 * int64_t{axis.size}) - 1;
    } else {
        extent.firstTexel = static_cast<int64_t>(std::ceil(low.value() - low.error())) - 1;
        extent.lastTexel = static_cast<int64_t>(std::floor(high.value() + high.error()));
    }
    return extent;
}

Cells::Side Cells::sideOfTexels(const AlphaTexture& texture, uint32_t lowestOpaque, int64_t x0, int64_t x1,
                                int64_t y0, int64_t y1) {
    bool anyOpaque = false;
    bool anyTransparent = false;
    for (int64_t y = y0; y <= y1; ++y) {
        for (int64_t x = x0; x <= x1; ++x) {
            (texelAt(texture, x, y) >= lowestOpaque ? anyOpaque : anyTransparent) = true;
        }
    }
    if (anyOpaque && anyTransparent) return Side::mixed;
    return anyOpaque ? Side::opaque : Side::transparent;
}

Cells::Side Cells::nearestSide(const AlphaTexture& texture, const image::Threshold& threshold,
                               const Extent& x, const Extent& y) {
    return sideOfTexels(texture, threshold.lowestOpaque, x.firstTexel, x.lastTexel, y.firstTexel,
                        y.lastTexel);
}

Cells::Side Cells::linearSide(const AlphaTexture& texture, const image::Threshold& threshold, const Extent& x,
                              const Extent& y) {
    const auto floor = [](double at) { return static_cast<int64_t>(std::floor(at)); };
    const auto ceil = [](double at) { return static_cast<int64_t>(std::ceil(at)); };
    // Texels of one side leave nothing of the other between them.
    const Side side =
        sideOfTexels(texture, threshold.lowestOpaque, floor(x.low), ceil(x.high), floor(y.low), ceil(y.high));
    return side == Side::mixed ? exactSide(texture, threshold, x, y) : side;
}

// A bilinear patch is linear along either axis, so it has its extremes over a rectangle at the corners.
Cells::Side Cells::exactSide(const AlphaTexture& texture, const image::Threshold& threshold, const Extent& x,
                             const Extent& y) {
    image::PatchRange range;
    for (double py = y.low;; py = nextStop(py, y.high)) {
        for (double px = x.low;; px = nextStop(px, x.high)) {
            range.add(alphaAt(texture, threshold.value, px, py));
            if (px >= x.high) break;
        }
        if (py >= y.high) break;
    }
    if (range.isOpaque()) return Side::opaque;
    return range.isTransparent() ? Side::transparent : Side::mixed;
}

State Cells::stateOf(uint32_t column, uint32_t row) const {
    std::optional<Side> common;
    // False once two sides differ.
    const auto agrees = [&](Side side) {
        if (!common) common = side;
        return side != Side::mixed && side == *common;
    };
    for (const Level& level : levels_) {
        for (const image::Threshold& threshold : level.thresholds) {
            const Extent& x = level.columns[column];
            const Extent& y = level.rows[row];
            const bool linear =
                filter_ == Filter::nearest || agrees(linearSide(*level.texture, threshold, x, y));
            const bool nearest =
                filter_ == Filter::linear || agrees(nearestSide(*level.texture, threshold, x, y));
            if (!linear || !nearest) return micromap::unknownOf(sideOf(column, row));
        }
    }
    return micromap::knownOf(*common == Side::opaque);
}

bool Cells::sideOf(uint32_t column, uint32_t row) const {
    const AlphaTexture& texture = *levels_.front().texture;
    const int64_t x = columns_.firstCell() + column;
    const int64_t y = rows_.firstCell() + row;
    if (filter_ == Filter::nearest) return texelAt(texture, x, y) >= sideThreshold_.lowestOpaque;
    const double sum = texelAt(texture, x, y) + texelAt(texture, x + 1, y) + texelAt(texture, x, y + 1) +
                       texelAt(texture, x + 1, y + 1);
    return sum / 4 >= sideThreshold_.value;
}

}  // namespace filigree::encoding::bitmask
