// The scene that the demo makes in code: a glade with trees, ferns, grass and blossoms behind a chain-link
// fence. Everything that is cut out is MASK foliage on cards; trunks, posts and the displaced ground are
// opaque. Meshes are few and placed often, so that the file shows instancing, sharing, wrapped texture
// coordinates, textures of several sizes and both wrap modes.
#pragma once

#include "filigree/core/result.h"

#include <cstdint>
#include <vector>

namespace filigree::jobs {

// The scene as a GLB file of about 1.5 MB, without micromaps, with two cameras. Always the same bytes.
Result<std::vector<uint8_t>> makeDemoScene();

}  // namespace filigree::jobs
