// What a file holds, in the form that the other rooms need.
#pragma once

#include "filigree/core/api.h"
#include "filigree/image/alpha_image.h"
#include "filigree/mesh/uv_triangle.h"
#include "filigree/micromap/set.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace filigree::scene {

// A colour image, 8 bits a channel, row 0 at v = 0.
struct ColourImage {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> rgba;  // [width * height * 4]
};

// What a material does with alpha, as glTF has it.
enum class AlphaMode : uint8_t { opaque, mask, blend };

// What matters here of a glTF material.
struct Material {
    std::string name;
    AlphaMode alphaMode = AlphaMode::opaque;
    double cutoff = 0.5;
    std::array<float, 4> baseColourFactor{1, 1, 1, 1};
    int image = -1;  // of the base colour texture, into Scene::images; -1 for none
    image::Wrap wrapU = image::Wrap::repeat;
    image::Wrap wrapV = image::Wrap::repeat;
    image::Filter filter = image::Filter::linear;
    bool doubleSided = false;
};

// A list of triangles with one material. Only glTF primitives of mode 4 (triangles) become one.
struct Primitive {
    unsigned meshIndex = 0;                       // into glTF meshes
    unsigned primitiveIndex = 0;                  // into that mesh's primitives
    int material = -1;                            // into Scene::materials; -1 for none
    std::vector<std::array<float, 3>> positions;  // [vertex_count]
    std::vector<mesh::Uv>
        uvs;  // [vertex_count], texture transform applied; empty without texture coordinates
    std::vector<float> alphas;      // [vertex_count], COLOR_0 alpha; empty when absent or without alpha
    std::vector<uint32_t> indices;  // [3 * triangle_count], always present, each below vertex_count
    int micromaps = -1;             // into Scene::micromaps; -1 for none
    std::vector<int32_t> micromapIndices;  // [triangle_count], base triangle applied; a record or special

    [[nodiscard]] size_t triangleCount() const { return indices.size() / 3; }
    [[nodiscard]] mesh::UvTriangle uvTriangle(size_t triangle) const {
        mesh::UvTriangle t;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t vertex = indices[3 * triangle + k];
            if (!uvs.empty()) t.uv[k] = uvs[vertex];
            if (!alphas.empty()) t.alpha[k] = alphas[vertex];
        }
        return t;
    }
};

// Primitives that are placed together.
struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
};

// One placement of a mesh. `transform` is column-major as in glTF: world = transform * local.
struct Instance {
    unsigned mesh = 0;
    std::array<float, 16> transform{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
};

// A perspective camera.
struct Camera {
    std::string name;
    std::array<float, 16> transform{};  // world from camera; looks along -z
    float verticalFov = 0.8f;           // radians
};

// Images are decoded when first asked for and may be shared; a scene's images keep what the file says of
// them.
struct Image {
    std::string name;                        // glTF name, or "image N"
    std::optional<image::AlphaImage> alpha;  // decoded where a MASK or BLEND material uses it
    std::optional<ColourImage> colour;       // decoded on request
};

// The micromaps of a file, flat, with the parameters that were recorded when they were baked.
struct Micromaps {
    micromap::FlatSet set;  // its `indices` stay empty: each primitive has its own
    std::optional<image::AlphaTest> bakedWith;
    std::string name;
};

// All that a file holds. Indices of one list into another are in range.
struct Scene {
    std::vector<Mesh> meshes;
    std::vector<Material> materials;
    std::vector<Image> images;
    std::vector<Instance> instances;  // of the file's default scene; of all scenes where it names none
    std::vector<Camera> cameras;
    std::vector<Micromaps> micromaps;
    std::vector<std::string> notes;  // what was passed over, one line each, for the user
};

// World area of each triangle of a primitive, summed over all instances of its mesh, [triangle_count], in
// square world units. Triangles that are not finite count as 0.
FILIGREE_API std::vector<double> worldAreas(const Scene& scene, const Primitive& primitive);

}  // namespace filigree::scene
