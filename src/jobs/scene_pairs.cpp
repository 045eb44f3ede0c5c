#include "jobs/scene_pairs.h"

#include "jobs/bake_stages.h"

#include <array>
#include <bit>
#include <map>

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

std::vector<PairGroup> pairGroups(const scene::Scene& scene, const BakeParameters& parameters) {
    std::vector<ConstAlphaGroup> groups;
    for (const auto& mesh : scene.meshes) {
        for (const auto& primitive : mesh.primitives) {
            if (primitive.material < 0 || primitive.triangleCount() == 0) continue;
            const auto& material = scene.materials[static_cast<size_t>(primitive.material)];
            if (!isBaked(material, parameters)) continue;
            addToGroup(groups, sourceToBake(material, parameters), primitive);
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

DistinctPairs distinctPairs(const PairGroup& group) {
    DistinctPairs distinct;
    std::map<std::array<uint32_t, 19>, uint32_t> seen;
    for (const PairedPrimitive& primitive : group.primitives) {
        std::vector<uint32_t>& of = distinct.of.emplace_back();
        for (const mesh::TrianglePair& pair : primitive.pairs) {
            SquarePair square = squarePair(*primitive.primitive, pair);
            const auto next = static_cast<uint32_t>(distinct.pairs.size());
            const auto [place, isNew] = seen.try_emplace(kindOf(square), next);
            if (isNew) distinct.pairs.push_back(square);
            of.push_back(place->second);
        }
    }
    return distinct;
}

}  // namespace filigree::jobs
