// What a method looks into, on the device.
#pragma once

#include "filigree/vulkan/picture.h"

#include "vulkan/buffer.h"
#include "vulkan/shaders.h"

#include <cstdint>

namespace filigree::vulkan {

struct OpacityMaps {
    Decoder decoder = Decoder::none;
    uint32_t widthShift = 0;  // log2 of a state's bits
    Buffer descriptors;
    Buffer payload;
    Buffer surfaces;     // Maps of opacity.glsl
    uint64_t bytes = 0;  // of the set or squares, and all triangles' maps

    // Checks the method's set and surfaces.
    static Result<OpacityMaps> make(Device::Data& device, const RayScene& scene, const Method& method);
};

// ErrorKind::format where what a method knows of surfaces is not of the scene, or names maps that are not
// there.
Status checkSurfaces(const RayScene& scene, const Method& method, uint64_t mapCount);

}  // namespace filigree::vulkan
