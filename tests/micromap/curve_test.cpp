#include "filigree/micromap/curve.h"

#include "filigree/micromap/curve_batch.h"
#include "filigree/micromap/symmetry.h"

#include "shared_data.h"

#include <algorithm>
#include <bit>
#include <fstream>
#include <limits>
#include <sstream>
#include <vector>

#include <gtest/gtest.h>

namespace filigree::micromap {
namespace {

TEST(Curve, IndexAndLatticeAreInverse) {
    for (unsigned level = 0; level <= 8; ++level) {
        for (uint32_t index = 0; index < (1u << (2 * level)); ++index) {
            const LatticeTriangle t = latticeTriangle(index, level);
            ASSERT_EQ(curveIndex(t, level), index) << "level " << level;
        }
    }
}

// The corners of the children of children, as the curve orders them.
TEST(Curve, LatticeFollowsTheChildren) {
    constexpr unsigned level = 6;
    const auto midpoint = [](LatticePoint a, LatticePoint b) {
        return LatticePoint{(a.i + b.i) / 2, (a.j + b.j) / 2};
    };
    for (uint32_t index = 0; index < (1u << (2 * level)); ++index) {
        std::array<LatticePoint, 3> expected{{{0, 0}, {64, 0}, {0, 64}}};
        for (unsigned k = level; k-- > 0;)
            expected = childCorners(expected, (index >> (2 * k)) & 3, midpoint);
        auto found = corners(latticeTriangle(index, level));
        EXPECT_TRUE(std::ranges::is_permutation(found, expected)) << index;
    }
}

TEST(Curve, NeighboursOnTheCurveShareACorner) {
    for (unsigned level = 1; level <= 7; ++level) {
        for (uint32_t index = 0; index + 1 < (1u << (2 * level)); ++index) {
            const auto a = corners(latticeTriangle(index, level));
            const auto b = corners(latticeTriangle(index + 1, level));
            bool shared = false;
            for (const LatticePoint p : a) {
                for (const LatticePoint q : b) shared |= p == q;
            }
            ASSERT_TRUE(shared) << "level " << level << " index " << index;
        }
    }
}

TEST(Curve, PointInsideAMicroTriangleFindsIt) {
    for (unsigned level = 0; level <= 6; ++level) {
        const float n = static_cast<float>(1u << level);
        for (uint32_t index = 0; index < (1u << (2 * level)); ++index) {
            float u = 0;
            float v = 0;
            for (const LatticePoint p : corners(latticeTriangle(index, level))) {
                u += static_cast<float>(p.i) / (3 * n);
                v += static_cast<float>(p.j) / (3 * n);
            }
            ASSERT_EQ(barycentricsToIndex(u, v, level), index);
        }
    }
}

TEST(Curve, AgreesWithTheReferenceVectors) {
    FILIGREE_NEEDS_SHARED_DATA();
    std::ifstream file(tests::sharedData() / "golden" / "barycentric_to_index.csv");
    ASSERT_TRUE(file);
    std::string line;
    std::getline(file, line);
    size_t rows = 0;
    for (; std::getline(file, line); ++rows) {
        std::istringstream fields(line);
        unsigned level = 0;
        uint32_t u = 0;
        uint32_t v = 0;
        uint32_t index = 0;
        char comma = 0;
        fields >> level >> comma >> std::hex >> u >> comma >> v >> comma >> std::dec >> index;
        ASSERT_EQ(barycentricsToIndex(std::bit_cast<float>(u), std::bit_cast<float>(v), level), index)
            << line;
    }
    EXPECT_GT(rows, 1000u);
}

// Points on and off the lattices of many levels, inside, outside and on the border.
TEST(Curve, BatchEqualsOneByOne) {
    std::vector<float> u;
    std::vector<float> v;
    std::vector<uint32_t> levels;
    for (int i = -3; i < 70; ++i) {
        for (int j = -3; j < 70; ++j) {
            u.push_back(static_cast<float>(i) / 64.0f + (i % 5 == 0 ? 0.003f : 0.0f));
            v.push_back(static_cast<float>(j) / 64.0f + (j % 7 == 0 ? 0.001f : 0.0f));
            levels.push_back(static_cast<uint32_t>((i + 3) * 70 + j + 3) % 16);
        }
    }
    u.back() = std::numeric_limits<float>::quiet_NaN();
    std::vector<uint32_t> indices(u.size());
    barycentricsToIndex(u, v, levels, indices);
    for (size_t k = 0; k < u.size(); ++k) {
        ASSERT_EQ(indices[k], barycentricsToIndex(u[k], v[k], levels[k])) << u[k] << " " << v[k];
    }
    std::vector<uint32_t> a(u.size());
    std::vector<uint32_t> b(u.size());
    barycentricsToPlanes(u, v, levels, a, b);
    for (size_t k = 0; k < u.size(); ++k) {
        ASSERT_EQ((Planes{a[k], b[k]}), planesOfIndex(indices[k], levels[k])) << u[k] << " " << v[k];
    }
}

}  // namespace
}  // namespace filigree::micromap
