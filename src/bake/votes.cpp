#include "bake/votes.h"

#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bake/votes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace filigree::bake::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

size_t countOpaqueSimd(const Votes& votes, const float* offsetX, const float* offsetY, size_t count) {
    const hn::CappedTag<float, 16> df;
    const hn::RebindToSigned<decltype(df)> di;
    const auto width = static_cast<int32_t>(votes.image->width);
    const auto* texels = reinterpret_cast<const int32_t*>(votes.image->texels.data());
    const auto x = hn::Set(df, votes.x);
    const auto y = hn::Set(df, votes.y);
    const auto sign = hn::Set(df, votes.sign);
    const auto column = hn::Set(di, static_cast<int32_t>(votes.column));
    const auto row = hn::Set(di, static_cast<int32_t>(votes.row));
    const auto low16 = hn::Set(di, 0xffff);
    size_t opaque = 0;
    for (size_t k = 0; k < count; k += hn::Lanes(df)) {
        // No fused operations here: the result must not depend on the target.
        const auto sx = hn::Add(x, hn::Mul(sign, hn::LoadU(df, offsetX + k)));
        const auto sy = hn::Add(y, hn::Mul(sign, hn::LoadU(df, offsetY + k)));
        const auto floorX = hn::Floor(sx);
        const auto floorY = hn::Floor(sy);
        const auto fx = hn::Sub(sx, floorX);
        const auto fy = hn::Sub(sy, floorY);
        const auto cellX = hn::Add(column, hn::ConvertTo(di, floorX));
        const auto cellY = hn::Add(row, hn::ConvertTo(di, floorY));
        // One 32-bit load holds a texel and its right neighbour.
        const auto at = hn::ShiftLeft<1>(hn::Add(hn::Mul(cellY, hn::Set(di, width)), cellX));
        const auto low = hn::GatherOffset(di, texels, at);
        const auto high = hn::GatherOffset(di, texels, hn::Add(at, hn::Set(di, 2 * width)));
        const auto left = [&](auto pair) { return hn::ConvertTo(df, hn::And(pair, low16)); };
        const auto right = [&](auto pair) {
            return hn::ConvertTo(df, hn::And(hn::ShiftRight<16>(pair), low16));
        };
        const auto lowAlpha = hn::Add(left(low), hn::Mul(hn::Sub(right(low), left(low)), fx));
        const auto highAlpha = hn::Add(left(high), hn::Mul(hn::Sub(right(high), left(high)), fx));
        const auto alpha = hn::Add(lowAlpha, hn::Mul(hn::Sub(highAlpha, lowAlpha), fy));
        opaque += hn::CountTrue(df, hn::Ge(alpha, hn::Set(df, votes.threshold)));
    }
    return opaque;
}

}  // namespace filigree::bake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace filigree::bake {

HWY_EXPORT(countOpaqueSimd);

size_t countOpaque(const Votes& votes, std::span<const float> offsetX, std::span<const float> offsetY) {
    assert(offsetX.size() % 16 == 0 && offsetY.size() == offsetX.size());
    return HWY_DYNAMIC_DISPATCH(countOpaqueSimd)(votes, offsetX.data(), offsetY.data(), offsetX.size());
}

}  // namespace filigree::bake
#endif
