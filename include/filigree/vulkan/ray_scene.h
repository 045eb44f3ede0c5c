// A scene on a device, ready for rays.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/result.h"
#include "filigree/scene/scene.h"
#include "filigree/vulkan/device.h"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace filigree::vulkan {

// Meshes are built once and instanced. A surface is one primitive of a mesh, with its material; they are
// numbered over all meshes in scene order, primitives without triangles left out, as trace::World numbers
// them. Vertices that are not finite drop their triangle, and transforms that are not finite or flatten to
// nothing their instance.
class FILIGREE_API RayScene {
  public:
    // `scene` needs colour and alpha decoded, as for trace::World, and must outlive the result, as must
    // `device`. BLEND materials are stochastically transparent. ErrorKind::unsupported where the device
    // traces no rays, ErrorKind::limit where the scene does not fit it.
    static Result<RayScene> build(const Device& device, const scene::Scene& scene);

    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;
    ~RayScene();

    [[nodiscard]] size_t surfaceCount() const;
    [[nodiscard]] const scene::Primitive& primitive(size_t surface) const;

    // Memory on the device, in bytes.
    struct Bytes {
        uint64_t words = 0;       // vertices, indices, texture coordinates, textures
        uint64_t structures = 0;  // acceleration structures
    };
    [[nodiscard]] Bytes bytes() const;

    // For this room only.
    struct Data;
    [[nodiscard]] const Data& data() const { return *data_; }

  private:
    explicit RayScene(std::unique_ptr<Data> data);
    std::unique_ptr<Data> data_;
};

}  // namespace filigree::vulkan
