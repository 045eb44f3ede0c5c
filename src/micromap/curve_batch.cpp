#include "filigree/micromap/curve_batch.h"

#include "filigree/micromap/curve.h"

#include <algorithm>
#include <array>
#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "micromap/curve_batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace filigree::micromap::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Spreads the low 16 bits of each lane to the even places.
template <class D, class V>
V spread(D d, V bits) {
    bits = hn::And(hn::Or(bits, hn::ShiftLeft<8>(bits)), hn::Set(d, 0x00ff00ff));
    bits = hn::And(hn::Or(bits, hn::ShiftLeft<4>(bits)), hn::Set(d, 0x0f0f0f0f));
    bits = hn::And(hn::Or(bits, hn::ShiftLeft<2>(bits)), hn::Set(d, 0x33333333));
    return hn::And(hn::Or(bits, hn::ShiftLeft<1>(bits)), hn::Set(d, 0x55555555));
}

template <class V>
V prefixParity(V bits) {
    bits = hn::Xor(bits, hn::ShiftRight<1>(bits));
    bits = hn::Xor(bits, hn::ShiftRight<2>(bits));
    bits = hn::Xor(bits, hn::ShiftRight<4>(bits));
    return hn::Xor(bits, hn::ShiftRight<8>(bits));
}

// One vector of points: to(iu, iv, iw, mask) takes their curve coordinates. The operations are those of the
// scalar function, one by one.
template <class DF, class To>
void convert(DF df, const float* u, const float* v, const uint32_t* levels, const To& to) {
    const hn::RebindToSigned<DF> di;
    const hn::RebindToUnsigned<DF> du;
    const auto one = hn::Set(di, 1);
    const auto n = hn::BitCast(di, hn::Shl(hn::Set(du, 1), hn::LoadU(du, levels)));
    const auto mask = hn::Sub(n, one);
    const auto side = hn::ConvertTo(df, n);
    const auto scaled = [&](const float* from) {
        const auto value = hn::LoadU(df, from);
        const auto above = hn::IfThenElseZero(hn::Gt(value, hn::Zero(df)), value);
        return hn::Mul(hn::Min(above, hn::Set(df, 1.0f)), side);
    };
    const auto scaledU = scaled(u);
    const auto scaledV = scaled(v);
    const auto floorU = hn::ConvertTo(di, scaledU);
    const auto floorV = hn::ConvertTo(di, scaledV);
    const auto fractions =
        hn::Add(hn::Sub(scaledU, hn::ConvertTo(df, floorU)), hn::Sub(scaledV, hn::ConvertTo(df, floorV)));
    const auto iv = hn::Min(floorV, mask);
    const auto uOnly = hn::Min(floorU, mask);
    const auto sum = hn::Add(uOnly, iv);
    const auto over = hn::Max(hn::Sub(sum, mask), hn::Zero(di));
    const auto iu = hn::Sub(uOnly, over);
    const auto flipped = hn::And(hn::RebindMask(di, hn::Ge(fractions, hn::Set(df, 1.0f))), hn::Lt(sum, mask));
    const auto iw = hn::Sub(hn::Not(hn::Add(iu, iv)), hn::IfThenElseZero(flipped, one));
    to(iu, iv, iw, mask);
}

// to(k, iu, iv, iw, mask) for each vector of points, the first of them k; the last one may reach up to 15
// points too far.
template <class To>
void convertAll(const float* u, const float* v, const uint32_t* levels, size_t count, const To& to) {
    const hn::CappedTag<float, 16> df;
    const size_t lanes = hn::Lanes(df);
    size_t k = 0;
    for (; k + lanes <= count; k += lanes) {
        convert(df, u + k, v + k, levels + k, [&](auto... at) { to(k, at...); });
    }
    if (k == count) return;
    std::array<float, 16> lastU{};
    std::array<float, 16> lastV{};
    std::array<uint32_t, 16> lastLevels{};
    std::copy(u + k, u + count, lastU.begin());
    std::copy(v + k, v + count, lastV.begin());
    std::copy(levels + k, levels + count, lastLevels.begin());
    convert(df, lastU.data(), lastV.data(), lastLevels.data(), [&](auto... at) { to(k, at...); });
}

// Stores the lanes of `values` that belong to points.
template <class V>
void store(V values, uint32_t* to, size_t k, size_t count) {
    const hn::RebindToUnsigned<hn::DFromV<V>> du;
    if (k + hn::Lanes(du) <= count) {
        hn::StoreU(hn::BitCast(du, values), du, to + k);
        return;
    }
    std::array<uint32_t, 16> last{};
    hn::StoreU(hn::BitCast(du, values), du, last.data());
    std::copy_n(last.begin(), count - k, to + k);
}

void indicesOf(const float* u, const float* v, const uint32_t* levels, uint32_t* indices, size_t count) {
    convertAll(u, v, levels, count, [&](size_t k, auto iu, auto iv, auto iw, auto mask) {
        const hn::DFromV<decltype(iu)> di;
        const auto low = hn::AndNot(hn::Xor(iu, iw), mask);
        const auto tie = hn::And(hn::Xor(iu, iv), low);
        const auto high = hn::Or(hn::And(hn::AndNot(low, mask), hn::Xor(prefixParity(tie), iu)), tie);
        store(hn::Or(spread(di, low), hn::ShiftLeft<1>(spread(di, high))), indices, k, count);
    });
}

void planesOfPoints(const float* u, const float* v, const uint32_t* levels, uint32_t* a, uint32_t* b,
                    size_t count) {
    convertAll(u, v, levels, count, [&](size_t k, auto iu, auto iv, auto iw, auto mask) {
        store(hn::And(hn::Xor(iu, iw), mask), a, k, count);
        store(hn::And(hn::Xor(iv, iw), mask), b, k, count);
    });
}

}  // namespace filigree::micromap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace filigree::micromap {

HWY_EXPORT(indicesOf);
HWY_EXPORT(planesOfPoints);

void barycentricsToIndex(std::span<const float> u, std::span<const float> v, std::span<const uint32_t> levels,
                         std::span<uint32_t> indices) {
    assert(v.size() == u.size() && levels.size() == u.size() && indices.size() == u.size());
    HWY_DYNAMIC_DISPATCH(indicesOf)(u.data(), v.data(), levels.data(), indices.data(), u.size());
}

void barycentricsToPlanes(std::span<const float> u, std::span<const float> v,
                          std::span<const uint32_t> levels, std::span<uint32_t> a, std::span<uint32_t> b) {
    assert(v.size() == u.size() && levels.size() == u.size() && a.size() == u.size() && b.size() == u.size());
    HWY_DYNAMIC_DISPATCH(planesOfPoints)(u.data(), v.data(), levels.data(), a.data(), b.data(), u.size());
}

}  // namespace filigree::micromap
#endif
