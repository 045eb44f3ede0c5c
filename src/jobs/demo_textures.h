// Alpha textures made in code: what the demo's foliage and fence are cut from.
#pragma once

#include "filigree/scene/scene.h"

namespace filigree::jobs {

// Four twigs of different trees, one in each quarter; 1024 x 1024.
scene::ColourImage leavesTexture();

// One fern frond, its stalk at the bottom; 512 x 1024.
scene::ColourImage fernTexture();

// A tuft of grass, its roots at the bottom; 512 x 256.
scene::ColourImage grassTexture();

// A blossom with a hole between its petals; 128 x 128.
scene::ColourImage blossomTexture();

// One mesh of a chain-link fence, to be repeated both ways; 256 x 256.
scene::ColourImage fenceTexture();

}  // namespace filigree::jobs
