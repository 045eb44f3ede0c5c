#include "filigree/micromap/quadtree.h"

#include "filigree/micromap/curve.h"

#include "micromap/random_micromap.h"

#include <array>

#include <gtest/gtest.h>

namespace filigree::micromap {
namespace {

using tests::randomFlat;

std::vector<uint8_t> flatOf(const QuadtreeView& tree, Format format = Format::fourState) {
    std::vector<uint8_t> flat(flatBytes(tree.level, format));
    writeFlat(tree, format, flat);
    return flat;
}

State stateAt(const std::vector<uint8_t>& flat, uint64_t index) {
    return static_cast<State>((flat[index / 4] >> (2 * (index % 4))) & 3);
}

TEST(Quadtree, FlatRoundTrip) {
    std::mt19937 random(7);
    for (unsigned level = 0; level <= 7; ++level) {
        for (const double stop : {0.0, 0.2, 0.6, 1.0}) {
            const std::vector<uint8_t> flat = randomFlat(level, stop, random);
            const Quadtree tree = quadtreeFromFlat(flat, level, Format::fourState);
            ASSERT_EQ(flatOf(tree.view()), flat) << "level " << level << " stop " << stop;
        }
    }
}

TEST(Quadtree, UniformIsOneLeaf) {
    for (unsigned level = 0; level <= 6; ++level) {
        for (unsigned state = 0; state < 4; ++state) {
            const std::vector<uint8_t> flat(flatBytes(level, Format::fourState),
                                            static_cast<uint8_t>(state * 0x55));
            const Quadtree tree = quadtreeFromFlat(flat, level, Format::fourState);
            ASSERT_TRUE(isUniform(tree.view()));
            ASSERT_EQ(uniformState(tree.view()), static_cast<State>(state));
        }
    }
}

TEST(Quadtree, TwoStateKeepsTheSide) {
    std::mt19937 random(8);
    const std::vector<uint8_t> flat = randomFlat(5, 0.3, random);
    const std::vector<uint8_t> two =
        flatOf(quadtreeFromFlat(flat, 5, Format::fourState).view(), Format::twoState);
    for (uint64_t k = 0; k < microTriangleCount(5); ++k) {
        ASSERT_EQ((two[k / 8] >> (k % 8)) & 1, isOpaqueSide(stateAt(flat, k)) ? 1 : 0);
    }
}

TEST(Quadtree, CoarserIsKnownOnlyWhereAllIsAlike) {
    std::mt19937 random(9);
    for (int round = 0; round < 20; ++round) {
        const std::vector<uint8_t> fine = randomFlat(5, 0.4, random);
        const Quadtree tree = quadtreeFromFlat(fine, 5, Format::fourState);
        for (unsigned level = 0; level <= 5; ++level) {
            const std::vector<uint8_t> coarse = flatOf(coarsened(tree.view(), level).view());
            const uint64_t part = microTriangleCount(5 - level);
            for (uint64_t k = 0; k < microTriangleCount(level); ++k) {
                bool alike = true;
                uint64_t opaque = 0;
                for (uint64_t m = k * part; m < (k + 1) * part; ++m) {
                    alike &= stateAt(fine, m) == stateAt(fine, k * part);
                    opaque += isOpaqueSide(stateAt(fine, m));
                }
                const State expected = alike ? stateAt(fine, k * part) : unknownOf(2 * opaque >= part);
                ASSERT_EQ(stateAt(coarse, k), expected);
            }
        }
    }
}

// A lattice place in another vertex order: barycentric weights move with their vertices.
LatticeTriangle moved(LatticeTriangle t, const VertexOrder& order, unsigned level) {
    const uint32_t n = 1u << level;
    const uint32_t k = n - 1 - t.i - t.j - (t.flipped ? 1 : 0);
    const std::array<uint32_t, 3> old{k, t.i, t.j};
    return {old[order[1]], old[order[2]], t.flipped};
}

TEST(Quadtree, PermutedMovesEveryMicroTriangle) {
    std::mt19937 random(10);
    std::array<uint8_t, 3> order{0, 1, 2};
    do {
        for (unsigned level = 0; level <= 5; ++level) {
            const std::vector<uint8_t> flat = randomFlat(level, 0.2, random);
            const Quadtree tree = quadtreeFromFlat(flat, level, Format::fourState);
            const std::vector<uint8_t> turned = flatOf(permuted(tree.view(), order).view());
            for (uint32_t k = 0; k < microTriangleCount(level); ++k) {
                const LatticeTriangle to = moved(latticeTriangle(k, level), order, level);
                ASSERT_EQ(stateAt(turned, curveIndex(to, level)), stateAt(flat, k)) << "level " << level;
            }
        }
    } while (std::next_permutation(order.begin(), order.end()));
}

TEST(Quadtree, EqualAndHashTellLevelsApart) {
    const std::vector<uint8_t> flat(flatBytes(3, Format::fourState), 0x55);
    const Quadtree a = quadtreeFromFlat(flat, 3, Format::fourState);
    const Quadtree b = quadtreeFromFlat(flat, 2, Format::fourState);
    EXPECT_FALSE(equal(a.view(), b.view()));
    EXPECT_NE(hash(a.view()), hash(b.view()));
    EXPECT_TRUE(equal(a.view(), a.view()));
}

}  // namespace
}  // namespace filigree::micromap
