// What a World holds.
#pragma once

#include "filigree/trace/world.h"

#include "trace/sampler.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <embree3/rtcore.h>

namespace filigree::trace {

// How a surface's holes are tested.
enum class AlphaKind : uint8_t { opaque, mask, blend };

struct Surface {
    const scene::Primitive* primitive = nullptr;
    const scene::Material* material = nullptr;   // null: none
    const scene::ColourImage* colour = nullptr;  // null: none
    const Sampler* alpha = nullptr;              // null: alpha 1
    uint32_t number = 0;                         // World's
    AlphaKind kind = AlphaKind::opaque;
    double cutoff = 0.5;
    double factor = 1;                    // multiplies the alpha
    const uint32_t* indices = nullptr;    // the primitive's, close at hand
    const mesh::Uv* uvs = nullptr;        // null: none
    const float* vertexAlphas = nullptr;  // null: none

    // Texture coordinates at a point of a triangle, u and v the weights of its vertices 1 and 2.
    [[nodiscard]] mesh::Uv coordinatesAt(uint32_t triangle, float u, float v) const;

    // Alpha at a point of a triangle.
    [[nodiscard]] double alphaAt(uint32_t triangle, float u, float v) const {
        const uint32_t* corner = indices + size_t{3} * triangle;
        double result = factor;
        if (alpha != nullptr) {
            const mesh::Uv& a = uvs[corner[0]];
            const mesh::Uv& b = uvs[corner[1]];
            const mesh::Uv& c = uvs[corner[2]];
            result *= alpha->at(mixed(a.u, b.u, c.u, u, v), mixed(a.v, b.v, c.v, u, v));
        }
        if (vertexAlphas != nullptr) {
            result *= mixed(vertexAlphas[corner[0]], vertexAlphas[corner[1]], vertexAlphas[corner[2]], u, v);
        }
        return result;
    }

    // In double precision: texture coordinates of many repeats would lose the texel's fraction in single.
    static double mixed(float a, float b, float c, float u, float v) {
        return a + double{u} * (double{b} - a) + double{v} * (double{c} - a);
    }
};

// Embree objects that release themselves.
struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DeviceOwner = std::unique_ptr<RTCDeviceTy, ReleaseDevice>;
using SceneOwner = std::unique_ptr<RTCSceneTy, ReleaseScene>;

// How far from the origin things may lie, and how much smaller than the world a mesh's own space may be, so
// that single precision bears both.
inline constexpr float worldReach = 1e8F;

// One placement of a mesh.
struct Placement {
    unsigned mesh = 0;
    std::array<float, 16> transform{};
};

struct World::Data {
    std::atomic<int64_t> embreeBytes{0};  // outlives the device, which counts into it
    DeviceOwner device;
    std::vector<SceneOwner> meshes;  // [mesh_count], null for one without triangles
    SceneOwner top;                  // geometry ids are numbers of `placements`
    std::vector<Surface> surfaces;
    std::vector<uint32_t> firstSurface;  // [mesh_count], of each mesh; geometry id k is surface first + k
    std::vector<std::unique_ptr<Sampler>> samplers;
    std::vector<Placement> placements;
    Box bounds;
    uint64_t triangleCount = 0;
    uint64_t geometryBytes = 0;
    GridPart grids;
    std::vector<std::string> notes;

    [[nodiscard]] const Surface& surfaceOf(const RTCHit& hit) const {
        return surfaces[firstSurface[placements[hit.instID[0]].mesh] + hit.geomID];
    }
};

}  // namespace filigree::trace
