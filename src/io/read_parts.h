// The parts of readScene, one file each. All read from a document into the same scene.
#pragma once

#include "filigree/io/gltf.h"

#include "io/accessor.h"
#include "io/document.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace filigree::io {

// KHR_texture_transform and the set of coordinates that a texture uses.
struct TextureCoordinates {
    uint64_t set = 0;  // n of TEXCOORD_n
    std::array<double, 2> offset{0, 0};
    std::array<double, 2> scale{1, 1};
    double rotation = 0;  // radians
    [[nodiscard]] bool isIdentity() const {
        return offset == std::array{0.0, 0.0} && scale == std::array{1.0, 1.0} && rotation == 0;
    }
};

// What reading primitives and images needs to know of a material besides scene::Material.
struct MaterialUse {
    bool needsAlpha = false;  // MASK, or BLEND where asked for
    bool used = false;        // by a primitive that is a list of triangles
    TextureCoordinates coordinates;
};

// A scene that is being read.
struct SceneReading {
    const GltfDocument::Data& data;
    const ReadOptions& options;
    scene::Scene scene;
    std::vector<MaterialUse> materials;
    // Scene::micromaps of the names in micromapExtensions start here.
    std::array<size_t, micromapExtensions.size()> firstMicromaps{};
    uint64_t bytesLeft = 0;

    void note(std::string text) { scene.notes.push_back(std::move(text)); }

    // Counts memory that `path` needs. Called before it is allocated.
    Status take(uint64_t bytes, const std::string& path);
};

// Fails on a required extension that changes what the bake must read and is not understood.
Status checkRequiredExtensions(const GltfDocument::Data& data);

Status readMaterials(SceneReading& reading);
Status readImages(SceneReading& reading);  // after readMaterials
Status readMicromaps(SceneReading& reading);
Status readMeshes(SceneReading& reading);  // after readMaterials and readMicromaps
Status readNodes(SceneReading& reading);

// The micromap indices of a primitive that has the extension.
Status readMicromapIndices(SceneReading& reading, const Json& primitive, const std::string& path,
                           scene::Primitive& to);

// The bytes of image `index`, from a buffer view, a data URI (held in `owned`) or a file (likewise).
Result<std::span<const uint8_t>> imageBytes(const GltfDocument::Data& data, size_t index,
                                            std::vector<uint8_t>& owned);

}  // namespace filigree::io
