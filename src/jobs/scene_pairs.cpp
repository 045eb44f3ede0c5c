#include "jobs/scene_pairs.h"

#include "jobs/bake_stages.h"

namespace filigree::jobs {
namespace {

quadmap::HalfTriangle inSquare(const scene::Primitive& primitive, const mesh::PairedTriangle& paired) {
    return quadmap::inSquare(primitive.uvTriangle(paired.triangle), paired);
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
    quadmap::DistinctPairs kinds;
    for (const PairedPrimitive& primitive : group.primitives) {
        std::vector<uint32_t>& of = distinct.of.emplace_back();
        for (const mesh::TrianglePair& pair : primitive.pairs)
            of.push_back(kinds.add(squarePair(*primitive.primitive, pair)));
    }
    distinct.pairs = kinds.pairs();
    return distinct;
}

}  // namespace filigree::jobs
