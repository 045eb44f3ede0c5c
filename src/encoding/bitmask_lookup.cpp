#include "filigree/encoding/bitmask.h"

#include <array>
#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "encoding/bitmask_lookup.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include "encoding/lanes-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace filigree::encoding::HWY_NAMESPACE {

using RealLanes = hn::RebindToFloat<Lanes>;
using RealVector = hn::VFromD<RealLanes>;

// Whole numbers from 0 to 2^52, as integers and back.
constexpr double bias = 4503599627370496.0;  // 2^52
inline LaneVector toInteger(RealVector x) {
    const RealLanes d;
    return hn::And(hn::BitCast(Lanes(), hn::Add(x, hn::Set(d, bias))),
                   hn::Set(Lanes(), (uint64_t{1} << 52) - 1));
}
inline RealVector toReal(LaneVector x) {
    const RealLanes d;
    const auto biased = hn::Or(x, hn::BitCast(Lanes(), hn::Set(d, bias)));
    return hn::Sub(hn::BitCast(d, biased), hn::Set(d, bias));
}

// BitmaskAxis in each lane.
struct Axis {
    RealVector size;
    LaneVector wrap;
    RealVector between;  // 1 or 0
    [[nodiscard]] RealVector extra() const {
        const RealLanes d;
        return hn::IfThenZeroElse(hn::RebindMask(d, hn::Eq(wrap, hn::Zero(Lanes()))), between);
    }
    [[nodiscard]] RealVector position(const float* coordinates) const {
        const RealLanes d;
        const auto coordinate = hn::PromoteTo(d, hn::LoadU(hn::Rebind<float, RealLanes>(), coordinates));
        return hn::Sub(hn::Mul(coordinate, size), hn::Mul(between, hn::Set(d, 0.5)));
    }
    [[nodiscard]] RealVector stored(RealVector position) const {
        const RealLanes d;
        const auto more = extra();
        const auto cells = hn::Add(size, more);
        const auto at = hn::Add(hn::Floor(position), more);
        const auto one = hn::Set(d, 1);
        const auto clamped = hn::Min(hn::Max(at, hn::Zero(d)), hn::Sub(cells, one));
        const auto mirrors = hn::RebindMask(d, hn::Eq(wrap, hn::Set(Lanes(), 1)));
        const auto period = hn::Add(size, hn::IfThenElseZero(mirrors, size));
        // The quotient's rounding may put this one period off.
        auto in = hn::Sub(at, hn::Mul(hn::Floor(hn::Div(at, period)), period));
        in = hn::Add(in, hn::IfThenElseZero(hn::Lt(in, hn::Zero(d)), period));
        in = hn::Sub(in, hn::IfThenElseZero(hn::Ge(in, period), period));
        const auto mirrored = hn::Sub(hn::Add(hn::Sub(period, one), more), in);
        const auto wrapped = hn::IfThenElse(hn::Lt(in, cells), in, mirrored);
        return hn::IfThenElse(hn::RebindMask(d, hn::Eq(wrap, hn::Set(Lanes(), 2))), clamped, wrapped);
    }
};

// The vector of coordinates at u and v. payload.size() >= 8: the last bytes are read from further ahead.
inline LaneVector lookupBitmaskLanes(const EncodedView& set, LaneVector textures, const float* u,
                                     const float* v, double reach) {
    const Lanes d;
    const RealLanes real;
    const auto low16 = hn::Set(d, 0xffff);
    const auto three = hn::Set(d, 3);
    const auto one = hn::Set(d, 1);
    const auto at = hn::Add(hn::ShiftLeft<3>(textures), hn::ShiftLeft<2>(textures));
    const auto head = gatherBytes(set.descriptors.data(), at);
    const auto flags = hn::ShiftRight<32>(gatherBytes(set.descriptors.data(), hn::Add(at, hn::Set(d, 4))));
    const auto between = toReal(hn::Sub(one, hn::And(hn::ShiftRight<4>(flags), one)));
    const Axis columns{toReal(hn::Add(hn::And(hn::ShiftRight<32>(head), low16), one)), hn::And(flags, three),
                       between};
    const Axis rows{toReal(hn::Add(hn::ShiftRight<48>(head), one)), hn::And(hn::ShiftRight<2>(flags), three),
                    between};
    const auto isNear = [&](RealVector position) { return hn::Lt(hn::Abs(position), hn::Set(real, reach)); };
    auto x = columns.position(u);
    auto y = rows.position(v);
    const auto reached = hn::And(isNear(x), isNear(y));
    x = hn::IfThenElseZero(reached, x);
    y = hn::IfThenElseZero(reached, y);
    const auto rowCells = hn::Add(columns.size, columns.extra());
    const auto cell = toInteger(hn::Add(hn::Mul(rows.stored(y), rowCells), columns.stored(x)));
    const bool wide = set.format == micromap::Format::fourState;
    const auto mask = hn::Set(d, wide ? 3 : 1);
    const auto bit = wide ? hn::ShiftLeft<1>(cell) : cell;
    const auto byte = hn::Add(hn::And(head, hn::Set(d, 0xffffffff)), hn::ShiftRight<3>(bit));
    const auto load = hn::Min(byte, hn::Set(d, set.payload.size() - 8));
    const auto shift = hn::Add(hn::ShiftLeft<3>(hn::Sub(byte, load)), hn::And(bit, hn::Set(d, 7)));
    const auto found = hn::And(hn::Shr(gatherBytes(set.payload.data(), load), shift), mask);
    return hn::IfThenElse(hn::RebindMask(d, reached), found, mask);
}

void lookupBitmask(const EncodedView& set, double reach, const uint32_t* textures, const float* u,
                   const float* v, micromap::State* states, size_t count) {
    const Lanes d;
    const hn::Rebind<uint32_t, Lanes> narrow;
    const size_t lanes = hn::Lanes(d);
    const auto some = [&](const uint32_t* texture, const float* pu, const float* pv, size_t k,
                          size_t wanted) {
        std::array<uint64_t, 8> found;
        const auto wide = hn::PromoteTo(d, hn::LoadU(narrow, texture));
        hn::StoreU(lookupBitmaskLanes(set, wide, pu, pv, reach), d, found.data());
        for (size_t j = 0; j < wanted; ++j) states[k + j] = static_cast<micromap::State>(found[j]);
    };
    size_t k = 0;
    for (; k + lanes <= count; k += lanes) some(textures + k, u + k, v + k, k, lanes);
    if (k == count) return;
    std::array<uint32_t, 8> lastTextures;
    std::array<float, 8> lastU{};
    std::array<float, 8> lastV{};
    lastTextures.fill(textures[k]);
    std::copy(textures + k, textures + count, lastTextures.begin());
    std::copy(u + k, u + count, lastU.begin());
    std::copy(v + k, v + count, lastV.begin());
    some(lastTextures.data(), lastU.data(), lastV.data(), k, count - k);
}

}  // namespace filigree::encoding::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace filigree::encoding {

HWY_EXPORT(lookupBitmask);

void BitmaskReader::lookup(std::span<const uint32_t> textures, std::span<const float> u,
                           std::span<const float> v, std::span<micromap::State> states) const {
    assert(u.size() == textures.size() && v.size() == textures.size() && states.size() == textures.size());
    if (set_.payload.size() >= 8) {
        HWY_DYNAMIC_DISPATCH(lookupBitmask)
        (set_, reach, textures.data(), u.data(), v.data(), states.data(), textures.size());
    } else {
        for (size_t k = 0; k < textures.size(); ++k) states[k] = at(textures[k], u[k], v[k]);
    }
}

}  // namespace filigree::encoding
#endif
