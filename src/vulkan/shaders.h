// The shaders as the build made them: SPIR-V.
#pragma once

#include <cstdint>
#include <span>

namespace filigree::vulkan {

// Which decoder of shaders/decode a shader holds. The numbers are those of shaders/decode/any.glsl.
enum class Decoder : uint8_t {
    flat,
    gruen,
    bitmask,
    tree,
    indexedTree,
    dag,
    sdag,
    vq2,
    vq2Plus,
    vq4,
    vq4Plus,
    none,  // the texture alone; not for lookups
};
inline constexpr unsigned decoderCount = 12;

// Of the pipeline only the any-hit shader holds a decoder.
enum class ShaderKind : uint8_t {
    lookup,
    gridLookup,
    picture,
    rayGeneration,
    miss,
    closestHit,
    anyHit,
    gridHit,
    gridIntersection
};

struct Shader {
    ShaderKind kind = ShaderKind::lookup;
    Decoder decoder = Decoder::flat;
    bool micromaps = false;  // of pictures and ray generation: that set flags for the device's micromaps
};

std::span<const uint32_t> codeOf(Shader shader);

}  // namespace filigree::vulkan
