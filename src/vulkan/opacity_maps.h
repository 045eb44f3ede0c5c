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
    Buffer surfaces;  // Maps of picture.comp

    // Checks the method's set and surfaces.
    static Result<OpacityMaps> make(Device::Data& device, const RayScene& scene, const Method& method);
};

}  // namespace filigree::vulkan
