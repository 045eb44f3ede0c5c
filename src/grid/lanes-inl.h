// Sixteen lanes on any instruction set: included once for each SIMD target.
#if defined(FILIGREE_GRID_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FILIGREE_GRID_LANES_INL_H_
#undef FILIGREE_GRID_LANES_INL_H_
#else
#define FILIGREE_GRID_LANES_INL_H_
#endif

#include "filigree/core/bytes.h"

#include <array>
#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace filigree::grid::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// As many vectors as hold sixteen lanes. They fall into four blocks of four lanes.
template <class T>
struct Lanes16 {
    using Tag = hn::CappedTag<T, 16>;
    using Vector = hn::VFromD<Tag>;
    static constexpr size_t partLanes = hn::MaxLanes(Tag());
    static constexpr size_t partCount = 16 / partLanes;

    Vector parts[partCount];
};
using F16 = Lanes16<float>;
using I16 = Lanes16<int32_t>;

template <class R, class Op, class... V>
HWY_INLINE R perPart(const Op& op, const V&... values) {
    R result;
    for (size_t k = 0; k < R::partCount; ++k) result.parts[k] = op(values.parts[k]...);
    return result;
}

template <class T>
HWY_INLINE Lanes16<T> all(T value) {
    Lanes16<T> result;
    for (auto& part : result.parts) part = hn::Set(typename Lanes16<T>::Tag(), value);
    return result;
}
template <class T>
HWY_INLINE Lanes16<T> load(const T* from) {
    Lanes16<T> result;
    for (size_t k = 0; k < Lanes16<T>::partCount; ++k)
        result.parts[k] = hn::LoadU(typename Lanes16<T>::Tag(), from + k * Lanes16<T>::partLanes);
    return result;
}
// The four values in every block.
template <class T>
HWY_INLINE Lanes16<T> loadBlocks(const T* from) {
    Lanes16<T> result;
    for (size_t k = 0; k < Lanes16<T>::partCount; ++k) {
        const typename Lanes16<T>::Tag d;
        if constexpr (Lanes16<T>::partLanes == 1)
            result.parts[k] = hn::LoadU(d, from + k % 4);
        else
            result.parts[k] = hn::LoadDup128(d, from);
    }
    return result;
}
template <class T>
HWY_INLINE void store(const Lanes16<T>& values, T* to) {
    for (size_t k = 0; k < Lanes16<T>::partCount; ++k)
        hn::StoreU(values.parts[k], typename Lanes16<T>::Tag(), to + k * Lanes16<T>::partLanes);
}

template <class T>
HWY_INLINE Lanes16<T> operator+(const Lanes16<T>& a, const Lanes16<T>& b) {
    return perPart<Lanes16<T>>([](auto x, auto y) { return hn::Add(x, y); }, a, b);
}
template <class T>
HWY_INLINE Lanes16<T> operator-(const Lanes16<T>& a, const Lanes16<T>& b) {
    return perPart<Lanes16<T>>([](auto x, auto y) { return hn::Sub(x, y); }, a, b);
}
template <class T>
HWY_INLINE Lanes16<T> operator*(const Lanes16<T>& a, const Lanes16<T>& b) {
    return perPart<Lanes16<T>>([](auto x, auto y) { return hn::Mul(x, y); }, a, b);
}
HWY_INLINE I16 operator&(const I16& a, const I16& b) {
    return perPart<I16>([](auto x, auto y) { return hn::And(x, y); }, a, b);
}
HWY_INLINE I16 operator|(const I16& a, const I16& b) {
    return perPart<I16>([](auto x, auto y) { return hn::Or(x, y); }, a, b);
}
template <class T>
HWY_INLINE Lanes16<T> least(const Lanes16<T>& a, const Lanes16<T>& b) {
    return perPart<Lanes16<T>>([](auto x, auto y) { return hn::Min(x, y); }, a, b);
}
template <class T>
HWY_INLINE Lanes16<T> greatest(const Lanes16<T>& a, const Lanes16<T>& b) {
    return perPart<Lanes16<T>>([](auto x, auto y) { return hn::Max(x, y); }, a, b);
}
template <int bits>
HWY_INLINE I16 shiftRight(const I16& a) {
    return perPart<I16>([](auto x) { return hn::ShiftRight<bits>(x); }, a);
}
template <int bits>
HWY_INLINE I16 shiftLeft(const I16& a) {
    return perPart<I16>([](auto x) { return hn::ShiftLeft<bits>(x); }, a);
}
// Of non-negative bits by 0 to 31, no sign coming in.
HWY_INLINE I16 shiftRightBy(const I16& a, const I16& bits) {
    const hn::RebindToUnsigned<I16::Tag> du;
    const I16::Tag di;
    return perPart<I16>(
        [&](auto x, auto y) { return hn::BitCast(di, hn::Shr(hn::BitCast(du, x), hn::BitCast(du, y))); }, a,
        bits);
}
HWY_INLINE I16 shiftLeftBy(const I16& a, const I16& bits) {
    return perPart<I16>([](auto x, auto y) { return hn::Shl(x, y); }, a, bits);
}
HWY_INLINE F16 toFloat(const I16& a) {
    return perPart<F16>([](auto x) { return hn::ConvertTo(F16::Tag(), x); }, a);
}
// Bit k: lane k.
template <class Test>
HWY_INLINE uint32_t bitsWhere(const F16& a, const F16& b, const Test& test) {
    uint32_t bits = 0;
    for (size_t k = 0; k < F16::partCount; ++k) {
        std::array<uint8_t, 8> bytes{};
        hn::StoreMaskBits(F16::Tag(), test(a.parts[k], b.parts[k]), bytes.data());
        uint32_t part = bytes[0];
        if constexpr (F16::partLanes > 8) part |= uint32_t{bytes[1]} << 8;
        bits |= part << (k * F16::partLanes);
    }
    return bits;
}
HWY_INLINE uint32_t bitsNotAbove(const F16& a, const F16& b) {
    return bitsWhere(a, b, [](auto x, auto y) { return hn::Le(x, y); });
}

