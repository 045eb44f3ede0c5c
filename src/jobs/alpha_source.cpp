#include "jobs/alpha_source.h"

#include <algorithm>
#include <tuple>

namespace filigree::jobs {
namespace {

auto key(const AlphaSource& s) {
    return std::tuple(s.image, s.wrapU, s.wrapV, s.filter, s.test.mode, s.test.cutoff, s.test.factor,
                      s.test.mips, s.test.guard);
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

void addToGroup(std::vector<AlphaGroup>& groups, const AlphaSource& source, scene::Primitive& primitive) {
    auto group =
        std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.source == source; });
    if (group == groups.end()) group = groups.insert(group, {source, {}});
    group->primitives.push_back(&primitive);
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
