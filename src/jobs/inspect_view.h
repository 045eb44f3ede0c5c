// The interactive view of a scene's micromaps, kept small enough for a page.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/report/map_view.h"
#include "filigree/scene/scene.h"

#include "jobs/texture_group.h"

#include <cstddef>
#include <span>
#include <string>

namespace filigree::jobs {

// A texture to view, and what was measured of it.
struct ViewInput {
    const TextureGroup& group;
    const InspectedTexture& measured;
};

// At most about so many bytes of the page. 0: no limit.
struct ViewBudget {
    size_t pictures = 4'500'000;
    size_t triangles = 2'000'000;
    size_t all = 9'000'000;
};
inline constexpr ViewBudget noViewBudget{0, 0, 0};

// Where the budget does not hold everything, textures shrink, triangles are left out and the finest levels
// are merged, and the notes of the textures say so.
Result<report::MapView> inspectView(const scene::Scene& scene, std::span<const ViewInput> inputs,
                                    const ViewBudget& budget, const Executor& executor);

}  // namespace filigree::jobs
