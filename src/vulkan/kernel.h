// A compute shader with its buffers.
#pragma once

#include "vulkan/bindings.h"
#include "vulkan/shaders.h"

#include <cstdint>
#include <span>

namespace filigree::vulkan {

class Kernel {
  public:
    // `constants`: of the shader's constant_id 0, 1, ..
    static Result<Kernel> make(Device::Data& device, Shader shader, const BindingShape& shape,
                               std::span<const uint32_t> constants);

    Bindings& bindings() { return bindings_; }

    // Runs `groups` groups across and down. `push` has the shape's pushBytes bytes.
    void record(VkCommandBuffer commands, const void* push, uint32_t groupsX, uint32_t groupsY = 1) const;

  private:
    Kernel() = default;
    Bindings bindings_;
    OwnedPipeline pipeline_;
};

}  // namespace filigree::vulkan
