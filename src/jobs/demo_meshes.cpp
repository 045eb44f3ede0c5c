#include "jobs/demo_meshes.h"

#include "jobs/random.h"

#include <cmath>
#include <numbers>

namespace filigree::jobs {
namespace {

// The part of a texture that a card shows; v grows downward.
struct UvBox {
    float u0, v0, u1, v1;
};

uint32_t addVertex(Geometry& g, const Vec3& position, const Vec3& normal, mesh::Uv uv) {
    g.positions.push_back(position);
    g.normals.push_back(normal);
    g.uvs.push_back(uv);
    return static_cast<uint32_t>(g.positions.size() - 1);
}

void addTriangle(Geometry& g, uint32_t a, uint32_t b, uint32_t c) {
    g.indices.insert(g.indices.end(), {a, b, c});
}

void addQuad(Geometry& g, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    addTriangle(g, a, b, c);
    addTriangle(g, a, c, d);
}

// A card with its foot's middle at `foot`, `right` being half its width and `up` its height.
void addCard(Geometry& g, const Vec3& foot, const Vec3& right, const Vec3& up, const UvBox& uv) {
    const Vec3 normal = normalised(cross(right, up));
    const Vec3 head = plus(foot, up);
    const uint32_t a = addVertex(g, minus(foot, right), normal, {uv.u0, uv.v1});
    const uint32_t b = addVertex(g, plus(foot, right), normal, {uv.u1, uv.v1});
    const uint32_t c = addVertex(g, plus(head, right), normal, {uv.u1, uv.v0});
    const uint32_t d = addVertex(g, minus(head, right), normal, {uv.u0, uv.v0});
    addQuad(g, a, b, c, d);
}

// A ring of `sides` vertices about the axis at `centre`; texture coordinates are left out of wood and metal.
uint32_t addRing(Geometry& g, const Vec3& centre, const Vec3& x, const Vec3& y, float radius, size_t sides) {
    const auto first = static_cast<uint32_t>(g.positions.size());
    for (size_t i = 0; i < sides; ++i) {
        const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(sides);
        const Vec3 out = plus(times(x, std::cos(angle)), times(y, std::sin(angle)));
        g.positions.push_back(plus(centre, times(out, radius)));
        g.normals.push_back(normalised(out));
    }
    return first;
}

void joinRings(Geometry& g, uint32_t lower, uint32_t upper, uint32_t sides) {
    for (uint32_t i = 0; i < sides; ++i) {
        const uint32_t next = (i + 1) % sides;
        addQuad(g, lower + i, lower + next, upper + next, upper + i);
    }
}

UvBox quarterOf(size_t species) {
    const float u = 0.5F * static_cast<float>(species % 2);
    const float v = 0.5F * static_cast<float>(species / 2);
    return {u, v, u + 0.5F, v + 0.5F};
}

UvBox mirrored(const UvBox& uv) {
    return {uv.u1, uv.v0, uv.u0, uv.v1};
}

// Where a frond is at t from root to tip, and which way its upper side looks.
struct FrondPlace {
    Vec3 centre;
    Vec3 normal;
};

FrondPlace frondPlace(float heading, float length, float t) {
    const Vec3 out{std::sin(heading), 0, std::cos(heading)};
    const float rise = 0.75F * t - 0.72F * t * t;
    const float slope = 0.75F - 1.44F * t;
    const Vec3 centre{out[0] * t * length * 0.85F, rise * length * 1.3F + 0.02F, out[2] * t * length * 0.85F};
    return {centre, normalised({-out[0] * slope, 1, -out[2] * slope})};
}

void addFrond(Geometry& g, float heading, float length) {
    constexpr uint32_t rows = 8;
    constexpr uint32_t columns = 2;
    const Vec3 side{std::cos(heading), 0, -std::sin(heading)};
    const auto first = static_cast<uint32_t>(g.positions.size());
    for (uint32_t row = 0; row <= rows; ++row) {
        const float t = static_cast<float>(row) / rows;
        const FrondPlace place = frondPlace(heading, length, t);
        for (uint32_t column = 0; column <= columns; ++column) {
            const float u = static_cast<float>(column) / columns;
            const Vec3 at = plus(place.centre, times(side, (u - 0.5F) * 0.5F * length));
            addVertex(g, at, place.normal, {u, 1 - t});
        }
    }
    for (uint32_t row = 0; row < rows; ++row) {
        for (uint32_t column = 0; column < columns; ++column) {
            const uint32_t a = first + row * (columns + 1) + column;
            addQuad(g, a, a + 1, a + columns + 2, a + columns + 1);
        }
    }
}

// A six-sided card, cut close to the blossom.
void addHexagon(Geometry& g, const Vec3& centre, const Vec3& x, const Vec3& y) {
    const Vec3 normal = normalised(cross(x, y));
    const uint32_t middle = addVertex(g, centre, normal, {0.5F, 0.5F});
    for (uint32_t i = 0; i < 6; ++i) {
        const float angle = (static_cast<float>(i) + 0.5F) * std::numbers::pi_v<float> / 3;
        const float cx = std::cos(angle);
        const float cy = std::sin(angle);
        const Vec3 at = plus(centre, plus(times(x, cx), times(y, cy)));
        addVertex(g, at, normal, {0.5F + 0.5F * cx, 0.5F - 0.5F * cy});
    }
    for (uint32_t i = 0; i < 6; ++i) addTriangle(g, middle, middle + 1 + i, middle + 1 + (i + 1) % 6);
}

Vec3 groundNormal(float x, float z) {
    constexpr float step = 0.05F;
    const float dx = (groundHeight(x + step, z) - groundHeight(x - step, z)) / (2 * step);
    const float dz = (groundHeight(x, z + step) - groundHeight(x, z - step)) / (2 * step);
    return normalised({-dx, 1, -dz});
}

// Grass in the hollows, bare earth on the humps; it multiplies the material's colour.
Vec3 groundColour(float x, float z) {
    const float patch = 0.5F + 0.5F * std::sin(1.7F * x + 2.0F * std::sin(0.9F * z)) * std::sin(1.3F * z);
    const float bare = std::fmin(1.0F, std::fmax(0.0F, 0.55F * patch + 0.5F * groundHeight(x, z)));
    const Vec3 grass{0.45F, 0.75F, 0.35F};
    const Vec3 earth{0.95F, 0.65F, 0.70F};
    return plus(times(grass, 1 - bare), times(earth, bare));
}

}  // namespace

Branch branchMesh(size_t species) {
    constexpr float length = 1.5F;
    constexpr uint32_t sides = 5;
    Branch branch;
    const uint32_t lower = addRing(branch.wood, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.045F, sides);
    const uint32_t upper = addRing(branch.wood, {0, 0, length * 0.9F}, {1, 0, 0}, {0, 1, 0}, 0.01F, sides);
    joinRings(branch.wood, lower, upper, sides);

    Random random(100 + species);
    const auto uniform = [&](double lo, double hi) { return static_cast<float>(random.uniform(lo, hi)); };
    constexpr int twigs = 14;
    for (int i = 0; i < twigs; ++i) {
        const float t = 0.15F + 0.8F * static_cast<float>(i) / twigs;
        const float turn = 2.4F * static_cast<float>(i) + uniform(-0.3, 0.3);
        const Vec3 out = normalised({std::cos(turn), std::sin(turn), uniform(0.5, 1.1)});
        const Vec3 right = normalised(cross(out, {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}));
        const float size = uniform(0.55, 0.8);
        const UvBox uv = i % 2 == 0 ? quarterOf(species) : mirrored(quarterOf(species));
        addCard(branch.leaves, {0, 0, length * t}, times(right, size / 2), times(out, size), uv);
    }
    addCard(branch.leaves, {0, 0, length * 0.8F}, {0.35F, 0, 0}, {0, 0.1F, 0.7F}, quarterOf(species));
    return branch;
}

Geometry trunkMesh(float height, float radius) {
    constexpr uint32_t sides = 9;
    constexpr uint32_t rings = 6;
    Geometry g;
    uint32_t below = 0;
    for (uint32_t i = 0; i <= rings; ++i) {
        const float t = static_cast<float>(i) / rings;
        const Vec3 centre{0.12F * std::sin(2.2F * t), height * t - 0.3F, 0.1F * std::sin(3.1F * t)};
        const float flare = 0.5F * (1 - t) * (1 - t) * (1 - t);
        const uint32_t ring =
            addRing(g, centre, {0, 0, 1}, {1, 0, 0}, radius * (1 - 0.75F * t + flare), sides);
        if (i > 0) joinRings(g, below, ring, sides);
        below = ring;
    }
    return g;
}

Geometry fernMesh() {
    Geometry g;
    Random random(200);
    for (int i = 0; i < 8; ++i) {
        const auto heading = static_cast<float>(i * 2.4 + random.uniform(-0.2, 0.2));
        addFrond(g, heading, static_cast<float>(random.uniform(0.65, 0.95)));
    }
    return g;
}

Geometry grassMesh() {
    Geometry g;
    for (int i = 0; i < 3; ++i) {
        const float angle = static_cast<float>(i) * std::numbers::pi_v<float> / 3;
        const Vec3 right{0.4F * std::cos(angle), 0, 0.4F * std::sin(angle)};
        addCard(g, {0.06F * std::sin(angle * 5), -0.02F, 0}, right, {0, 0.4F, 0}, {0, 0, 1, 1});
    }
    return g;
}

Geometry blossomMesh() {
    Geometry g;
    addHexagon(g, {0, 0.34F, 0}, {0.07F, 0, 0}, {0, 0.03F, -0.063F});
    addHexagon(g, {0.16F, 0.25F, 0.06F}, {0.05F, 0.02F, 0}, {0, 0.03F, -0.05F});
    addHexagon(g, {-0.12F, 0.28F, 0.09F}, {0.05F, -0.02F, 0.01F}, {0, 0.04F, -0.04F});
    return g;
}

Geometry fenceMesh() {
    constexpr float tile = 0.125F;  // m a mesh of the wire
    constexpr float width = 2;
    constexpr float height = 1.5F;
    Geometry g;
    constexpr uint32_t columns = 4;
    constexpr uint32_t rows = 3;
    for (uint32_t row = 0; row <= rows; ++row) {
        for (uint32_t column = 0; column <= columns; ++column) {
            const float x = width * static_cast<float>(column) / columns;
            const float y = height * static_cast<float>(row) / rows;
            addVertex(g, {x, y + 0.08F, 0}, {0, 0, 1}, {x / tile, (height - y) / tile});
        }
    }
    for (uint32_t row = 0; row < rows; ++row) {
        for (uint32_t column = 0; column < columns; ++column) {
            const uint32_t a = row * (columns + 1) + column;
            addQuad(g, a, a + 1, a + columns + 2, a + columns + 1);
        }
    }
    return g;
}

Geometry postMesh() {
    constexpr uint32_t sides = 8;
    Geometry g;
    const uint32_t lower = addRing(g, {0, -0.4F, 0}, {0, 0, 1}, {1, 0, 0}, 0.035F, sides);
    const uint32_t upper = addRing(g, {0, 1.65F, 0}, {0, 0, 1}, {1, 0, 0}, 0.035F, sides);
    joinRings(g, lower, upper, sides);
    const uint32_t rim = addRing(g, {0, 1.65F, 0}, {0, 0, 1}, {1, 0, 0}, 0.035F, sides);
    for (uint32_t i = 0; i < sides; ++i) g.normals[rim + i] = {0, 1, 0};
    for (uint32_t i = 1; i + 1 < sides; ++i) addTriangle(g, rim, rim + i, rim + i + 1);
    return g;
}

float groundHeight(float x, float z) {
    const float hills = 0.45F * std::sin(0.31F * x + 0.4F) * std::sin(0.27F * z);
    const float humps =
        0.11F * std::sin(1.1F * x + 1.3F * std::sin(0.7F * z)) + 0.07F * std::sin(1.9F * z - 0.8F * x);
    const float grain = 0.018F * std::sin(5.3F * x + 2 * std::sin(4.1F * z)) * std::sin(4.7F * z);
    return hills + humps + grain;
}

Geometry groundMesh(float size, size_t cells) {
    Geometry g;
    const auto row = static_cast<uint32_t>(cells + 1);
    for (uint32_t i = 0; i < row * row; ++i) {
        const float x = size * (static_cast<float>(i % row) / static_cast<float>(cells) - 0.5F);
        const float z = size * (static_cast<float>(i / row) / static_cast<float>(cells) - 0.5F);
        g.positions.push_back({x, groundHeight(x, z), z});
        g.normals.push_back(groundNormal(x, z));
        g.colours.push_back(groundColour(x, z));
    }
    for (uint32_t j = 0; j + 1 < row; ++j) {
        for (uint32_t i = 0; i + 1 < row; ++i) {
            const uint32_t a = j * row + i;
            addQuad(g, a, a + row, a + row + 1, a + 1);
        }
    }
    return g;
}

}  // namespace filigree::jobs
