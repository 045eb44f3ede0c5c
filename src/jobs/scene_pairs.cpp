#include "jobs/scene_pairs.h"

#include <array>
#include <bit>
#include <set>

namespace filigree::jobs {
namespace {

quadmap::HalfTriangle inSquare(const scene::Primitive& primitive, const mesh::PairedTriangle& paired) {
    const mesh::UvTriangle triangle = primitive.uvTriangle(paired.triangle);
    return {mesh::inOrder(triangle.uv, paired), mesh::inOrder(triangle.alpha, paired)};
}

// Bit patterns, so that NaN equals itself and 0 differs from -0. The last says whether there is a second.
std::array<uint32_t, 19> kindOf(const SquarePair& pair) {
    std::array<uint32_t, 19> kind{};
    size_t next = 0;
    const auto add = [&](const quadmap::HalfTriangle& half) {
        for (size_t k = 0; k < 3; ++k) {
            for (const float value : {half.uv[k].u, half.uv[k].v, half.alpha[k]})
                kind[next++] = std::bit_cast<uint32_t>(value);
        }
    };
    add(pair.first);
    if (pair.second) add(*pair.second);
    kind.back() = pair.second ? 1 : 0;
    return kind;
}

PairedPrimitive paired(const scene::Primitive& primitive) {
    return {&primitive, mesh::pairTriangles({primitive.positions, primitive.uvs, primitive.indices})};
}

}  // namespace

std::vector<PairGroup> pairGroups(const scene::Scene& scene, std::optional<double> cutoff, double guard) {
    std::vector<ConstAlphaGroup> groups;
    for (const auto& mesh : scene.meshes) {
        for (const auto& primitive : mesh.primitives) {
            if (primitive.material < 0 || primitive.triangleCount() == 0) continue;
            const auto& material = scene.materials[static_cast<size_t>(primitive.material)];
            if (material.alphaMode != scene::AlphaMode::mask) continue;
            AlphaSource source = sourceOf(material);
            source.test.cutoff = cutoff.value_or(source.test.cutoff);
            source.test.guard = guard;
            addToGroup(groups, source, primitive);
        }
    }
    std::vector<PairGroup> pairs;
    for (const ConstAlphaGroup& group : groups) {
        PairGroup& out = pairs.emplace_back(PairGroup{group.source, {}});
        for (const scene::Primitive* primitive : group.primitives)
            out.primitives.push_back(paired(*primitive));
    }
    return pairs;
}

SquarePair squarePair(const scene::Primitive& primitive, const mesh::TrianglePair& pair) {
    SquarePair square{inSquare(primitive, pair.first), {}};
    if (pair.second) square.second = inSquare(primitive, *pair.second);
    return square;
}

std::vector<SquarePair> distinctPairs(const PairGroup& group) {
    std::vector<SquarePair> pairs;
    std::set<std::array<uint32_t, 19>> seen;
    for (const PairedPrimitive& primitive : group.primitives) {
        for (const mesh::TrianglePair& pair : primitive.pairs) {
            SquarePair square = squarePair(*primitive.primitive, pair);
            if (seen.insert(kindOf(square)).second) pairs.push_back(square);
        }
    }
    return pairs;
}

}  // namespace filigree::jobs