// In each block, lanes a, b, c, d of that block.
template <int a, int b, int c, int d>
HWY_INLINE I16 turned(const I16& values) {
#if HWY_TARGET == HWY_SCALAR
    constexpr std::array<size_t, 4> from{a, b, c, d};
    I16 result;
    for (size_t k = 0; k < 16; ++k) result.parts[k] = values.parts[k / 4 * 4 + from[k % 4]];
    return result;
#else
    alignas(16) static constexpr std::array<uint8_t, 16> bytes{
        4 * a, 4 * a + 1, 4 * a + 2, 4 * a + 3, 4 * b, 4 * b + 1, 4 * b + 2, 4 * b + 3,
        4 * c, 4 * c + 1, 4 * c + 2, 4 * c + 3, 4 * d, 4 * d + 1, 4 * d + 2, 4 * d + 3};
    const auto table = hn::LoadDup128(hn::Repartition<uint8_t, I16::Tag>(), bytes.data());
    return perPart<I16>([&](auto x) { return hn::TableLookupBytes(x, hn::BitCast(I16::Tag(), table)); },
                        values);
#endif
}

// The 4 bytes at base + offsets[lane], at any address.
HWY_INLINE I16 gather(const uint8_t* base, const I16& offsets) {
    return perPart<I16>(
        [&](auto x) { return hn::GatherOffset(I16::Tag(), reinterpret_cast<const int32_t*>(base), x); },
        offsets);
}

// Lanes of 0 to 31: a table of two vectors.
template <class T>
HWY_INLINE Lanes16<T> pick(const Lanes16<T>& low, const Lanes16<T>& high, const int32_t* lanes) {
    Lanes16<T> result;
#if HWY_TARGET <= HWY_AVX3
    // Highway 1.0 has no name for this instruction.
    const auto at = hn::LoadU(I16::Tag(), lanes);
    const auto bits = _mm512_permutex2var_epi32(hn::BitCast(I16::Tag(), low.parts[0]).raw, at.raw,
                                                hn::BitCast(I16::Tag(), high.parts[0]).raw);
    result.parts[0] = hn::BitCast(typename Lanes16<T>::Tag(), hn::VFromD<I16::Tag>{bits});
#else
    alignas(64) std::array<T, 32> table;
    store(low, table.data());
    store(high, table.data() + 16);
    alignas(64) std::array<T, 16> picked;
    for (size_t k = 0; k < 16; ++k) picked[k] = table[static_cast<size_t>(lanes[k])];
    result = load(picked.data());
#endif
    return result;
}

// Sixteen bytes as numbers.
HWY_INLINE I16 loadBytes(const uint8_t* from) {
    I16 result;
    const hn::Rebind<uint8_t, I16::Tag> bytes;
    for (size_t k = 0; k < I16::partCount; ++k)
        result.parts[k] = hn::PromoteTo(I16::Tag(), hn::LoadU(bytes, from + k * I16::partLanes));
    return result;
}

// The 4 bytes at four places of `base`, of vectors that are the same in every block.
HWY_INLINE I16 gatherFour(const uint8_t* base, const I16& places) {
#if HWY_TARGET <= HWY_AVX3
    const auto words = _mm_i32gather_epi32(reinterpret_cast<const int*>(base),
                                           _mm512_castsi512_si128(places.parts[0].raw), 1);
    I16 result;
    result.parts[0] = hn::VFromD<I16::Tag>{_mm512_broadcast_i32x4(words)};
    return result;
#else
    alignas(64) std::array<int32_t, 16> at;
    store(places, at.data());
    alignas(16) std::array<int32_t, 4> words;
    for (size_t k = 0; k < 4; ++k)
        words[k] = static_cast<int32_t>(loadLe<uint32_t>(base + static_cast<uint32_t>(at[k])));
    return loadBlocks(words.data());
#endif
}

// Of vectors that are the same in every block: lane k in all of block k.
HWY_INLINE I16 spread(const I16& values) {
    I16 result;
#if HWY_TARGET == HWY_SCALAR
    for (size_t k = 0; k < 16; ++k) result.parts[k] = values.parts[k / 4];
#else
    struct Table {
        alignas(64) std::array<uint8_t, 64> bytes;
    };
    static constexpr Table table = [] {
        Table of{};
        for (size_t k = 0; k < 64; ++k) of.bytes[k] = static_cast<uint8_t>(4 * (k / 16) + k % 4);
        return of;
    }();
    for (size_t k = 0; k < I16::partCount; ++k) {
        const auto lanes =
            hn::LoadU(hn::Repartition<uint8_t, I16::Tag>(), table.bytes.data() + 4 * I16::partLanes * k);
        result.parts[k] = hn::TableLookupBytes(values.parts[k], hn::BitCast(I16::Tag(), lanes));
    }
#endif
    return result;
}

}  // namespace filigree::grid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
