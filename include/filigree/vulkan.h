// Vulkan devices: lookups by the shaders of shaders/decode, and pictures by ray queries. The room is empty
// where the project was built without Vulkan; vulkan::isBuilt() says so.
//
//     const auto device = vulkan::Device::open({});
//     if (!device) std::cerr << device.error().message << '\n';
#pragma once

#include "filigree/vulkan/device.h"
#include "filigree/vulkan/grid_lookup.h"
#include "filigree/vulkan/lookup.h"
#include "filigree/vulkan/picture.h"
#include "filigree/vulkan/ray_scene.h"
