#include "quadmap/lookup.h"

#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "quadmap/lookup.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace filigree::quadmap::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<uint32_t, 16>;
using Floats = hn::RebindToFloat<Lanes>;
using Vec = hn::VFromD<Lanes>;

HWY_INLINE Vec set(uint32_t value) {
    return hn::Set(Lanes(), value);
}
HWY_INLINE Vec low(Vec values, unsigned bits) {
    return hn::And(values, set((1U << bits) - 1));
}
// All bits set where bit `bit` of a lane is.
template <int bit>
HWY_INLINE Vec spread(Vec values) {
    const hn::RebindToSigned<Lanes> d;
    return hn::BitCast(Lanes(), hn::ShiftRight<31>(hn::BitCast(d, hn::ShiftLeft<31 - bit>(values))));
}
// The 4 bytes at base + offsets[lane].
HWY_INLINE Vec gather(const uint8_t* base, Vec offsets) {
    const hn::RebindToSigned<Lanes> d;
    return hn::GatherOffset(Lanes(), reinterpret_cast<const uint32_t*>(base), hn::BitCast(d, offsets));
}

// Places in maps: offsets of the maps' bytes, columns and rows.
struct Places {
    Vec block;
    Vec x;
    Vec y;
};

struct LocalCell {
    Vec x;
    Vec y;
};

// The stored cell that a transform shows at `cell` of vectors of 2^bits cells a side.
template <unsigned bits>
HWY_INLINE LocalCell storedCells(Vec transform, LocalCell cell) {
    const auto last = set((1U << bits) - 1);
    const auto x = hn::Xor(cell.x, hn::And(spread<2>(transform), last));
    const auto y = hn::Xor(cell.y, hn::And(spread<1>(transform), last));
    const auto turned = spread<0>(transform);
    const auto exchange = hn::And(hn::Xor(x, y), turned);
    return {hn::Xor(hn::Xor(x, exchange), hn::And(turned, last)), hn::Xor(y, exchange)};
}

// 0, 1 or 2 for a region that a word knows or not.
HWY_INLINE Vec stateOf(Vec known, Vec palette) {
    const auto one = set(1);
    return hn::IfThenElse(hn::Eq(known, one), hn::Add(palette, palette), one);
}

template <unsigned side>
struct Raw {
    static constexpr unsigned bits = side == 16 ? 4 : 5;
    static constexpr unsigned blockShift = 2 * bits - 2;
    static HWY_INLINE Vec regions(const uint8_t* maps, const Places& at) {
        const auto place = hn::Add(hn::ShiftLeft<bits>(at.y), at.x);
        // The aligned four bytes that hold the region.
        const auto word = gather(maps, hn::Add(at.block, hn::ShiftLeft<2>(hn::ShiftRight<4>(place))));
        return low(hn::Shr(word, hn::ShiftLeft<1>(low(place, 4))), 2);
    }
};

template <bool plus>
struct Vq2Lookup {
    static constexpr unsigned bits = 4;
    static constexpr unsigned blockShift = 5;

    static HWY_INLINE Vec regions(const uint8_t* maps, const Places& at) {
        const auto row = hn::ShiftRight<1>(at.y);
        const auto indices = gather(maps, hn::Add(at.block, hn::Add(row, hn::Add(row, row))));
        const auto column = hn::ShiftRight<1>(at.x);
        const auto index = low(hn::Shr(indices, hn::Add(column, hn::Add(column, column))), 3);
        const auto quadrant = hn::Or(hn::ShiftRight<3>(at.x), hn::ShiftLeft<1>(hn::ShiftRight<3>(at.y)));
        const auto book = gather(maps, hn::Add(at.block, set(24)));
        const auto triple = hn::Add(quadrant, hn::Add(quadrant, quadrant));
        const auto transform = low(hn::Shr(hn::ShiftLeft<3>(low(book, 9)), triple), 3);
        // Own words start at bit 24 + 10 * quadrant of the book; those of all but the first lie in its upper
        // half.
        const auto isFirst = hn::Eq(quadrant, set(0));
        const auto own =
            hn::Shr(gather(maps, hn::Add(at.block, hn::IfThenElse(isFirst, set(27), set(28)))),
                    hn::IfThenElseZero(hn::Not(isFirst), hn::Sub(hn::Mul(quadrant, set(10)), set(8))));
        const auto isOwn = hn::Gt(index, set(5));
        const auto slot = hn::Sub(index, hn::IfThenElse(isOwn, set(6), set(3)));
        const auto words = hn::IfThenElse(isOwn, own, hn::ShiftRight<9>(book));
        auto word = hn::Shr(words, hn::And(hn::Add(slot, hn::ShiftLeft<2>(slot)), set(31)));
        auto cell = storedCells<1>(transform, {low(at.x, 1), low(at.y, 1)});
        auto isUniform = hn::Lt(index, set(3));
        if (plus) {
            const auto first = low(own, 5);
            const auto second = low(hn::ShiftRight<5>(own), 5);
            const auto reread = hn::ShiftLeft<1>(low(hn::Xor(first, second), 1));
            const auto rereads = hn::And(hn::Gt(first, second), hn::Eq(index, reread));
            const auto falls = hn::Gt(low(hn::ShiftRight<14>(book), 5), low(hn::ShiftRight<19>(book), 5));
            const auto turned = storedCells<1>(hn::IfThenElse(falls, set(6), set(1)), cell);
            cell = {hn::IfThenElse(rereads, turned.x, cell.x), hn::IfThenElse(rereads, turned.y, cell.y)};
            word = hn::IfThenElse(rereads, hn::ShiftRight<9>(book), word);
            isUniform = hn::AndNot(rereads, isUniform);
        }
        const auto known = low(hn::Shr(word, hn::Add(cell.x, hn::Add(cell.y, cell.y))), 1);
        return hn::IfThenElse(isUniform, index, stateOf(known, low(hn::ShiftRight<4>(word), 1)));
    }
};

