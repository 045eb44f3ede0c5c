// What a file holds: meshes, materials, images, instances, cameras and micromaps.
//
//     scene::Scene scene;
//     scene.meshes.push_back({"leaf", {scene::Primitive{}}});
//     scene.instances.push_back({});
//     const Result<scene::SceneFaces> faces = scene::opaqueFaces(scene);
#pragma once

#include "filigree/scene/camera_rays.h"
#include "filigree/scene/faces.h"
#include "filigree/scene/scene.h"
