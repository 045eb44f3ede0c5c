#include "filigree/grid/paper.h"

#include "grid/unit_vectors.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

namespace filigree::grid {
namespace {

// Of the codes considered, the one whose decoded vertex is nearest; of equally near ones the first.
class NearestCode {
  public:
    NearestCode(const Vec3& base, const Vec3& target, const PaperCode& paper)
        : base_(base), target_(target), paper_(paper) {
        consider(0);
    }
    void consider(uint32_t code) {
        const Vec3 decoded = plus(base_, displacementOf(code, paper_));
        double error = 0;
        for (size_t axis = 0; axis < 3; ++axis) {
            const double off = double{decoded[axis]} - double{target_[axis]};
            error += off * off;
        }
        if (!(error < error_)) return;
        error_ = error;
        code_ = code;
    }
    [[nodiscard]] uint32_t code() const { return code_; }
    [[nodiscard]] double squaredError() const { return error_; }

  private:
    Vec3 base_;
    Vec3 target_;
    PaperCode paper_;
    double error_ = std::numeric_limits<double>::infinity();
    uint32_t code_ = 0;
};

// A wanted displacement, mirrored to the first octant.
struct Wanted {
    std::array<double, 3> size{};
    uint32_t octant = 0;

    Wanted(const Vec3& base, const Vec3& target) {
        for (size_t axis = 0; axis < 3; ++axis) {
            const double d = double{target[axis]} - double{base[axis]};
            size[axis] = std::fabs(d);
            octant |= static_cast<uint32_t>(d < 0) << axis;
        }
    }
    [[nodiscard]] double squared() const { return size[0] * size[0] + size[1] * size[1] + size[2] * size[2]; }
};

// The share of a quarter turn from x to y, both not negative and not both 0, to 1e-5; only where to look.
double quarterShare(double x, double y) {
    const double slope = std::min(x, y) / std::max(x, y);
    const double square = slope * slope;
    const double angle =
        slope * (0.9998660 +
                 square * (-0.3302995 + square * (0.1801410 + square * (-0.0851330 + square * 0.0208351))));
    const double share = angle * 0.636619772;
    return y <= x ? share : 1 - share;
}

// The 11 bits of the nearest length; `length` is positive.
uint32_t lengthCode(double length, const PaperCode& paper) {
    const auto bits = std::bit_cast<uint32_t>(static_cast<float>(length));
    const auto rounded = static_cast<int64_t>((bits + (1U << 17)) >> 18);
    return static_cast<uint32_t>(std::clamp<int64_t>(rounded - (int64_t{paper.exponentBase} << 5), 0, 0x7ff));
}

void considerVector(uint32_t k, const Wanted& wanted, const PaperCode& paper, NearestCode& nearest) {
    const UnitVectors& vectors = unitVectors();
    const double along =
        wanted.size[0] * vectors.x[k] + wanted.size[1] * vectors.y[k] + wanted.size[2] * vectors.z[k];
    // No length on this vector comes nearer than its foot.
    if (!(wanted.squared() - along * along < nearest.squaredError() * 1.0001)) return;
    nearest.consider(wanted.octant << 21 | k << 11 | lengthCode(along, paper));
}

// The two vectors of a ring around share `turn` of the quarter that it covers.
void considerRing(size_t ring, double turn, const Wanted& wanted, const PaperCode& paper,
                  NearestCode& nearest) {
    const UnitVectorRings& rings = unitVectorRings();
    const unsigned steps = rings.steps[ring];
    const auto k = static_cast<unsigned>(turn * steps);
    considerVector(rings.first[ring] + k, wanted, paper, nearest);
    if (k < steps) considerVector(rings.first[ring] + k + 1, wanted, paper, nearest);
}

// The four vectors around the direction: the next ones are further away than any length is wrong.
void searchUnitVectors(const Wanted& wanted, const PaperCode& paper, NearestCode& nearest) {
    const auto [x, y, z] = wanted.size;
    const double flat = std::sqrt(x * x + z * z);
    const double turn = flat > 0 ? quarterShare(x, z) : 0;
    const auto ring = static_cast<size_t>(quarterShare(y, flat) * paperRings);
    considerRing(ring, turn, wanted, paper, nearest);
    if (ring < paperRings) considerRing(ring + 1, turn, wanted, paper, nearest);
}

// The code with that exponent field and the nearest mantissas.
uint32_t sharedCode(const Wanted& wanted, uint32_t exponent, const PaperCode& paper) {
    const double unit = std::ldexp(1.0, static_cast<int>(exponent) + paper.exponentBase - 131);
    uint32_t code = wanted.octant << 21 | exponent << 15;
    for (unsigned axis = 0; axis < 3; ++axis) {
        const auto mantissa = static_cast<uint32_t>(std::min(31.0, wanted.size[axis] / unit + 0.5));
        code |= mantissa << (10 - 5 * axis);
    }
    return code;
}

// The exponent of the largest component, and the next for what its mantissa cannot hold.
void searchExponents(const Wanted& wanted, const PaperCode& paper, NearestCode& nearest) {
    const double largest = std::max({wanted.size[0], wanted.size[1], wanted.size[2]});
    const int exponent = std::ilogb(largest) + 127 - paper.exponentBase;
    for (const int k : {exponent, exponent + 1})
        nearest.consider(sharedCode(wanted, static_cast<uint32_t>(std::clamp(k, 0, 63)), paper));
}

void putFloat(uint8_t* to, float value) {
    storeLe(to, std::bit_cast<uint32_t>(value));
}

void putPlace(const PaperPlace& place, uint8_t* record) {
    const bool isBd = place.diagonal == Diagonal::bd;
    record[paperSizeAt] = static_cast<uint8_t>((isBd ? 0x80U : 0U) | place.columns << 4 | place.rows);
    storeLe(record + paperObjectAt, uint32_t{0});
    storeLe(record + paperGridAt, place.grid);
    storeLe(record + paperPlaceAt, static_cast<uint16_t>(place.gridColumn));
    storeLe(record + paperPlaceAt + 2, static_cast<uint16_t>(place.gridRow));
    storeLe(record + paperPlaceAt + 4, static_cast<uint16_t>(place.gridColumns));
    storeLe(record + paperPlaceAt + 6, static_cast<uint16_t>(place.gridRows));
}

void putSlot(uint8_t* record, unsigned slot, uint32_t code) {
    uint8_t* const to = record + paperSlotsAt + size_t{3} * slot;
    storeLe(to, static_cast<uint16_t>(code));
    to[2] = static_cast<uint8_t>(code >> 16);
}

}  // namespace

uint32_t encodeDisplacement(const Vec3& base, const Vec3& target, const PaperCode& paper) {
    NearestCode nearest(base, target, paper);
    const Wanted wanted(base, target);
    if (nearest.squaredError() > 0 && wanted.squared() > 0) {
        if (paper.displacement == DisplacementCode::unitVector)
            searchUnitVectors(wanted, paper, nearest);
        else
            searchExponents(wanted, paper, nearest);
    }
    return nearest.code();
}

std::array<uint8_t, paperBytes> encodePaper(const PaperPlace& place, const PaperVertices& vertices,
                                            const PaperCode& paper) {
    assert(place.columns >= 1 && place.columns <= paperQuads && place.rows >= 1 && place.rows <= paperQuads);
    std::array<uint8_t, paperBytes> record{};
    const auto at = [&](unsigned column, unsigned row) { return row * paperSide + column; };
    const std::array<Vec3, 4> corners{vertices[at(0, 0)], vertices[at(place.columns, 0)],
                                      vertices[at(0, place.rows)], vertices[at(place.columns, place.rows)]};
    for (size_t k = 0; k < 12; ++k) putFloat(record.data() + 4 * k, corners[k / 3][k % 3]);
    putPlace(place, record.data());
    const PaperVertices patch = paperPatch(corners, place.columns, place.rows);
    for (unsigned row = 0; row <= place.rows; ++row) {
        for (unsigned column = 0; column <= place.columns; ++column) {
            if (column % place.columns == 0 && row % place.rows == 0) continue;
            const unsigned k = at(column, row);
            putSlot(record.data(), *paperSlot(column, row), encodeDisplacement(patch[k], vertices[k], paper));
        }
    }
    return record;
}

}  // namespace filigree::grid
