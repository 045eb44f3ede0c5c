// A scene under Embree, any way to decide its candidate hits, pictures of it, and what they cost.
//
//     const scene::Scene scene;  // as io::readScene gives it, with colour
//     const Result<trace::World> world = trace::World::build(scene, {});
//     const auto opacity = trace::Opacity::make(trace::Method::texture, 4, *world, {}, {});
//     trace::Film film(640, 360);
//     const trace::RenderSettings settings{.width = 640, .height = 360, .camera = trace::overview(*world)};
//     trace::addSample(*world, *opacity, settings, serialExecutor(), silentProgress(), film);
#pragma once

#include "filigree/trace/counters.h"
#include "filigree/trace/embree_grids.h"
#include "filigree/trace/grid_part.h"
#include "filigree/trace/grid_rays.h"
#include "filigree/trace/opacity.h"
#include "filigree/trace/rays.h"
#include "filigree/trace/render.h"
#include "filigree/trace/world.h"
