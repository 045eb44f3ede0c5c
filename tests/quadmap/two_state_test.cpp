#include "filigree/quadmap/two_state.h"

#include "filigree/quadmap/encode.h"

#include "sample_squares.h"

#include <gtest/gtest.h>

namespace filigree::quadmap {
namespace {

// Raw squares with their bytes.
struct Stored {
    std::vector<uint8_t> bytes;
    SquareReader reader;

    explicit Stored(const Square& square) : bytes(bytesOf(square)), reader(open(bytes)) {}

  private:
    static std::vector<uint8_t> bytesOf(const Square& square) {
        std::vector<uint8_t> bytes(square.regions.size() / 4);
        encodeRaw(square, bytes);
        return bytes;
    }
    static SquareReader open(const std::vector<uint8_t>& bytes) {
        return *SquareReader::open(bytes.size() == 64 ? SquareFormat::raw16 : SquareFormat::raw32, bytes);
    }
};

// Opaque where nx * x + ny * y > d.
struct HalfPlane {
    double nx, ny, d;

    [[nodiscard]] bool at(double x, double y) const { return nx * x + ny * y > d; }
    [[nodiscard]] Square square(unsigned side) const {
        Square square(side);
        for (unsigned y = 0; y < side; ++y) {
            for (unsigned x = 0; x < side; ++x) {
                unsigned inside = 0;
                for (unsigned corner = 0; corner < 4; ++corner) {
                    const double cornerX = (x + corner % 2) * 1.0 / side;
                    const double cornerY = (y + corner / 2) * 1.0 / side;
                    inside += at(cornerX, cornerY) ? 1 : 0;
                }
                square.at(x, y) = inside == 4   ? Region::opaque
                                  : inside == 0 ? Region::transparent
                                                : Region::mixed;
            }
        }
        return square;
    }
};

TEST(TwoState, KnownRegionsStay) {
    std::mt19937 random(1);
    const Stored stored(leafySquare(16, random));
    for (int k = 0; k < 2000; ++k) {
        const float u = static_cast<float>(random() % 1024) / 1024;
        const float v = static_cast<float>(random() % 1024) / 1024;
        const Region region = stored.reader.at(0, Half::first, u, v);
        if (region == Region::mixed) continue;
        for (const Neighbourhood n : {Neighbourhood::two, Neighbourhood::three}) {
            EXPECT_EQ(isHit(stored.reader, 0, Half::first, u, v, n), region == Region::opaque);
        }
    }
}

TEST(TwoState, HitsAreAsFrequentAsTheirChance) {
    std::mt19937 random(2);
    const Stored stored(leafySquare(16, random));
    for (const Neighbourhood n : {Neighbourhood::two, Neighbourhood::three}) {
        double chance = 0;
        double hits = 0;
        const int count = 100000;
        for (int k = 0; k < count; ++k) {
            const float u = static_cast<float>(random() >> 8) * 0x1p-24F;
            const float v = static_cast<float>(random() >> 8) * 0x1p-24F;
            chance += opaqueChance(stored.reader, 0, Half::second, u, v, n);
            hits += isHit(stored.reader, 0, Half::second, u, v, n) ? 1 : 0;
        }
        // Four standard deviations of as many coins.
        EXPECT_NEAR(hits / count, chance / count, 4 * 0.5 / std::sqrt(count));
    }
}

// Along straight outlines of any direction the mean chance is the true coverage of the mixed regions.
TEST(TwoState, StraightOutlinesAreUnbiased) {
    std::mt19937 random(3);
    for (const Neighbourhood n : {Neighbourhood::two, Neighbourhood::three}) {
        double bias = 0;
        uint64_t count = 0;
        for (int k = 0; k < 400; ++k) {
            const double angle = k * 0.0157;
            const HalfPlane plane{std::cos(angle), std::sin(angle),
                                  0.5 * (std::cos(angle) + std::sin(angle)) +
                                      0.3 * (static_cast<double>(random() % 4096) / 2048 - 1)};
            const Stored stored(plane.square(16));
            for (int point = 0; point < 500; ++point) {
                const float u = static_cast<float>(random() >> 8) * 0x1p-24F;
                const float v = static_cast<float>(random() >> 8) * 0x1p-24F;
                if (stored.reader.at(0, Half::first, u, v) != Region::mixed) continue;
                ++count;
                bias += static_cast<double>(opaqueChance(stored.reader, 0, Half::first, u, v, n)) -
                        (plane.at(static_cast<double>(u), static_cast<double>(v)) ? 1 : 0);
            }
        }
        ASSERT_GT(count, 10000u);
        EXPECT_NEAR(bias / static_cast<double>(count), 0, 0.015);
    }
}

TEST(TwoState, HashesAreUniform) {
    std::array<unsigned, 16> bins{};
    const unsigned side = 256;
    for (unsigned k = 0; k < side * side; ++k) {
        const float hash =
            hashOf(static_cast<float>(k % side) / side, static_cast<float>(k / side) / side, 0);
        ASSERT_GE(hash, 0.0F);
        ASSERT_LT(hash, 1.0F);
        ++bins[static_cast<size_t>(hash * 16)];
    }
    for (const unsigned bin : bins) EXPECT_NEAR(bin, side * side / 16, 4 * std::sqrt(side * side / 16));
}

}  // namespace
}  // namespace filigree::quadmap
