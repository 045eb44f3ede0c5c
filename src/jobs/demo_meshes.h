// Shapes of the demo scene, in metres, y up. Foliage is flat cards that alpha textures cut out.
#pragma once

#include "jobs/glb_builder.h"

#include <cstddef>

namespace filigree::jobs {

// A branch along +z, 1.5 m long: its wood, and twigs of the leaf texture's quarter `species`, 0..3.
struct Branch {
    Geometry wood;
    Geometry leaves;
};
Branch branchMesh(size_t species);

// A tapering trunk of `height` m on the origin.
Geometry trunkMesh(float height, float radius);

// A fern: eight fronds that bow outward.
Geometry fernMesh();

// Three crossed cards of grass.
Geometry grassMesh();

// Three blossoms on six-sided cards.
Geometry blossomMesh();

// Two metres of chain-link along +x, 1.5 m high; texture coordinates run far beyond [0, 1].
Geometry fenceMesh();

// A round post, 1.65 m high.
Geometry postMesh();

// Height of the ground at (x, z).
float groundHeight(float x, float z);

// A displaced square of ground about the origin, `size` m a side, in `cells` x `cells` quads, coloured by
// vertex.
Geometry groundMesh(float size, size_t cells);

}  // namespace filigree::jobs