template <bool plus>
struct Vq4Lookup {
    static constexpr unsigned bits = 5;
    static constexpr unsigned blockShift = 6;

    static HWY_INLINE Vec regions(const uint8_t* maps, const Places& at) {
        const auto row = hn::ShiftRight<2>(at.y);
        const auto indices = gather(maps, hn::Add(at.block, hn::ShiftLeft<2>(row)));
        const auto index = low(hn::Shr(indices, hn::ShiftLeft<2>(hn::ShiftRight<2>(at.x))), 4);
        const auto transforms = gather(maps, hn::Add(at.block, set(58)));
        const auto cell = storedCells<2>(transformOf(transforms, at), {low(at.x, 2), low(at.y, 2)});
        const auto masks = gather(maps, hn::Add(at.block, hn::Add(set(26), hn::Add(index, index))));
        const auto known = low(hn::Shr(masks, hn::Add(cell.x, hn::ShiftLeft<2>(cell.y))), 1);
        const auto palettes = gather(maps, hn::Add(at.block, set(60)));
        const auto palette = paletteOf(transforms, palettes, index, cell);
        return hn::IfThenElse(hn::Lt(index, set(3)), index, stateOf(known, palette));
    }

  private:
    static HWY_INLINE Vec transformOf(Vec transforms, const Places& at) {
        const auto quadrant = hn::Or(hn::ShiftRight<4>(at.x), hn::ShiftLeft<1>(hn::ShiftRight<4>(at.y)));
        if (!plus) {
            const auto triple = hn::Add(quadrant, hn::Add(quadrant, quadrant));
            return low(hn::Shr(hn::ShiftLeft<3>(low(transforms, 9)), triple), 3);
        }
        const auto group = hn::Add(hn::Add(quadrant, quadrant), low(hn::ShiftRight<3>(at.y), 1));
        return low(hn::Shr(transforms, hn::Add(group, hn::Add(group, group))), 3);
    }

    // Bits 0..31 and 16..47 of the tail. Palettes start at bit 9, or 24 in VQ4+.
    static HWY_INLINE Vec paletteOf(Vec tail, Vec upper, Vec index, LocalCell cell) {
        const auto right = hn::ShiftRight<1>(cell.x);
        const auto lower = hn::ShiftRight<1>(cell.y);
        const auto part = hn::Add(right, hn::Add(lower, lower));
        const auto isVertical = hn::Eq(index, set(6));
        const auto isFew = hn::Lt(index, set(6));   // the words before the vertical one
        const auto isMany = hn::Gt(index, set(7));  // the words behind the horizontal one
        const auto half = hn::IfThenElse(isVertical, right, hn::Add(lower, set(2)));
        if (!plus) {
            const auto simple = hn::Add(index, set(6));
            const auto place = hn::IfThenElse(isFew, simple, hn::Add(half, set(12)));
            const auto generic = hn::Add(hn::ShiftLeft<2>(low(index, 3)), part);
            return low(
                hn::Shr(hn::IfThenElse(isMany, upper, tail), low(hn::IfThenElse(isMany, generic, place), 5)),
                1);
        }
        const auto generic = hn::Add(hn::ShiftLeft<2>(index), hn::Sub(part, set(4)));
        const auto simple = hn::Add(index, set(16));
        const auto place =
            hn::IfThenElse(isMany, simple, hn::IfThenElse(isFew, generic, hn::Add(half, set(20))));
        return low(hn::Shr(upper, low(place, 5)), 1);
    }
};

