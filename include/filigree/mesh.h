// Triangles as a micromap sees them, faces as mesh files hold them, and the pairing of triangles over shared
// edges.
//
//     const std::vector<std::array<float, 3>> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
//     const std::vector<uint32_t> indices{0, 1, 2, 0, 2, 3};
//     const auto pairs = mesh::pairTriangles({corners, {}, indices});  // one pair
#pragma once

#include "filigree/mesh/face_mesh.h"
#include "filigree/mesh/pairing.h"
#include "filigree/mesh/uv_triangle.h"
