// Sub-grids of the codec `paper` by vectors: included once for each SIMD target.
#if defined(FILIGREE_GRID_PAPER_BLOCK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FILIGREE_GRID_PAPER_BLOCK_INL_H_
#undef FILIGREE_GRID_PAPER_BLOCK_INL_H_
#else
#define FILIGREE_GRID_PAPER_BLOCK_INL_H_
#endif

#include "filigree/grid/paper.h"

#include "grid/block.h"
#include "grid/lanes-inl.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace filigree::grid::HWY_NAMESPACE {

// Of the 25 vertices and 7 that mean nothing, by the record's size in quads.
struct PaperWeights {
    alignas(64) std::array<std::array<float, 32>, 5> nearColumn{}, farColumn{}, nearRow{}, farRow{};
    // Where displacements stand; of corners anywhere, and `isDisplaced` 0.
    alignas(64) std::array<int32_t, 32> slotAt{};
    alignas(64) std::array<int32_t, 32> isDisplaced{};
};
constexpr PaperWeights paperWeightsOfPlaces() {
    PaperWeights weights{};
    for (unsigned k = 0; k < 32; ++k) {
        const unsigned column = k < 25 ? k % 5 : 0, row = k < 25 ? k / 5 : 0;
        for (unsigned steps = 1; steps <= 4; ++steps) {
            weights.nearColumn[steps][k] = paperNear[steps][column];
            weights.farColumn[steps][k] = paperFar[steps][column];
            weights.nearRow[steps][k] = paperNear[steps][row];
            weights.farRow[steps][k] = paperFar[steps][row];
        }
        const auto slot = paperSlot(column, row);
        weights.slotAt[k] = static_cast<int32_t>(paperSlotsAt + 3 * slot.value_or(0));
        weights.isDisplaced[k] = slot ? 0xffffff : 0;
    }
    return weights;
}
inline constexpr PaperWeights paperWeights = paperWeightsOfPlaces();

// Floats as bits.
HWY_INLINE I16 bitsOf(const F16& a) {
    return perPart<I16>([](auto x) { return hn::BitCast(I16::Tag(), x); }, a);
}
HWY_INLINE F16 floatsOf(const I16& a) {
    return perPart<F16>([](auto x) { return hn::BitCast(F16::Tag(), x); }, a);
}
// `magnitude` is not negative; the lowest bit of `sign` negates it.
HWY_INLINE F16 signedBy(const F16& magnitude, const I16& sign) {
    return floatsOf(bitsOf(magnitude) | shiftLeft<31>(sign));
}

struct PaperDisplacement {
    F16 axis[3];
};

HWY_INLINE PaperDisplacement unitVectorDisplacement(const I16& code, const PaperCode& paper,
                                                    const UnitVectors& vectors) {
    const I16 length = code & all(0x7ff);
    const I16 bits = shiftLeft<18>(length) + all(int32_t{paper.exponentBase} << 23);
    // Length 0 stands for none: all ones where it is greater.
    const I16 isSome = all(0) - shiftRightBy(all(0) - length, all(31));
    const F16 scale = floatsOf(bits & isSome);
    const I16 vector = shiftLeft<2>(shiftRight<11>(code) & all(0x3ff));
    const auto axis = [&](const std::array<float, 1024>& table, int32_t at) {
        const F16 unit = floatsOf(gather(reinterpret_cast<const uint8_t*>(table.data()), vector));
        return signedBy(unit * scale, shiftRightBy(code, all(at)) & all(1));
    };
    return {{axis(vectors.x, 21), axis(vectors.y, 22), axis(vectors.z, 23)}};
}

HWY_INLINE PaperDisplacement sharedExponentDisplacement(const I16& code, const PaperCode& paper) {
    const I16 exponent = (shiftRight<15>(code) & all(63)) + all(int32_t{paper.exponentBase} - 4);
    const F16 scale = floatsOf(shiftLeft<23>(exponent));
    const auto axis = [&](int32_t at, int32_t sign) {
        const F16 mantissa = toFloat(shiftRightBy(code, all(at)) & all(31));
        return signedBy(mantissa * scale, shiftRightBy(code, all(sign)) & all(1));
    };
    return {{axis(10, 21), axis(5, 22), axis(0, 23)}};
}

// The operations of decodePaper, in lanes.
inline void decodePaperBlock(const uint8_t* record, const PaperCode& paper, const UnitVectors& vectors,
                             Block& block) {
    const unsigned size = record[paperSizeAt];
    const unsigned columns = size >> 4 & 7, rows = size & 15;
    const auto corners = paperCorners(record);
    for (size_t half = 0; half < 2; ++half) {
        const size_t at = 16 * half;
        const F16 nearColumn = load(paperWeights.nearColumn[columns].data() + at);
        const F16 farColumn = load(paperWeights.farColumn[columns].data() + at);
        const F16 nearRow = load(paperWeights.nearRow[rows].data() + at);
        const F16 farRow = load(paperWeights.farRow[rows].data() + at);
        const I16 code = gather(record, load(paperWeights.slotAt.data() + at)) &
                         load(paperWeights.isDisplaced.data() + at);
        const PaperDisplacement displacement = paper.displacement == DisplacementCode::unitVector
                                                   ? unitVectorDisplacement(code, paper, vectors)
                                                   : sharedExponentDisplacement(code, paper);
        for (size_t axis = 0; axis < 3; ++axis) {
            const F16 left = all(corners[0][axis]) * nearRow + all(corners[2][axis]) * farRow;
            const F16 right = all(corners[1][axis]) * nearRow + all(corners[3][axis]) * farRow;
            const F16 patch = left * nearColumn + right * farColumn;
            store(patch + displacement.axis[axis], block.points[axis].data() + at);
        }
    }
    // Quads stand in the first columns and rows here, not at places of a patch.
    block.quads = ((1U << columns) - 1) * 0x1111U & ((1U << 4 * rows) - 1);
    block.bd = (size & 0x80) != 0 ? 0xffff : 0;
}

}  // namespace filigree::grid::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
