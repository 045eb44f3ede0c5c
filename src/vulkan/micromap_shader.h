// Shaders that meet micromaps of the device.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::vulkan {

// What shaders must declare. The GLSL compilers of 2022 declare neither.
struct MicromapDeclarations {
    // The capability that the ray flag ForceOpacityMicromap2State needs (SPV_EXT_opacity_micromap).
    bool twoStateFlag = false;
    // The execution mode without which ray queries overlook micromaps of VK_KHR_opacity_micromap
    // (OpacityMicromapIdKHR of SPV_KHR_opacity_micromap).
    bool queryMode = false;
};

// SPIR-V of one entry point, with the declarations added.
std::vector<uint32_t> withMicromaps(std::span<const uint32_t> code, const MicromapDeclarations& wanted);

}  // namespace filigree::vulkan