// The column or row of a coordinate, as regionAlong() finds it.
HWY_INLINE Vec along(hn::VFromD<Floats> coordinate, unsigned side) {
    const Floats d;
    const hn::RebindToSigned<Lanes> whole;
    const auto above = hn::IfThenElseZero(hn::Gt(coordinate, hn::Zero(d)), coordinate);
    const auto scaled = hn::Mul(hn::Min(above, hn::Set(d, 1.0F)), hn::Set(d, static_cast<float>(side)));
    return hn::Min(hn::BitCast(Lanes(), hn::ConvertTo(whole, scaled)), set(side - 1));
}

template <class Format>
void lookupSome(const uint8_t* maps, const uint32_t* map, const uint8_t* halves, const float* u,
                const float* v, uint8_t* regions) {
    const Lanes d;
    const Floats floats;
    const hn::Rebind<uint8_t, Lanes> narrow;
    const auto one = hn::Set(floats, 1.0F);
    const auto isSecond = hn::RebindMask(floats, hn::Ne(hn::PromoteTo(d, hn::LoadU(narrow, halves)), set(0)));
    const auto weightU = hn::LoadU(floats, u);
    const auto weightV = hn::LoadU(floats, v);
    const auto x = hn::IfThenElse(isSecond, hn::Sub(one, weightU), weightU);
    const auto y = hn::IfThenElse(isSecond, hn::Sub(one, weightV), weightV);
    const Places places{hn::ShiftLeft<Format::blockShift>(hn::LoadU(d, map)), along(x, 1U << Format::bits),
                        along(y, 1U << Format::bits)};
    hn::StoreU(hn::TruncateTo(narrow, Format::regions(maps, places)), narrow, regions);
}

template <class Format>
void lookupAll(const uint8_t* maps, const SquareHits& hits, uint8_t* regions) {
    const size_t lanes = hn::Lanes(Lanes());
    const size_t count = hits.maps.size();
    const auto* halves = reinterpret_cast<const uint8_t*>(hits.halves.data());
    size_t k = 0;
    for (; k + lanes <= count; k += lanes) {
        lookupSome<Format>(maps, hits.maps.data() + k, halves + k, hits.u.data() + k, hits.v.data() + k,
                           regions + k);
    }
    if (k == count) return;
    std::array<uint32_t, 16> map{};
    std::array<uint8_t, 16> half{};
    std::array<float, 16> u{};
    std::array<float, 16> v{};
    std::array<uint8_t, 16> last{};
    std::copy(hits.maps.begin() + static_cast<ptrdiff_t>(k), hits.maps.end(), map.begin());
    std::copy(halves + k, halves + count, half.begin());
    std::copy(hits.u.begin() + static_cast<ptrdiff_t>(k), hits.u.end(), u.begin());
    std::copy(hits.v.begin() + static_cast<ptrdiff_t>(k), hits.v.end(), v.begin());
    lookupSome<Format>(maps, map.data(), half.data(), u.data(), v.data(), last.data());
    std::copy_n(last.begin(), count - k, regions + k);
}

void lookup(SquareFormat format, const uint8_t* maps, const SquareHits& hits, uint8_t* regions) {
    switch (format) {
        case SquareFormat::vq2:
            return lookupAll<Vq2Lookup<false>>(maps, hits, regions);
        case SquareFormat::vq2Plus:
            return lookupAll<Vq2Lookup<true>>(maps, hits, regions);
        case SquareFormat::vq4:
            return lookupAll<Vq4Lookup<false>>(maps, hits, regions);
        case SquareFormat::vq4Plus:
            return lookupAll<Vq4Lookup<true>>(maps, hits, regions);
        case SquareFormat::raw16:
            return lookupAll<Raw<16>>(maps, hits, regions);
        case SquareFormat::raw32:
            return lookupAll<Raw<32>>(maps, hits, regions);
    }
}

}  // namespace filigree::quadmap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace filigree::quadmap {

HWY_EXPORT(lookup);

void lookupSquares(SquareFormat format, const uint8_t* maps, const SquareHits& hits,
                   std::span<Region> regions) {
    if (hits.maps.empty()) return;
    HWY_DYNAMIC_DISPATCH(lookup)(format, maps, hits, reinterpret_cast<uint8_t*>(regions.data()));
}

}  // namespace filigree::quadmap
#endif
