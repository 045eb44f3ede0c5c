// A scene as the words that shaders read (shaders/trace/scene.glsl).
#pragma once

#include "filigree/core/result.h"
#include "filigree/scene/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace filigree::vulkan {

inline constexpr uint32_t noWord = ~0u;
inline constexpr uint64_t mostSceneWords = uint64_t{1} << 30;

// A surface; the words of all of them, in order, come first. Places are numbers of words.
struct SurfaceWords {
    uint32_t kind = 0;  // 0 opaque, 1 mask, 2 blend
    uint32_t indicesAt = 0;
    uint32_t positionsAt = 0;
    uint32_t coordinatesAt = noWord;  // noWord: none
    uint32_t alphasAt = noWord;       // of vertices; noWord: none
    float cutoff = 0.5F;
    float factor = 1;           // multiplies the alpha
    uint32_t alphaAt = noWord;  // texels; noWord: alpha 1
    uint32_t alphaSize = 0;     // width - 1 and height - 1, 16 bits each
    uint32_t how = 0;           // bits 0-1 and 2-3: wrap modes of u and v; 4: alpha has 8 bits; 5: nearest
    uint32_t tablesAt = 0;      // 256 of k / 255, 256 of sRGB in linear light
    std::array<float, 3> colour{0.6F, 0.6F, 0.6F};
    uint32_t colourAt = noWord;  // RGBA, a word a texel; noWord: none
    uint32_t colourSize = 0;     // as alphaSize
};
static_assert(sizeof(SurfaceWords) == 64);

struct SceneWords {
    std::vector<uint32_t> words;
    std::vector<SurfaceWords> surfaces;
    std::vector<const scene::Primitive*> primitives;  // of the surfaces
    std::vector<uint32_t> firstSurface;               // [mesh_count + 1]
};

// Without opaque surfaces where they are not wanted. ErrorKind::limit beyond 2^30 words.
Result<SceneWords> sceneWords(const scene::Scene& scene, bool opaque);

}  // namespace filigree::vulkan
