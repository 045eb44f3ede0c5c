#include "filigree/image/alpha_sides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace filigree::image {
namespace {

// A block of unwrapped cells, both ends included.
struct Block {
    int64_t x0 = 0;
    int64_t x1 = 0;
    int64_t y0 = 0;
    int64_t y1 = 0;
    [[nodiscard]] bool isCell() const { return x0 == x1 && y0 == y1; }
    [[nodiscard]] std::array<Block, 2> halves() const {
        if (x1 - x0 >= y1 - y0) {
            const int64_t middle = x0 + (x1 - x0) / 2;
            return {Block{x0, middle, y0, y1}, Block{middle + 1, x1, y0, y1}};
        }
        const int64_t middle = y0 + (y1 - y0) / 2;
        return {Block{x0, x1, y0, middle}, Block{x0, x1, middle + 1, y1}};
    }
};

// One question: walks the cells that the polygon may touch, in halves, until both sides have been seen.
class Walk {
  public:
    Walk(const AlphaSides& sides, const PatchPolygon<Bounded>& polygon, Filter filter,
         const Threshold& threshold)
        : sides_(sides), polygon_(polygon), filter_(filter), threshold_(threshold) {
        double reach = 1;
        double error = 0;
        for (size_t k = 0; k < polygon.size(); ++k) {
            const PatchPoint<Bounded>& p = polygon[k];
            rounded_.push({p.x.value(), p.y.value()});
            reach = std::max({reach, std::fabs(p.x.value()), std::fabs(p.y.value())});
            error = std::max({error, p.x.error(), p.y.error()});
        }
        slack_ = error + 4e-15 * reach;
    }

    Side run() {
        visit(around());
        return mixed() || !seen_ ? Side::mixed : *seen_;
    }

  private:
    [[nodiscard]] Block around() const {
        const double margin = slack_;
        PatchRange x;
        PatchRange y;
        for (size_t k = 0; k < rounded_.size(); ++k) {
            x.add(rounded_[k].x);
            y.add(rounded_[k].y);
        }
        const auto whole = [](double v) { return static_cast<int64_t>(std::floor(v)); };
        return {whole(x.lower - margin), whole(x.upper + margin), whole(y.lower - margin),
                whole(y.upper + margin)};
    }

    [[nodiscard]] bool mixed() const { return mixed_; }

    void add(Side side) {
        if (side == Side::mixed || (seen_ && *seen_ != side)) mixed_ = true;
        seen_ = side;
    }

    void visit(const Block& block) {
        if (mixed()) return;
        const Side rough = sides_.roughly(block.x0, block.x1, block.y0, block.y1, threshold_);
        if (seen_ && rough == *seen_) return;
        if (++visits_ > mostVisits) return add(Side::mixed);
        if (!mayTouch(block)) return;
        if (rough != Side::mixed) return add(rough);
        if (block.isCell()) return addCell(block.x0, block.y0);
        for (const Block& half : block.halves()) visit(half);
    }

    [[nodiscard]] bool mayTouch(const Block& b) const {
        return clipped(rounded_, static_cast<double>(b.x0), static_cast<double>(b.x1 + 1),
                       static_cast<double>(b.y0), static_cast<double>(b.y1 + 1), slack_)
                   .size() > 0;
    }

    [[nodiscard]] uint16_t texel(int64_t x, int64_t y) const {
        const AlphaTexture& texture = sides_.texture();
        return texture.image.at(wrapTexel(x, texture.image.width, texture.wrapU),
                                wrapTexel(y, texture.image.height, texture.wrapV));
    }

    // The polygon relative to a cell.
    template <class Real>
    static PatchPolygon<Real> relative(const PatchPolygon<Real>& polygon, int64_t x, int64_t y) {
        PatchPolygon<Real> moved;
        for (size_t k = 0; k < polygon.size(); ++k) {
            moved.push(
                {polygon[k].x - Real(static_cast<double>(x)), polygon[k].y - Real(static_cast<double>(y))});
        }
        return moved;
    }

    void addCell(int64_t x, int64_t y) {
        if (filter_ == Filter::nearest) {
            addTexels(x, y);
        } else {
            addPatch(x, y);
        }
    }

    // A quarter of the cell belongs to each texel's square.
    void addTexels(int64_t x, int64_t y) {
        const auto exact = relative(polygon_, x, y);
        for (const int64_t dx : {0, 1}) {
            for (const int64_t dy : {0, 1}) {
                const double left = 0.5 * static_cast<double>(dx);
                const double low = 0.5 * static_cast<double>(dy);
                if (clipped(exact, left, left + 0.5, low, low + 0.5).size() == 0) continue;
                add(texel(x + dx, y + dy) >= threshold_.lowestOpaque ? Side::opaque : Side::transparent);
            }
        }
    }

    void addPatch(int64_t x, int64_t y) {
        const Patch patch =
            Patch::of(texel(x, y), texel(x + 1, y), texel(x, y + 1), texel(x + 1, y + 1), threshold_.value);
        const double tolerance = patchTolerance(patch, slack_);
        const PatchRange rough = rangeOver(patch, relative(rounded_, x, y), slack_);
        if (rough.empty()) return;
        if (rough.isOpaque(tolerance)) return add(Side::opaque);
        if (rough.isTransparent(tolerance)) return add(Side::transparent);
        if (rough.lower < -tolerance && rough.upper > tolerance) return add(Side::mixed);
        // Too close to call in double.
        const PatchRange range = rangeOver(patch, relative(polygon_, x, y));
        if (range.empty()) return;
        add(range.isOpaque() ? Side::opaque : range.isTransparent() ? Side::transparent : Side::mixed);
    }

    // A polygon that keeps us longer is too large to look at.
    static constexpr size_t mostVisits = size_t{1} << 22;

    const AlphaSides& sides_;
    const PatchPolygon<Bounded>& polygon_;
    Filter filter_;
    Threshold threshold_;
    PatchPolygon<double> rounded_;  // off by at most slack_, in texels, also when moved to a cell
    double slack_ = 0;
    std::optional<Side> seen_;
    bool mixed_ = false;
    size_t visits_ = 0;
};

}  // namespace

Side AlphaSides::over(const PatchPolygon<Bounded>& polygon, Filter filter, const Threshold& threshold) const {
    return Walk(*this, polygon, filter, threshold).run();
}

Side AlphaSides::roughly(int64_t x0, int64_t x1, int64_t y0, int64_t y1, const Threshold& threshold) const {
    const TexelRange texels = extremes_.over(x0, x1 + 1, y0, y1 + 1);
    if (texels.least >= threshold.lowestOpaque) return Side::opaque;
    return texels.most < threshold.lowestOpaque ? Side::transparent : Side::mixed;
}

}  // namespace filigree::image
