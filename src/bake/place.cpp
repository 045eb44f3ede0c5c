#include "bake/place.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bake/place.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace filigree::bake::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, image::Outline::padding>;
using Ints = hn::RebindToSigned<Floats>;
using VF = hn::Vec<Floats>;
using VI = hn::Vec<Ints>;
constexpr Floats df;
constexpr Ints di;

// A piece's end in the lattice.
struct End {
    VF a;
    VF b;
    VF sum;
};

// No fused operations: the result must not depend on the target.
HWY_INLINE VF coordinate(float perX, float perY, float constant, VF x, VF y) {
    return hn::Add(hn::Add(hn::Mul(hn::Set(df, perX), x), hn::Mul(hn::Set(df, perY), y)),
                   hn::Set(df, constant));
}

HWY_INLINE End endAt(const PlaceFrame& frame, VF x, VF y) {
    const VF a = coordinate(frame.ax, frame.ay, frame.a0, x, y);
    const VF b = coordinate(frame.bx, frame.by, frame.b0, x, y);
    return {a, b, hn::Add(a, b)};
}

// The place of the micro-triangle that holds an end at least `reach` from its sides.
HWY_INLINE VI placeOf(const PlaceFrame& frame, const End& end, VF reach) {
    const VF one = hn::Set(df, 1.0f);
    const VF zero = hn::Zero(df);
    const VF i = hn::Floor(end.a);
    const VF j = hn::Floor(end.b);
    const VF fa = hn::Sub(end.a, i);
    const VF fb = hn::Sub(end.b, j);
    const VF diagonal = hn::Sub(hn::Add(fa, fb), one);
    const VF far = hn::Sub(one, reach);
    const auto inCell =
        hn::And(hn::And(hn::Gt(fa, reach), hn::Lt(fa, far)), hn::And(hn::Gt(fb, reach), hn::Lt(fb, far)));
    const auto clear = hn::And(inCell, hn::Gt(hn::Abs(diagonal), reach));
    const auto flipped = hn::Gt(diagonal, zero);
    const VF steps = hn::Set(df, frame.steps);
    const auto inTile = hn::And(hn::And(hn::Ge(i, zero), hn::Ge(j, zero)), hn::Lt(end.sum, steps));
    VI place = hn::Or(hn::ShiftLeftSame(hn::ConvertTo(di, j), frame.rowShift),
                      hn::ShiftLeft<1>(hn::ConvertTo(di, i)));
    place = hn::IfThenElse(hn::RebindMask(di, flipped), hn::Or(place, hn::Set(di, 1)), place);
    place = hn::IfThenElse(hn::RebindMask(di, inTile), place, hn::Set(di, placeOutside));
    return hn::IfThenElse(hn::RebindMask(di, clear), place, hn::Set(di, placeUnclear));
}

// How many lattice lines of one family lie between low and high.
HWY_INLINE VF linesBetween(VF p, VF q, VF reach) {
    return hn::Sub(hn::Floor(hn::Add(hn::Max(p, q), reach)), hn::Floor(hn::Sub(hn::Min(p, q), reach)));
}

void placePiecesSimd(const image::Outline::PieceArrays& pieces, const image::Outline::Run& run,
                     const PlaceFrame& frame, Places& places) {
    const VI columnShift = hn::Set(di, static_cast<int32_t>(run.column - frame.column));
    const VI rowShift = hn::Set(di, static_cast<int32_t>(run.row - frame.row));
    const VF zero = hn::Zero(df);
    for (size_t k = run.first; k < run.end; k += hn::Lanes(df)) {
        const VF cellX = hn::ConvertTo(df, hn::Add(hn::LoadU(di, &pieces.cell[k]), columnShift));
        const VF cellY = hn::ConvertTo(df, hn::Add(hn::LoadU(di, &pieces.row[k]), rowShift));
        const End p = endAt(frame, hn::Add(cellX, hn::LoadU(df, &pieces.x0[k])),
                            hn::Add(cellY, hn::LoadU(df, &pieces.y0[k])));
        const End q = endAt(frame, hn::Add(cellX, hn::LoadU(df, &pieces.x1[k])),
                            hn::Add(cellY, hn::LoadU(df, &pieces.y1[k])));
        const VF bulge = hn::Mul(hn::LoadU(df, &pieces.bulge[k]), hn::Set(df, frame.length));
        const VF reach = hn::Add(hn::Set(df, frame.reach), bulge);

        // A piece that meets at most one lattice line crosses only the micro-triangles of its ends.
        const VF lines = hn::Add(hn::Add(linesBetween(p.a, q.a, reach), linesBetween(p.b, q.b, reach)),
                                 linesBetween(p.sum, q.sum, reach));
        const VI first = placeOf(frame, p, reach);
        const VI second = placeOf(frame, q, reach);
        const VI unclear = hn::Set(di, placeUnclear);
        const auto known = hn::And(hn::Ne(first, unclear), hn::Ne(second, unclear));
        const auto simple = hn::And(known, hn::RebindMask(di, hn::Lt(lines, hn::Set(df, 1.5f))));
        const auto outside = hn::Or(hn::Or(hn::Lt(hn::Add(hn::Max(p.a, q.a), reach), zero),
                                           hn::Lt(hn::Add(hn::Max(p.b, q.b), reach), zero)),
                                    hn::Gt(hn::Sub(hn::Min(p.sum, q.sum), reach), hn::Set(df, frame.steps)));
        VI result = hn::IfThenElse(simple, first, unclear);
        result = hn::IfThenElse(hn::RebindMask(di, outside), hn::Set(di, placeOutside), result);
        hn::StoreU(result, di, &places.first[k - run.first]);
        hn::StoreU(second, di, &places.second[k - run.first]);
    }
}

}  // namespace filigree::bake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace filigree::bake {

HWY_EXPORT(placePiecesSimd);

void placePieces(const image::Outline::PieceArrays& pieces, const image::Outline::Run& run,
                 const PlaceFrame& frame, Places& places) {
    HWY_DYNAMIC_DISPATCH(placePiecesSimd)(pieces, run, frame, places);
}

}  // namespace filigree::bake
#endif
