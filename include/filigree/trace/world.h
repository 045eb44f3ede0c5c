// A scene ready to be traced: its geometry under Embree, its alpha textures beside it.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/box.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/scene/scene.h"
#include "filigree/trace/grid_part.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace filigree::trace {

// What of a scene a world holds, and how.
struct WorldOptions {
    bool blend = true;  // BLEND materials are stochastically transparent; otherwise opaque
    // The alpha test reads RGBA texels, as a renderer does that has its textures once, where they have 8
    // bits; otherwise a copy of the alpha alone, four times as small. Same pictures, other cache misses.
    bool alphaAmongColours = false;
    // False: opaque surfaces are left out, because grids stand for them.
    bool opaque = true;
    GridPart grids{};  // beside the scene's meshes
};

// Meshes are built once and instanced. A surface is one primitive of a mesh, with its material; they are
// numbered over all meshes in scene order, primitives without triangles left out. Vertices that are not
// finite drop their triangle, and transforms that are not, have no inverse or lead further than 10^8 units
// drop their instance, with a note.
class FILIGREE_API World {
  public:
    // `scene` must outlive the world; its images need their colour and alpha decoded
    // (io::ReadOptions::colour, blendAlpha). ErrorKind::limit when Embree runs out of memory,
    // ErrorKind::cancelled. Progress in triangles.
    static Result<World> build(const scene::Scene& scene, const WorldOptions& options,
                               ProgressSink& progress = silentProgress());

    World(World&&) noexcept;
    World& operator=(World&&) noexcept;
    ~World();

    [[nodiscard]] size_t surfaceCount() const;
    // The primitive behind a surface.
    [[nodiscard]] const scene::Primitive& primitive(size_t surface) const;
    // True where hits are candidates that an alpha test decides.
    [[nodiscard]] bool isTested(size_t surface) const;

    [[nodiscard]] Box bounds() const;              // of all instances and grids, in world units
    [[nodiscard]] uint64_t triangleCount() const;  // instances counted
    [[nodiscard]] const std::vector<std::string>& notes() const;

    // Memory while rays are traced, in bytes.
    struct Bytes {
        uint64_t geometry = 0;  // vertices and indices as Embree holds them, records of grids
        uint64_t bvh = 0;
        uint64_t textures = 0;  // alpha as the any-hit test reads it
    };
    [[nodiscard]] Bytes bytes() const;

    // For this room only.
    struct Data;
    [[nodiscard]] const Data& data() const { return *data_; }

  private:
    explicit World(std::unique_ptr<Data> data);
    std::unique_ptr<Data> data_;
};

}  // namespace filigree::trace
