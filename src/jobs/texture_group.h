// The triangles with micromaps that one alpha texture cuts out, measured.
#pragma once

#include "filigree/jobs/inspect.h"
#include "filigree/scene/scene.h"

#include "jobs/alpha_source.h"
#include "jobs/overlay.h"

#include <string>
#include <vector>

namespace filigree::jobs {

using TextureGroup = ConstAlphaGroup;

// Primitives with micromaps by alpha source, in scene order. Those whose material has no alpha, or whose
// image has none decoded, are left out with a note.
std::vector<TextureGroup> textureGroups(const scene::Scene& scene, std::vector<std::string>& notes);

// Counts and areas; name, picture and drawnTriangles stay empty.
InspectedTexture measure(const scene::Scene& scene, const TextureGroup& group);

// Its triangles to draw, each kind once. They look into `scene`.
std::vector<OverlayTriangle> overlayTriangles(const scene::Scene& scene, const TextureGroup& group);

}  // namespace filigree::jobs
