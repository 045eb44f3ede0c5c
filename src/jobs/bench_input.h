// What the bake benchmark works on: a leaf, two triangles over all of it, and 20,000 random ones.
#pragma once

#include "filigree/core/result.h"
#include "filigree/image/alpha_image.h"
#include "filigree/mesh/uv_triangle.h"

#include <filesystem>
#include <vector>

namespace filigree::jobs {

struct BenchInput {
    image::AlphaTexture texture;  // 1024 x 1024, 8 bit, bilinear, repeat
    std::vector<mesh::UvTriangle> quad;
    std::vector<mesh::UvTriangle> rand20k;  // edges of 64 to 256 texels
};

// Made in code, the same on every machine.
BenchInput makeBenchInput();

// From headerless little-endian files: leaf_1024x1024.u8 (rows, row 0 at v = 0, alpha = byte / 255) and, for
// quad and rand20k each, .uv.f32 (u, v for each vertex) and .idx.u32 (three for each triangle). Fails on a
// missing file, a wrong size or an index past the vertices.
Result<BenchInput> readBenchInput(const std::filesystem::path& folder);

}  // namespace filigree::jobs
