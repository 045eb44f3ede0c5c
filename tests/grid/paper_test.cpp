// The page docs/spec/paper.md: fields at their places, both displacement codes, borders that agree.
#include "filigree/grid/paper.h"

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>

#include <gtest/gtest.h>
#include <xxhash.h>

namespace filigree::grid {
namespace {

constexpr std::array bothCodes{DisplacementCode::unitVector, DisplacementCode::sharedExponent};

class PaperRandom {
  public:
    explicit PaperRandom(uint32_t seed) : engine_(seed) {}
    float number(float spread) { return spread * (static_cast<float>(engine_() & 0xffffff) / 0x800000 - 1); }
    Vec3 point(float spread) { return {number(spread), number(spread), number(spread)}; }
    uint32_t bits() { return static_cast<uint32_t>(engine_()); }

  private:
    std::mt19937 engine_;
};

PaperVertices bumpySheet(PaperRandom& random, float roughness) {
    PaperVertices vertices{};
    for (unsigned k = 0; k < vertices.size(); ++k) {
        const Vec3 flat{static_cast<float>(k % 5), static_cast<float>(k / 5), 0};
        vertices[k] = plus(flat, random.point(roughness));
    }
    return vertices;
}

PaperPlace placeOf(unsigned columns, unsigned rows) {
    PaperPlace place;
    place.columns = columns;
    place.rows = rows;
    place.diagonal = Diagonal::bd;
    place.grid = 0x01234567;
    place.gridColumn = 0x1002;
    place.gridRow = 0x2004;
    place.gridColumns = 0xfffe;
    place.gridRows = 0xffff;
    return place;
}

TEST(PaperVectors, AreThoseOfThePage) {
    const UnitVectors& table = unitVectors();
    std::vector<float> numbers;
    for (size_t k = 0; k < 1024; ++k) {
        for (const float number : {table.x[k], table.y[k], table.z[k]}) numbers.push_back(number);
        const double length =
            std::hypot(double{table.x[k]}, std::hypot(double{table.y[k]}, double{table.z[k]}));
        ASSERT_NEAR(length, 1, 1e-7);
    }
    EXPECT_EQ(XXH3_64bits(numbers.data(), numbers.size() * sizeof(float)), 0xfc9d18bbbe835515);
    EXPECT_EQ(std::tuple(table.x[0], table.y[0], table.z[0]), std::tuple(0, 1, 0));
    EXPECT_EQ(std::tuple(table.x[984], table.y[984], table.z[984]), std::tuple(1, 0, 0));
    EXPECT_EQ(std::tuple(table.x[1023], table.y[1023], table.z[1023]), std::tuple(0, 0, 1));
}

TEST(PaperRecord, HasTheFieldsOfThePage) {
    PaperRandom random(1);
    const PaperVertices vertices = bumpySheet(random, 0.1F);
    const auto record = encodePaper(placeOf(4, 3), vertices, {});
    EXPECT_EQ(record[111], 0xc3);
    EXPECT_EQ(loadLe<uint32_t>(&record[112]), 0u);
    EXPECT_EQ(loadLe<uint32_t>(&record[116]), 0x01234567u);
    EXPECT_EQ(loadLe<uint16_t>(&record[120]), 0x1002);
    EXPECT_EQ(loadLe<uint16_t>(&record[122]), 0x2004);
    EXPECT_EQ(loadLe<uint16_t>(&record[124]), 0xfffe);
    EXPECT_EQ(loadLe<uint16_t>(&record[126]), 0xffff);
    EXPECT_EQ(loadLe<uint32_t>(&record[12]), std::bit_cast<uint32_t>(vertices[4][0]));
    EXPECT_EQ(loadLe<uint32_t>(&record[28]), std::bit_cast<uint32_t>(vertices[15][1]));
    EXPECT_EQ(paperPlace(record.data()), placeOf(4, 3));
}

TEST(PaperRecord, HasSlotsForAllPlacesButFour) {
    unsigned next = 0;
    for (unsigned place = 0; place < 25; ++place) {
        const auto slot = paperSlot(place % 5, place / 5);
        if (place == 0 || place == 4 || place == 20 || place == 24)
            EXPECT_FALSE(slot);
        else
            EXPECT_EQ(slot, next++);
    }
    EXPECT_EQ(next, paperSlots);
}

// The page's words, written again.
TEST(PaperDisplacement, IsThatOfThePage) {
    const PaperCode unit{DisplacementCode::unitVector, 100};
    const uint32_t vector = 500;
    const Vec3 d = displacementOf(5U << 21 | vector << 11 | 30U << 5 | 8U, unit);
    const float length = std::ldexp(1 + 8 / 32.0F, 30 + 100 - 127);
    EXPECT_EQ(d, (Vec3{-unitVectors().x[vector] * length, unitVectors().y[vector] * length,
                       -unitVectors().z[vector] * length}));
    EXPECT_EQ(displacementOf(vector << 11, unit), (Vec3{0, 0, 0}));

    const PaperCode shared{DisplacementCode::sharedExponent, 100};
    const Vec3 s = displacementOf(2U << 21 | 33U << 15 | 31U << 10 | 7U << 5 | 1U, shared);
    const float scale = std::ldexp(1.0F, 33 + 100 - 131);
    EXPECT_EQ(s, (Vec3{31 * scale, -7 * scale, 1 * scale}));
}

// The best code of all with any unit vector and the lengths around.
double leastSquaredError(const Vec3& target, const PaperCode& paper) {
    double least = std::numeric_limits<double>::infinity();
    for (uint32_t code = 0; code < 1U << 13; ++code) {
        const Vec3 along = displacementOf(code << 11 | 127U << 3, paper);
        const double length = std::sqrt(double{dot(target, target)} / double{dot(along, along)});
        const auto bits = std::bit_cast<uint32_t>(static_cast<float>(length)) >> 18;
        const uint32_t field = (127U << 3) + bits - (127U << 5);
        for (const uint32_t k : {field - 1, field, field + 1, field + 2}) {
            const Vec3 off = minus(displacementOf(code << 11 | (k & 0x7ff), paper), target);
            least = std::min(least, double{dot(off, off)});
        }
    }
    return least;
}

TEST(PaperDisplacement, IsTheNearest) {
    PaperRandom random(2);
    const PaperCode paper = PaperCode::forDiagonal(DisplacementCode::unitVector, 10);
    for (int k = 0; k < 60; ++k) {
        const Vec3 target = random.point(k % 2 == 0 ? 1.0F : 1e-4F);
        const Vec3 off = minus(displacementOf(encodeDisplacement({0, 0, 0}, target, paper), paper), target);
        ASSERT_LE(double{dot(off, off)}, leastSquaredError(target, paper) * 1.0001);
    }
}

TEST(PaperDisplacement, IsAsNearAsThePageSays) {
    PaperRandom random(3);
    for (const auto& [code, bound] : {std::pair(bothCodes[0], 0.031), std::pair(bothCodes[1], 0.047)}) {
        const PaperCode paper = PaperCode::forDiagonal(code, 1e6F);
        for (int k = 0; k < 20000; ++k) {
            const Vec3 target = random.point(std::ldexp(1.0F, k % 40 - 25));
            const Vec3 off =
                minus(displacementOf(encodeDisplacement({0, 0, 0}, target, paper), paper), target);
            ASSERT_LE(dot(off, off), bound * bound * dot(target, target));
        }
    }
}

TEST(PaperDisplacement, IsNoneWhereNoneIsWanted) {
    for (const DisplacementCode code : bothCodes)
        EXPECT_EQ(encodeDisplacement({3, -4, 5}, {3, -4, 5}, {code}), 0u);
}

TEST(PaperCodec, KeepsCornersAndComesNearTheRest) {
    PaperRandom random(4);
    for (const DisplacementCode code : bothCodes) {
        const PaperCode paper = PaperCode::forDiagonal(code, 8);
        for (unsigned size = 0; size < 16; ++size) {
            const PaperPlace place = placeOf(1 + size % 4, 1 + size / 4);
            const PaperVertices vertices = bumpySheet(random, 0.2F);
            const auto record = encodePaper(place, vertices, paper);
            ASSERT_TRUE(checkPaper(record, paper).ok());
            const PaperVertices decoded = decodePaper(record.data(), paper);
            for (unsigned row = 0; row <= place.rows; ++row) {
                for (unsigned column = 0; column <= place.columns; ++column) {
                    const unsigned k = row * 5 + column;
                    const Vec3 off = minus(decoded[k], vertices[k]);
                    const bool isCorner = column % place.columns == 0 && row % place.rows == 0;
                    ASSERT_LE(dot(off, off), isCorner ? 0 : 0.05F * 0.05F) << size << " " << k;
                }
            }
        }
    }
}

// The vertices seen with columns and rows exchanged, mirrored, or both.
PaperVertices seenFrom(const PaperVertices& vertices, unsigned side, unsigned view) {
    PaperVertices seen{};
    for (unsigned row = 0; row <= side; ++row) {
        for (unsigned column = 0; column <= side; ++column) {
            unsigned x = (view & 1) != 0 ? side - column : column;
            unsigned y = (view & 2) != 0 ? side - row : row;
            if ((view & 4) != 0) std::swap(x, y);
            seen[row * 5 + column] = vertices[y * 5 + x];
        }
    }
    return seen;
}

// The border of a square sub-grid decodes to the same points from whichever side it is seen, inside or not.
TEST(PaperCodec, AgreesAlongBordersInEveryOrientation) {
    PaperRandom random(5);
    for (const DisplacementCode code : bothCodes) {
        const PaperCode paper = PaperCode::forDiagonal(code, 8);
        for (unsigned trial = 0; trial < 64; ++trial) {
            const unsigned side = 1 + trial % 4;
            const PaperVertices vertices = bumpySheet(random, 0.3F);
            const PaperPlace place = placeOf(side, side);
            const auto decoded = decodePaper(encodePaper(place, vertices, paper).data(), paper);
            for (unsigned view = 0; view < 8; ++view) {
                const auto record = encodePaper(place, seenFrom(vertices, side, view), paper);
                const auto seen = decodePaper(record.data(), paper);
                const auto expected = seenFrom(decoded, side, view);
                for (unsigned k = 0; k < 25; ++k) {
                    const unsigned column = k % 5;
                    const unsigned row = k / 5;
                    const bool isBorder =
                        column <= side && row <= side && (column % side == 0 || row % side == 0);
                    if (!isBorder) continue;
                    ASSERT_EQ(seen[k], expected[k]) << trial << " " << view << " " << k;
                }
            }
        }
    }
}

TEST(PaperCodec, NeedsOnlyTheBordersOwnVertices) {
    PaperRandom random(6);
    PaperVertices left = bumpySheet(random, 0.3F);
    PaperVertices right = bumpySheet(random, 0.3F);
    for (unsigned row = 0; row < 5; ++row) right[row * 5] = left[row * 5 + 4];
    const auto decodedLeft = decodePaper(encodePaper(placeOf(4, 4), left, {}).data(), {});
    const auto decodedRight = decodePaper(encodePaper(placeOf(2, 4), right, {}).data(), {});
    for (unsigned row = 0; row < 5; ++row) EXPECT_EQ(decodedLeft[row * 5 + 4], decodedRight[row * 5]);
}

class PaperCheck : public testing::Test {
  protected:
    PaperCheck() {
        PaperRandom random(7);
        record_ = encodePaper(placeOf(2, 4), bumpySheet(random, 0.1F), {});
    }
    void expectRefusal(const std::string& part) {
        const Status status = checkPaper(record_, {});
        ASSERT_FALSE(status.ok());
        EXPECT_NE(status.error().message.find(part), std::string::npos) << status.error().message;
    }
    std::array<uint8_t, paperBytes> record_{};
};

TEST_F(PaperCheck, TakesWhatTheEncoderWrites) {
    EXPECT_TRUE(checkPaper(record_, {}).ok());
}
TEST_F(PaperCheck, RefusesSizes) {
    record_[111] = 0x54;
    expectRefusal("5 x 4 quads, expected 1 to 4");
    record_[111] = 0x20;
    expectRefusal("2 x 0 quads");
}
TEST_F(PaperCheck, RefusesPlacesOutsideTheGrid) {
    storeLe(&record_[124], uint16_t{0x1003});
    expectRefusal("leave their grid of 4099 x 65535 quads");
}
TEST_F(PaperCheck, RefusesAnObject) {
    record_[112] = 1;
    expectRefusal("objectID is 1");
}
TEST_F(PaperCheck, RefusesDisplacementsNobodyHas) {
    record_[48 + 3 * 2] = 1;  // vertex (3, 0)
    expectRefusal("vertex (3, 0)");
}
TEST_F(PaperCheck, RefusesDisplacedCorners) {
    record_[48 + 3 * 1] = 1;  // vertex (2, 0)
    expectRefusal("vertex (2, 0)");
}
TEST_F(PaperCheck, RefusesVerticesThatAreNotFinite) {
    storeLe(record_.data(), std::bit_cast<uint32_t>(std::numeric_limits<float>::infinity()));
    expectRefusal("not finite");
}

}  // namespace
}  // namespace filigree::grid
