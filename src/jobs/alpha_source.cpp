#include "jobs/alpha_source.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <tuple>

namespace filigree::jobs {
namespace {

auto key(const AlphaSource& s) {
    return std::tuple(s.image, s.wrapU, s.wrapV, s.filter, s.test.mode, s.test.cutoff, s.test.factor,
                      s.test.mips, s.test.guard);
}

// Bit patterns, so that NaN equals itself and 0 differs from -0.
std::array<uint32_t, 11> kindOf(const TrianglePlace& place) {
    const auto triangle = place.uvTriangle();
    std::array<uint32_t, 11> kind{};
    for (size_t k = 0; k < 3; ++k) {
        kind[3 * k] = std::bit_cast<uint32_t>(triangle.uv[k].u);
        kind[3 * k + 1] = std::bit_cast<uint32_t>(triangle.uv[k].v);
        kind[3 * k + 2] = std::bit_cast<uint32_t>(triangle.alpha[k]);
    }
    kind[9] = static_cast<uint32_t>(place.primitive->micromaps);
    kind[10] = static_cast<uint32_t>(place.micromapIndex());
    return kind;
}

}  // namespace

bool AlphaSource::operator==(const AlphaSource& other) const {
    return key(*this) == key(other);
}

AlphaSource sourceOf(const scene::Material& material) {
    AlphaSource source{material.image, material.wrapU, material.wrapV, material.filter, {}};
    source.test.factor = material.baseColourFactor[3];
    source.test.guard = 0;
    if (material.alphaMode == scene::AlphaMode::blend) {
        source.test.mode = image::AlphaMode::blend;
    } else {
        source.test.cutoff = material.cutoff;
    }
    return source;
}

image::AlphaTexture textureOf(const scene::Scene& scene, const AlphaSource& source) {
    image::AlphaTexture texture{{}, source.wrapU, source.wrapV, source.filter};
    if (source.image >= 0) {
        texture.image = *scene.images[static_cast<size_t>(source.image)].alpha;
    } else {
        texture.image = image::AlphaImage{1, 1, {65535}, 255};
    }
    return texture;
}

image::AlphaTest testFor(const AlphaSource& source, const image::AlphaTexture& texture) {
    image::AlphaTest test = source.test;
    test.mips = std::min(test.mips, image::coarserLevels(texture.image));
    return test;
}

std::string nameOf(const scene::Scene& scene, const AlphaSource& source) {
    return source.image >= 0 ? scene.images[static_cast<size_t>(source.image)].name : "no texture";
}

std::vector<TrianglePlace> distinctTriangles(std::span<const scene::Primitive* const> primitives) {
    std::vector<TrianglePlace> places;
    std::map<std::array<uint32_t, 11>, size_t> seen;
    for (const auto* primitive : primitives) {
        for (size_t t = 0; t < primitive->triangleCount(); ++t) {
            const TrianglePlace place{primitive, t};
            const auto [found, isNew] = seen.try_emplace(kindOf(place), places.size());
            if (isNew) {
                places.push_back(place);
            } else {
                ++places[found->second].equals;
            }
        }
    }
    return places;
}

std::vector<mesh::UvTriangle> trianglesOf(std::span<scene::Primitive* const> primitives) {
    size_t count = 0;
    for (const auto* primitive : primitives) count += primitive->triangleCount();
    std::vector<mesh::UvTriangle> triangles;
    triangles.reserve(count);
    for (const auto* primitive : primitives) {
        for (size_t t = 0; t < primitive->triangleCount(); ++t) triangles.push_back(primitive->uvTriangle(t));
    }
    return triangles;
}

}  // namespace filigree::jobs
