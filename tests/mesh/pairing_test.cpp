// Pairings against every pairing there is, on small meshes, and on patterns.
#include "filigree/mesh/pairing.h"

#include "mesh/matching.h"

#include <algorithm>
#include <limits>
#include <random>
#include <set>

#include <gtest/gtest.h>

namespace filigree::mesh {
namespace {

struct Mesh {
    std::vector<std::array<float, 3>> positions;
    std::vector<Uv> uvs;
    std::vector<uint32_t> indices;

    void add(uint32_t a, uint32_t b, uint32_t c) { indices.insert(indices.end(), {a, b, c}); }
    [[nodiscard]] std::vector<TrianglePair> pairs() const { return pairTriangles({positions, uvs, indices}); }
};

size_t singles(const std::vector<TrianglePair>& pairs) {
    return static_cast<size_t>(std::ranges::count_if(pairs, [](const auto& p) { return !p.second; }));
}

// Each triangle stands in one pair, and pairs share the edge that they say.
void expectSound(const Mesh& mesh, const std::vector<TrianglePair>& pairs) {
    std::set<uint32_t> seen;
    const auto at = [&](const PairedTriangle& t, size_t k) {
        return mesh.positions[mesh.indices[3 * t.triangle + t.order[k]]];
    };
    for (const TrianglePair& p : pairs) {
        EXPECT_TRUE(seen.insert(p.first.triangle).second);
        const auto& order = p.first.order;
        EXPECT_EQ(order[1], (order[0] + 1) % 3);
        EXPECT_EQ(order[2], (order[0] + 2) % 3);
        if (!p.second) continue;
        EXPECT_TRUE(seen.insert(p.second->triangle).second);
        EXPECT_LT(p.first.triangle, p.second->triangle);
        EXPECT_EQ(at(p.first, 1), at(*p.second, 2));
        EXPECT_EQ(at(p.first, 2), at(*p.second, 1));
    }
    EXPECT_EQ(seen.size(), mesh.indices.size() / 3);
}

// A grid of quads, two triangles each.
Mesh gridOf(uint32_t columns, uint32_t rows) {
    Mesh mesh;
    for (uint32_t y = 0; y <= rows; ++y) {
        for (uint32_t x = 0; x <= columns; ++x) {
            mesh.positions.push_back({static_cast<float>(x), static_cast<float>(y), 0});
            mesh.uvs.push_back({static_cast<float>(x), static_cast<float>(y)});
        }
    }
    for (uint32_t y = 0; y < rows; ++y) {
        for (uint32_t x = 0; x < columns; ++x) {
            const uint32_t a = y * (columns + 1) + x;
            mesh.add(a, a + 1, a + columns + 1);
            mesh.add(a + columns + 2, a + columns + 1, a + 1);
        }
    }
    return mesh;
}

// The greatest weight of any matching of the edges from `from` on.
int64_t bestWeight(const std::vector<WeightedEdge>& edges, size_t from, uint32_t used) {
    if (from == edges.size()) return 0;
    const WeightedEdge& e = edges[from];
    int64_t best = bestWeight(edges, from + 1, used);
    const uint32_t both = (1U << e.a) | (1U << e.b);
    if ((used & both) == 0) best = std::max(best, e.weight + bestWeight(edges, from + 1, used | both));
    return best;
}

TEST(Matching, IsTheBestThereIs) {
    std::mt19937 random(7);
    for (int round = 0; round < 400; ++round) {
        const uint32_t nodes = 2 + random() % 8;
        std::set<std::pair<uint32_t, uint32_t>> places;
        for (uint32_t k = random() % 14; k > 0; --k) {
            const uint32_t a = random() % nodes;
            const uint32_t b = random() % nodes;
            if (a != b) places.insert(std::minmax(a, b));
        }
        std::vector<WeightedEdge> edges;
        for (const auto& [a, b] : places) edges.push_back({a, b, int64_t(1000 + random() % 500)});
        int64_t weight = 0;
        uint32_t used = 0;
        for (const size_t k : maximumWeightMatching(nodes, edges)) {
            const uint32_t both = (1U << edges[k].a) | (1U << edges[k].b);
            EXPECT_EQ(used & both, 0u);
            used |= both;
            weight += edges[k].weight;
        }
        EXPECT_EQ(weight, bestWeight(edges, 0, 0)) << round;
    }
}

// The most pairs that any matching of the triangles' common edges has.
int64_t mostPairs(const Mesh& mesh) {
    std::vector<WeightedEdge> edges;
    const auto n = static_cast<uint32_t>(mesh.indices.size() / 3);
    for (uint32_t a = 0; a < n; ++a) {
        for (uint32_t b = a + 1; b < n; ++b) {
            size_t common = 0;
            for (size_t k = 0; k < 9; ++k)
                common += mesh.indices[3 * a + k / 3] == mesh.indices[3 * b + k % 3] ? 1 : 0;
            if (common >= 2) edges.push_back({a, b, 1});
        }
    }
    return bestWeight(edges, 0, 0);
}

TEST(Pairing, LeavesAsFewSinglesAsPossible) {
    std::mt19937 random(3);
    for (int round = 0; round < 300; ++round) {
        Mesh mesh;
        const uint32_t vertices = 4 + random() % 5;
        for (uint32_t v = 0; v < vertices; ++v) {
            mesh.positions.push_back({float(random() % 64), float(random() % 64), float(v)});
            mesh.uvs.push_back({float(random() % 4), float(random() % 4)});
        }
        const uint32_t triangles = 1 + random() % 7;
        for (uint32_t t = 0; t < triangles; ++t) {
            const uint32_t a = random() % vertices;
            const uint32_t b = (a + 1 + random() % (vertices - 1)) % vertices;
            uint32_t c = random() % vertices;
            while (c == a || c == b) c = (c + 1) % vertices;
            mesh.add(a, b, c);
        }
        const auto pairs = mesh.pairs();
        expectSound(mesh, pairs);
        EXPECT_EQ(singles(pairs), triangles - 2 * static_cast<size_t>(mostPairs(mesh))) << round;
    }
}

TEST(Pairing, TakesTheQuadsOfAGrid) {
    const Mesh mesh = gridOf(9, 7);
    const auto pairs = mesh.pairs();
    expectSound(mesh, pairs);
    ASSERT_EQ(pairs.size(), 63u);
    for (size_t k = 0; k < pairs.size(); ++k) {
        EXPECT_EQ(pairs[k].first, (PairedTriangle{static_cast<uint32_t>(2 * k), {0, 1, 2}}));
        EXPECT_EQ(pairs[k].second, (PairedTriangle{static_cast<uint32_t>(2 * k + 1), {0, 1, 2}}));
    }
}

// A strip of four triangles, 0-1-2-3, each a vertex of its own at every corner.
Mesh loose() {
    Mesh mesh;
    const float corners[4][3][2] = {{{0, 0}, {1, 0}, {0, 1}},
                                    {{1, 0}, {1, 1}, {0, 1}},
                                    {{1, 0}, {2, 0}, {1, 1}},
                                    {{2, 0}, {2, 1}, {1, 1}}};
    for (const auto& triangle : corners) {
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        for (const auto& p : triangle) {
            mesh.positions.push_back({p[0], p[1], 0});
            mesh.uvs.push_back({p[0], p[1]});
        }
        mesh.add(first, first + 1, first + 2);
    }
    return mesh;
}

TEST(Pairing, PrefersContinuousTextureCoordinates) {
    Mesh mesh = loose();
    EXPECT_EQ(singles(mesh.pairs()), 0u);
    // Of three triangles one stays single: that beyond the seam.
    mesh.indices.resize(9);
    for (size_t k = 0; k < 3; ++k) mesh.uvs[k].u += 5;
    auto pairs = mesh.pairs();
    expectSound(mesh, pairs);
    ASSERT_EQ(pairs.size(), 2u);
    EXPECT_FALSE(pairs[0].second);
    EXPECT_EQ(pairs[1].second->triangle, 2u);
    // But a pair over a seam is better than none.
    mesh.indices.resize(6);
    pairs = mesh.pairs();
    EXPECT_EQ(pairs.size(), 1u);
}

TEST(Pairing, TurnsTheSecondWhereWindingsDisagree) {
    Mesh mesh = gridOf(1, 1);
    std::swap(mesh.indices[4], mesh.indices[5]);
    const auto pairs = mesh.pairs();
    expectSound(mesh, pairs);
    ASSERT_EQ(pairs.size(), 1u);
    EXPECT_EQ(pairs[0].second->order, (std::array<uint8_t, 3>{0, 2, 1}));
}

TEST(Pairing, PassesOverWhatHasNoEdge) {
    Mesh mesh;
    EXPECT_TRUE(mesh.pairs().empty());
    const float nan = std::numeric_limits<float>::quiet_NaN();
    mesh.positions = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {nan, 0, 0}};
    mesh.add(0, 1, 1);
    mesh.add(1, 0, 0);
    mesh.add(0, 3, 3);
    mesh.add(3, 0, 3);
    const auto pairs = mesh.pairs();
    expectSound(mesh, pairs);
    EXPECT_EQ(singles(pairs), 4u);
}

TEST(Pairing, ManyTrianglesInOneEdge) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}};
    for (uint32_t k = 0; k < 1001; ++k) {
        mesh.positions.push_back({0, 1, static_cast<float>(k)});
        mesh.add(0, 1, k + 2);
    }
    const auto pairs = mesh.pairs();
    expectSound(mesh, pairs);
    EXPECT_EQ(singles(pairs), 1u);
}

TEST(Pairing, LargeMeshes) {
    Mesh mesh = gridOf(250, 200);
    std::mt19937 random(1);
    for (size_t t = 0; t < mesh.indices.size() / 3; ++t) {  // holes
        if (random() % 10 == 0) std::fill_n(mesh.indices.begin() + static_cast<long>(3 * t), 3, 0u);
    }
    const auto pairs = mesh.pairs();
    expectSound(mesh, pairs);
    EXPECT_EQ(pairs, mesh.pairs());
}

}  // namespace
}  // namespace filigree::mesh
