// The shaders that render pictures: a compute shader with ray queries, or a ray-tracing pipeline.
#pragma once

#include "filigree/vulkan/device.h"

#include "vulkan/kernel.h"
#include "vulkan/ray_pipeline.h"

#include <cstdint>
#include <span>
#include <variant>

namespace filigree::vulkan {

// What shaders must know of a scene and a method.
struct PictureVariant {
    Decoder decoder = Decoder::none;
    bool hasGrids = false;  // compressed ones
    bool hardware = false;  // structures have micromaps, and the decoder is none
};

class PictureShaders {
  public:
    // `constants`: of each shader's constant_id 0, 1, ..
    static Result<PictureShaders> make(Device::Data& device, RayPath path, const PictureVariant& variant,
                                       const BindingShape& shape, std::span<const uint32_t> constants);

    Bindings& bindings();

    // One more sample of a band of pixels.
    void record(VkCommandBuffer commands, const void* push, uint32_t width, uint32_t height) const;

  private:
    template <class Shaders>
    explicit PictureShaders(Shaders shaders) : shaders_(std::move(shaders)) {}
    std::variant<Kernel, RayPipeline> shaders_;
};

}  // namespace filigree::vulkan
