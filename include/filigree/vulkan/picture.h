// Pictures by ray queries in compute shaders or by ray-tracing pipelines, with the alpha test of any of the
// decoders in shaders/decode.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/core/vec3.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/quadmap/place.h"
#include "filigree/quadmap/reader.h"
#include "filigree/scene/scene.h"
#include "filigree/vulkan/ray_scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace filigree::vulkan {

// What a method knows of a surface; as trace::SurfaceMaps and trace::SurfaceSquares.
struct SurfaceMaps {
    std::span<const int32_t> indices;  // [triangle_count], a map or special (-1..-4); empty: nothing
    std::span<const quadmap::SquarePlace> places;  // [triangle_count], of squares
    std::optional<uint32_t> texture;               // of a bitmask set
};

// What a structure is built for: PREFER_FAST_TRACE or PREFER_FAST_BUILD of Vulkan.
enum class StructureBuild : uint8_t { fastTrace, fastBuild };
// "fast-trace" and "fast-build".
FILIGREE_API std::string_view nameOf(StructureBuild build);
FILIGREE_API std::optional<StructureBuild> structureBuildNamed(std::string_view name);

// How candidate hits are decided.
struct Method {
    bool takesAll = false;  // every candidate is a hit, and none is counted
    // At most one of the two; none: the texture decides. Their bytes must outlive the OpacityMaps made of
    // them.
    std::optional<encoding::EncodedView> set;
    std::optional<quadmap::SquareReader> squares;
    // The device looks into micromaps made of `set`, which is flat; shaders see unknown states alone.
    bool hardware = false;
    StructureBuild build = StructureBuild::fastTrace;  // of hardware micromaps and the structures with them
    unsigned states = 4;                // 4: unknown states fetch the texture; 2: their side decides
    std::vector<SurfaceMaps> surfaces;  // by surface of the scene; may be fewer
};

// The numbers are those of trace::Integrator.
enum class Integrator : uint8_t { primary, shadow, ao, path };

// How a picture is rendered.
struct PictureSettings {
    uint32_t width = 960;  // pixels, at least 1
    uint32_t height = 540;
    unsigned samples = 1;  // of each pixel
    Integrator integrator = Integrator::ao;
    scene::Camera camera;
    uint32_t seed = 1;
    unsigned bounces = 3;          // of a path
    float epsilon = 1e-4F;         // world units, how far rays start off a surface
    float aoDistance = 1;          // length of AO rays, world units
    bool twoStateShadows = false;  // shadow and AO rays take the side of unknown states
    bool count = true;             // fill the counts, which takes time
};

// Of the rays of one kind.
struct PictureCounts {
    uint64_t rays = 0;
    uint64_t candidates = 0;
    uint64_t lookups = 0;
    uint64_t fetches = 0;
};

// What render() makes.
struct Picture {
    std::vector<Vec3> sums;               // [width * height], linear light, of all samples
    std::vector<uint32_t> fetches;        // [width * height], of textures, of all samples
    std::array<PictureCounts, 4> counts;  // primary, shadow, AO and bounce rays
    uint64_t pixelsHit = 0;               // samples whose first ray met the scene
    double seconds = 0;                   // that the shaders took: by the device's clock, where it has one
};

// A method on a device, its shader compiled: renders any number of pictures of one scene.
class FILIGREE_API Painter {
  public:
    // `device` and `scene` must outlive the result; the device has the path. Sets are checked first:
    // ErrorKind::format. ErrorKind::unsupported for hardware micromaps where the device has none of the
    // level, ErrorKind::limit where something does not fit.
    static Result<Painter> make(const Device& device, const RayScene& scene, const Method& method,
                                RayPath path);

    Painter(Painter&&) noexcept;
    Painter& operator=(Painter&&) noexcept;
    ~Painter();

    // With the random numbers of the CPU backend: the pictures differ where rays graze edges and arithmetic
    // rounds. ErrorKind::limit where it does not fit the device, ErrorKind::cancelled. Progress advances by
    // pixels.
    Result<Picture> render(const PictureSettings& settings, ProgressSink& progress);

    // Memory on the device for what the method looks into, the maps of all triangles included; of hardware
    // micromaps what the device made of them.
    [[nodiscard]] uint64_t opacityBytes() const;

    // For this room only.
    struct Data;

  private:
    explicit Painter(std::unique_ptr<Data> data);
    std::unique_ptr<Data> data_;
};

}  // namespace filigree::vulkan
