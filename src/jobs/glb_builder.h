// Puts together a GLB file made in code.
#pragma once

#include "filigree/core/result.h"
#include "filigree/core/vec3.h"
#include "filigree/mesh/uv_triangle.h"
#include "filigree/scene/scene.h"

#include "jobs/json_text.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace filigree::jobs {

// Triangles to be written. Each list but `indices` has one entry a vertex or none at all.
struct Geometry {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;
    std::vector<mesh::Uv> uvs;
    std::vector<Vec3> colours;  // linear, in [0, 1]
    std::vector<uint32_t> indices;
};

// A document under construction: the JSON with its lists, and the one buffer. Every add returns the new
// index.
class GlbBuilder {
  public:
    explicit GlbBuilder(const std::string& generator);

    Result<size_t> addImage(const std::string& name, const scene::ColourImage& image);
    size_t add(const char* list, Json item);  // to a list of the document: "materials", "nodes"
    void set(const char* member, Json value) { json_[member] = std::move(value); }
    Json primitive(const Geometry& geometry, size_t material);

    // The file. The builder is spent.
    Result<std::vector<uint8_t>> finish();

  private:
    size_t addView(std::span<const uint8_t> bytes, int target);
    size_t addFloats(std::span<const float> values, size_t components, const char* type, bool bounds);
    size_t addIndices(const std::vector<uint32_t>& indices, size_t vertices);

    Json json_;
    std::vector<uint8_t> binary_;
};

}  // namespace filigree::jobs
