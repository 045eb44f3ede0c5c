// Where the alpha of a material comes from, and which primitives share it.
#pragma once

#include "filigree/image/alpha_image.h"
#include "filigree/mesh/uv_triangle.h"
#include "filigree/scene/scene.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace filigree::jobs {

// All that decides a micromap beside the triangle. Materials with equal sources share micromaps.
struct AlphaSource {
    int image = -1;  // into Scene::images; -1: alpha 1 everywhere, so that the factor decides
    image::Wrap wrapU = image::Wrap::repeat;
    image::Wrap wrapV = image::Wrap::repeat;
    image::Filter filter = image::Filter::linear;
    image::AlphaTest test;

    bool operator==(const AlphaSource& other) const;
};

// The alpha of `material` as the file gives it: its own mode (blend, or mask for any other) and cutoff, no
// coarser mip levels, guard 0.
AlphaSource sourceOf(const scene::Material& material);

// The texture of a source, and the test's mips clamped to those that it has.
image::AlphaTexture textureOf(const scene::Scene& scene, const AlphaSource& source);
image::AlphaTest testFor(const AlphaSource& source, const image::AlphaTexture& texture);

// A name for people: the image's, or "no texture".
std::string nameOf(const scene::Scene& scene, const AlphaSource& source);

// Primitives that use one source, in scene order. `Primitive` is scene::Primitive, const or not.
template <class Primitive>
struct AlphaGroupOf {
    AlphaSource source;
    std::vector<Primitive*> primitives;
};
using AlphaGroup = AlphaGroupOf<scene::Primitive>;
using ConstAlphaGroup = AlphaGroupOf<const scene::Primitive>;

// Adds `primitive` to the group of `source`, a new one at the end where there is none yet.
template <class Primitive>
void addToGroup(std::vector<AlphaGroupOf<Primitive>>& groups, const AlphaSource& source,
                Primitive& primitive) {
    auto group =
        std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.source == source; });
    if (group == groups.end()) group = groups.insert(group, {source, {}});
    group->primitives.push_back(&primitive);
}

// One triangle of a primitive.
struct TrianglePlace {
    const scene::Primitive* primitive = nullptr;
    size_t triangle = 0;
    uint64_t equals = 1;  // triangles of its kind, where distinctTriangles gave it

    [[nodiscard]] mesh::UvTriangle uvTriangle() const { return primitive->uvTriangle(triangle); }
    [[nodiscard]] int32_t micromapIndex() const { return primitive->micromapIndices[triangle]; }
};

// The triangles of primitives that have micromaps, each kind once, where it first stands: triangles with
// equal texture coordinates, vertex alpha and micromap are one kind.
std::vector<TrianglePlace> distinctTriangles(std::span<const scene::Primitive* const> primitives);

// The triangles of all primitives, one after another.
std::vector<mesh::UvTriangle> trianglesOf(std::span<scene::Primitive* const> primitives);

}  // namespace filigree::jobs
