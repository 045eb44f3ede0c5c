// The masked triangles of a scene as pairs, by alpha source.
#pragma once

#include "filigree/jobs/bake.h"
#include "filigree/mesh/pairing.h"
#include "filigree/quadmap/pairs.h"
#include "filigree/scene/scene.h"

#include "jobs/alpha_source.h"

#include <cstdint>
#include <vector>

namespace filigree::jobs {

using quadmap::SquarePair;

// A primitive and the pairs of its triangles.
struct PairedPrimitive {
    const scene::Primitive* primitive = nullptr;
    std::vector<mesh::TrianglePair> pairs;
};

// The primitives of one alpha source.
struct PairGroup {
    AlphaSource source;
    std::vector<PairedPrimitive> primitives;
};

// The primitives of MASK materials, and of BLEND ones if the parameters say so, in scene order by alpha
// source. Cutoff, guard and mips are those of the parameters. They look into `scene`.
std::vector<PairGroup> pairGroups(const scene::Scene& scene, const BakeParameters& parameters);

// The triangles of a pair, as its square wants them.
SquarePair squarePair(const scene::Primitive& primitive, const mesh::TrianglePair& pair);

// Each kind of pair once, in the order of first use: equal coordinates and vertex alphas, bit for bit.
struct DistinctPairs {
    std::vector<SquarePair> pairs;
    std::vector<std::vector<uint32_t>> of;  // which each primitive's pairs are, [primitives][pairs]
};
DistinctPairs distinctPairs(const PairGroup& group);

}  // namespace filigree::jobs
