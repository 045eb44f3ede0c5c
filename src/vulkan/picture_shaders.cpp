#include "vulkan/picture_shaders.h"

namespace filigree::vulkan {
namespace {

constexpr uint32_t tileSide = 8;  // of picture.comp

uint32_t tilesAcross(uint32_t side) {
    return (side + tileSide - 1) / tileSide;
}

RayShaders rayShaders(const PictureVariant& variant) {
    const Decoder decoder = variant.decoder;
    RayShaders shaders;
    if (variant.hardware) shaders.flags = VK_PIPELINE_CREATE_RAY_TRACING_OPACITY_MICROMAP_BIT_EXT;
    shaders.generation = {ShaderKind::rayGeneration, decoder, variant.hardware};
    shaders.miss = {ShaderKind::miss, decoder};
    shaders.hits.push_back(
        {Shader{ShaderKind::closestHit, decoder}, Shader{ShaderKind::anyHit, decoder}, {}});
    if (variant.hasGrids) {
        shaders.hits.push_back(
            {Shader{ShaderKind::gridHit, decoder}, {}, Shader{ShaderKind::gridIntersection, decoder}});
    }
    return shaders;
}

}  // namespace

Result<PictureShaders> PictureShaders::make(Device::Data& device, RayPath path, const PictureVariant& variant,
                                            const BindingShape& shape, std::span<const uint32_t> constants) {
    if (path == RayPath::pipeline) {
        auto made = RayPipeline::make(device, rayShaders(variant), shape, constants);
        if (!made) return made.error();
        return PictureShaders(std::move(*made));
    }
    auto made =
        Kernel::make(device, {ShaderKind::picture, variant.decoder, variant.hardware}, shape, constants);
    if (!made) return made.error();
    return PictureShaders(std::move(*made));
}

Bindings& PictureShaders::bindings() {
    return std::visit([](auto& shaders) -> Bindings& { return shaders.bindings(); }, shaders_);
}

void PictureShaders::record(VkCommandBuffer commands, const void* push, uint32_t width,
                            uint32_t height) const {
    if (const auto* kernel = std::get_if<Kernel>(&shaders_)) {
        kernel->record(commands, push, tilesAcross(width), tilesAcross(height));
    } else {
        std::get<RayPipeline>(shaders_).record(commands, push, width, height);
    }
}

}  // namespace filigree::vulkan
