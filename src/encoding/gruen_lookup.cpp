#include "filigree/encoding/gruen.h"

#include <array>
#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "encoding/gruen_lookup.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include "encoding/lanes-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace filigree::encoding::HWY_NAMESPACE {

using PlaceLanes = hn::CappedTag<uint32_t, 16>;
using PlaceVector = hn::VFromD<PlaceLanes>;

// Every second bit, from the lowest on, closed up.
inline PlaceVector evenBits(PlaceVector bits) {
    const PlaceLanes d;
    bits = hn::And(bits, hn::Set(d, 0x55555555));
    bits = hn::And(hn::Or(bits, hn::ShiftRight<1>(bits)), hn::Set(d, 0x33333333));
    bits = hn::And(hn::Or(bits, hn::ShiftRight<2>(bits)), hn::Set(d, 0x0f0f0f0f));
    bits = hn::And(hn::Or(bits, hn::ShiftRight<4>(bits)), hn::Set(d, 0x00ff00ff));
    return hn::And(hn::Or(bits, hn::ShiftRight<8>(bits)), hn::Set(d, 0x0000ffff));
}

// Each bit becomes the parity of itself and all higher ones, in the low 16 bits.
inline PlaceVector parities(PlaceVector bits) {
    bits = hn::Xor(bits, hn::ShiftRight<1>(bits));
    bits = hn::Xor(bits, hn::ShiftRight<2>(bits));
    bits = hn::Xor(bits, hn::ShiftRight<4>(bits));
    return hn::Xor(bits, hn::ShiftRight<8>(bits));
}

// rowOrderIndex() of the micro-triangle (i, j, flipped).
template <class V>
V rowOrder(V i, V j, V flipped) {
    const auto row = hn::Add(hn::Add(i, j), flipped);
    return hn::Add(hn::Mul(row, row), hn::Add(hn::ShiftLeft<1>(j), flipped));
}

// The operations of latticeTriangle() and rowOrderIndex(), one by one.
inline PlaceVector placesOfCurve(PlaceVector index) {
    const auto low = evenBits(index);
    const auto high = evenBits(hn::ShiftRight<1>(index));
    const auto turns = parities(hn::AndNot(high, low));
    const auto turned = hn::ShiftRight<1>(turns);
    const auto swapped = hn::ShiftRight<1>(parities(low));
    const auto i = hn::Xor(hn::AndNot(low, hn::Xor(high, swapped)), turned);
    const auto j = hn::Xor(hn::And(low, high), turned);
    return rowOrder(i, j, hn::And(turns, hn::Set(PlaceLanes(), 1)));
}

// The operations of the scalar rowOrderIndex(), one by one.
inline PlaceVector placesOfPoints(const float* u, const float* v, const uint32_t* levels) {
    const PlaceLanes d;
    const hn::RebindToSigned<PlaceLanes> di;
    const hn::RebindToFloat<PlaceLanes> df;
    const auto one = hn::Set(di, 1);
    const auto n = hn::BitCast(di, hn::Shl(hn::Set(d, 1), hn::LoadU(d, levels)));
    const auto last = hn::Sub(n, one);
    const auto scaled = [&](const float* from) {
        const auto value = hn::LoadU(df, from);
        const auto above = hn::IfThenElseZero(hn::Gt(value, hn::Zero(df)), value);
        return hn::Mul(hn::Min(above, hn::Set(df, 1.0f)), hn::ConvertTo(df, n));
    };
    const auto scaledU = scaled(u);
    const auto scaledV = scaled(v);
    const auto floorU = hn::ConvertTo(di, scaledU);
    const auto floorV = hn::ConvertTo(di, scaledV);
    const auto fractions =
        hn::Add(hn::Sub(scaledU, hn::ConvertTo(df, floorU)), hn::Sub(scaledV, hn::ConvertTo(df, floorV)));
    const auto j = hn::Min(floorV, last);
    const auto sum = hn::Add(hn::Min(floorU, last), j);
    const auto isFlipped =
        hn::And(hn::RebindMask(di, hn::Ge(fractions, hn::Set(df, 1.0f))), hn::Lt(sum, last));
    const auto i = hn::Sub(hn::Min(sum, last), j);
    return hn::BitCast(d, rowOrder(i, j, hn::IfThenElseZero(isFlipped, one)));
}

