// PLY files (Stanford polygon format 1.0) as meshes.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/result.h"
#include "filigree/mesh/face_mesh.h"

#include <cstdint>
#include <filesystem>
#include <span>

namespace filigree::io {

// Reads the element `vertex` with x y z, and where all are there nx ny nz, and u v or s t, and the element
// `face` with the list vertex_indices or vertex_index: ascii, binary_little_endian or
// binary_big_endian, numbers of any type. Polygons of more than four corners become fans of triangles around
// their first corner, those of fewer than three are errors. Other elements and properties are passed over.
// Texture coordinates of the file have their origin at the lower left; those of the mesh are the same
// numbers. Errors name the line of the header or the element with its number.
FILIGREE_API Result<mesh::FaceMesh> parsePly(std::span<const uint8_t> bytes);
FILIGREE_API Result<mesh::FaceMesh> readPly(const std::filesystem::path& path);

}  // namespace filigree::io
