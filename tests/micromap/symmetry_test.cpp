#include "filigree/micromap/symmetry.h"

#include "filigree/micromap/quadtree.h"

#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace filigree::micromap {
namespace {

TEST(Symmetry, PlanesAndCurveIndexAreInverse) {
    for (unsigned level = 0; level <= 7; ++level) {
        for (uint32_t index = 0; index < (1u << (2 * level)); ++index) {
            ASSERT_EQ(indexOfPlanes(planesOfIndex(index, level), level), index) << "level " << level;
        }
    }
}

TEST(Symmetry, PlanesOfAPointAreThoseOfItsIndex) {
    for (unsigned level = 0; level <= 12; ++level) {
        for (int i = 0; i <= 40; ++i) {
            for (int j = 0; i + j <= 40; ++j) {
                const float u = static_cast<float>(i) / 40;
                const float v = static_cast<float>(j) / 40;
                ASSERT_EQ(planesOf(curveCoordinates(u, v, level), level),
                          planesOfIndex(barycentricsToIndex(u, v, level), level));
            }
        }
    }
}

TEST(Symmetry, DigitsOfChildrenFollowTheCurve) {
    for (uint32_t index = 0; index < 1024; ++index) {
        Planes p;
        bool odd = false;
        for (unsigned k = 5; k-- > 0;) {
            const unsigned child = (index >> (2 * k)) & 3;
            const unsigned digit = digitOfChild(child, odd);
            p.a |= (digit >> 1) << k;
            p.b |= (digit & 1) << k;
            odd ^= child % 2 == 1;
        }
        ASSERT_EQ(p, planesOfIndex(index, 5));
    }
}

TEST(Symmetry, TheSixAreDifferentPermutationsOfTheCorners) {
    std::set<std::vector<unsigned>> seen;
    for (unsigned s = 0; s < symmetryCount; ++s) {
        EXPECT_EQ(turnedDigit(0, s), 0u);
        std::vector<unsigned> to{turnedDigit(1, s), turnedDigit(2, s), turnedDigit(3, s)};
        EXPECT_EQ(std::set<unsigned>(to.begin(), to.end()), (std::set<unsigned>{1, 2, 3}));
        seen.insert(to);
    }
    EXPECT_EQ(seen.size(), 6u);
    EXPECT_EQ(turned({5, 9}, 0), (Planes{5, 9}));
}

// Each symmetry of the digits is an order of the vertices.
TEST(Symmetry, TurningEqualsPermutingTheVertices) {
    constexpr unsigned level = 3;
    for (unsigned s = 0; s < symmetryCount; ++s) {
        std::vector<uint8_t> flat(flatBytes(level, Format::fourState));
        for (size_t k = 0; k < flat.size(); ++k) flat[k] = static_cast<uint8_t>(k * 37 + 11);
        const Quadtree tree = quadtreeFromFlat(flat, level, Format::fourState);
        unsigned matches = 0;
        for (const VertexOrder& order :
             {VertexOrder{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}) {
            const Quadtree other = permuted(tree.view(), order);
            std::vector<uint8_t> permutedFlat(flat.size());
            writeFlat(other.view(), Format::fourState, permutedFlat);
            bool equal = true;
            for (uint32_t i = 0; i < 64 && equal; ++i) {
                const uint32_t j = indexOfPlanes(turned(planesOfIndex(i, level), s), level);
                const auto at = [](const std::vector<uint8_t>& f, uint32_t k) {
                    return (f[k / 4] >> (2 * (k % 4))) & 3;
                };
                equal = at(flat, i) == at(permutedFlat, j);
            }
            matches += equal ? 1 : 0;
        }
        EXPECT_EQ(matches, 1u) << "symmetry " << s;
    }
}

}  // namespace
}  // namespace filigree::micromap