// The vectors that fill up; both return how many places they wrote.
size_t placesOfCurves(const uint32_t* indices, uint32_t* places, size_t count) {
    const PlaceLanes d;
    const size_t lanes = hn::Lanes(d);
    size_t k = 0;
    for (; k + lanes <= count; k += lanes)
        hn::StoreU(placesOfCurve(hn::LoadU(d, indices + k)), d, places + k);
    return k;
}

size_t placesOfAllPoints(const float* u, const float* v, const uint32_t* levels, uint32_t* places,
                         size_t count) {
    const PlaceLanes d;
    const size_t lanes = hn::Lanes(d);
    size_t k = 0;
    for (; k + lanes <= count; k += lanes)
        hn::StoreU(placesOfPoints(u + k, v + k, levels + k), d, places + k);
    return k;
}

// payload.size() >= 8: the last bytes are read from further ahead.
void lookupPlaces(const EncodedView& set, bool maybeOpaque, const uint32_t* maps, const uint32_t* places,
                  micromap::State* states, size_t count) {
    const Lanes d;
    const bool wide = set.format == micromap::Format::fourState;
    const auto lastLoad = hn::Set(d, set.payload.size() - 8);
    lookupLanes(maps, places, states, count, [&](LaneVector map, LaneVector place) {
        const auto record = gatherBytes(set.descriptors.data(), hn::ShiftLeft<3>(map));
        const auto bit = wide ? hn::ShiftLeft<1>(place) : place;
        const auto byte = hn::Add(hn::And(record, hn::Set(d, 0xffffffff)), hn::ShiftRight<3>(bit));
        const auto load = hn::Min(byte, lastLoad);
        const auto shift = hn::Add(hn::ShiftLeft<3>(hn::Sub(byte, load)), hn::And(bit, hn::Set(d, 7)));
        const auto read = hn::Shr(gatherBytes(set.payload.data(), load), shift);
        const auto value = hn::And(read, hn::Set(d, wide ? 3 : 1));
        return maybeOpaque ? hn::Or(value, hn::ShiftLeft<1>(value)) : value;
    });
}

}  // namespace filigree::encoding::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace filigree::encoding {

HWY_EXPORT(placesOfCurves);
HWY_EXPORT(placesOfAllPoints);
HWY_EXPORT(lookupPlaces);

void GruenReader::lookupAt(std::span<const uint32_t> maps, std::span<const uint32_t> places,
                           std::span<micromap::State> states) const {
    if (set_.payload.size() >= 8) {
        HWY_DYNAMIC_DISPATCH(lookupPlaces)
        (set_, isMaybeOpaque(), maps.data(), places.data(), states.data(), maps.size());
    } else {
        for (size_t k = 0; k < maps.size(); ++k) states[k] = atRowOrder(maps[k], places[k]);
    }
}

void GruenReader::lookup(std::span<const uint32_t> maps, std::span<const uint32_t> indices,
                         std::span<micromap::State> states) const {
    assert(indices.size() == maps.size() && states.size() == maps.size());
    std::array<uint32_t, 256> places;
    for (size_t first = 0; first < maps.size(); first += places.size()) {
        const size_t count = std::min(places.size(), maps.size() - first);
        size_t k = HWY_DYNAMIC_DISPATCH(placesOfCurves)(indices.data() + first, places.data(), count);
        for (; k < count; ++k) places[k] = rowOrderOfCurve(indices[first + k]);
        lookupAt(maps.subspan(first, count), std::span(places).first(count), states.subspan(first, count));
    }
}

void GruenReader::lookup(std::span<const uint32_t> maps, std::span<const float> u, std::span<const float> v,
                         std::span<micromap::State> states) const {
    assert(u.size() == maps.size() && v.size() == maps.size() && states.size() == maps.size());
    std::array<uint32_t, 256> levels;
    std::array<uint32_t, 256> places;
    for (size_t first = 0; first < maps.size(); first += places.size()) {
        const size_t count = std::min(places.size(), maps.size() - first);
        for (size_t k = 0; k < count; ++k) levels[k] = level(maps[first + k]);
        size_t k = HWY_DYNAMIC_DISPATCH(placesOfAllPoints)(u.data() + first, v.data() + first, levels.data(),
                                                           places.data(), count);
        for (; k < count; ++k) places[k] = rowOrderIndex(u[first + k], v[first + k], levels[k]);
        lookupAt(maps.subspan(first, count), std::span(places).first(count), states.subspan(first, count));
    }
}

}  // namespace filigree::encoding
#endif
