// Where the alpha of a material comes from, and which primitives share it.
#pragma once

#include "filigree/image/alpha_image.h"
#include "filigree/mesh/uv_triangle.h"
#include "filigree/scene/scene.h"

#include <cstddef>
#include <span>
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

// Primitives that use one source, in scene order.
struct AlphaGroup {
    AlphaSource source;
    std::vector<scene::Primitive*> primitives;
};

// Adds `primitive` to the group of `source`, a new one at the end where there is none yet.
void addToGroup(std::vector<AlphaGroup>& groups, const AlphaSource& source, scene::Primitive& primitive);

// The triangles of all primitives, one after another.
std::vector<mesh::UvTriangle> trianglesOf(std::span<scene::Primitive* const> primitives);

}  // namespace filigree::jobs
