// A scene on a device, ready for rays.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/core/result.h"
#include "filigree/grid/attributes.h"
#include "filigree/grid/encoded_grids.h"
#include "filigree/grid/vertex_grid.h"
#include "filigree/scene/scene.h"
#include "filigree/vulkan/device.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace filigree::vulkan {

// Compressed grids beside a scene's meshes: opaque, in world units, traced as they are encoded.
struct GridPart {
    const grid::EncodedGrids* grids = nullptr;  // checked (grid/check.h); null: none
    std::span<const grid::VertexGrid> table;
    const grid::GridAttributes* attributes = nullptr;  // for smooth normals; null or without: flat triangles
};

// What a scene holds besides its meshes.
struct RaySceneOptions {
    bool opaque = true;  // false: opaque surfaces are left out, because grids stand for them
    GridPart grids{};
};

// Meshes are built once and instanced. A surface is one primitive of a mesh, with its material; they are
// numbered over all meshes in scene order, primitives that are left out or have no triangles not counted, as
// trace::World numbers them. Vertices that are not finite drop their triangle, and transforms that are not
// finite or flatten to nothing their instance.
class FILIGREE_API RayScene {
  public:
    // `scene` needs colour and alpha decoded, as for trace::World, and must outlive the result, as must
    // `device`. BLEND materials are stochastically transparent. ErrorKind::unsupported where the device
    // traces no rays and for grids of Codec::paper, which have no shader, ErrorKind::limit where the scene
    // does not fit it. Of grids, records, offsets and normals are copied to the device.
    static Result<RayScene> build(const Device& device, const scene::Scene& scene,
                                  const RaySceneOptions& options = {},
                                  const Executor& executor = serialExecutor());

    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;
    ~RayScene();

    [[nodiscard]] size_t surfaceCount() const;
    [[nodiscard]] const scene::Primitive& primitive(size_t surface) const;

    // Memory on the device, in bytes.
    struct Bytes {
        uint64_t words = 0;           // vertices, indices, texture coordinates, textures, grids
        uint64_t structures = 0;      // acceleration structures
        uint64_t gridWords = 0;       // of `words`: records of grids, with where they are, and normals
        uint64_t gridStructures = 0;  // of `structures`: over the records' boxes
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
