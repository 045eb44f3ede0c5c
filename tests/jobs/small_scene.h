// A scene with one masked texture, for tests of the jobs.
#pragma once

#include "filigree/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace filigree::tests {

// Opaque left half, transparent right half.
inline scene::Image halves() {
    std::vector<uint8_t> texels(16 * 16);
    for (size_t i = 0; i < texels.size(); ++i) texels[i] = i % 16 < 8 ? 255 : 0;
    return {"halves", image::alphaImageFrom8Bit(16, 16, texels), {}};
}

inline scene::Material masked(int image) {
    scene::Material material;
    material.alphaMode = scene::AlphaMode::mask;
    material.image = image;
    return material;
}

// A quad of two triangles over the whole texture.
inline scene::Primitive quad(int material) {
    scene::Primitive primitive;
    primitive.material = material;
    primitive.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    primitive.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    primitive.indices = {0, 1, 2, 0, 2, 3};
    return primitive;
}

// One mesh, whose primitives have the materials 0, 1, ...
inline scene::Scene sceneOf(std::vector<scene::Material> materials) {
    scene::Scene scene;
    scene.images.push_back(halves());
    scene.meshes.emplace_back();
    for (size_t m = 0; m < materials.size(); ++m)
        scene.meshes[0].primitives.push_back(quad(static_cast<int>(m)));
    scene.materials = std::move(materials);
    return scene;
}

}  // namespace filigree::tests
