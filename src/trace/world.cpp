#include "filigree/core/stage.h"
#include "filigree/grid/encode_grids.h"

#include "trace/filter.h"
#include "trace/world_data.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>

namespace filigree::trace {
namespace {

bool isFinite(std::span<const float> values) {
    return std::ranges::all_of(values, [](float v) { return std::isfinite(v); });
}

bool countMemory(void* bytes, ssize_t change, bool) {
    *static_cast<std::atomic<int64_t>*>(bytes) += change;
    return true;
}

// True where a transform has an inverse, and both stay within worldReach.
bool isUsable(const std::array<float, 16>& m, const Box& box) {
    if (!isFinite(m)) return false;
    const Vec3 x{m[0], m[1], m[2]};
    const Vec3 y{m[4], m[5], m[6]};
    const Vec3 z{m[8], m[9], m[10]};
    const std::array<Vec3, 3> cofactors{cross(y, z), cross(z, x), cross(x, y)};
    const float volume = std::fabs(dot(x, cofactors[0]));
    for (const Vec3& cofactor : cofactors) {
        for (const float c : cofactor) {
            if (!(std::fabs(c) < worldReach * volume)) return false;
        }
    }
    for (unsigned k = 0; k < 8 && !box.empty(); ++k) {
        for (const float c : transformed(m, box.corner(k))) {
            if (!(std::fabs(c) < worldReach)) return false;
        }
    }
    return true;
}

bool goesOn(void* stage, double) {
    return !static_cast<const Stage*>(stage)->cancelled();
}

uint64_t triangleCountOf(const scene::Scene& scene) {
    uint64_t count = 0;
    for (const auto& mesh : scene.meshes) {
        for (const auto& primitive : mesh.primitives) count += primitive.triangleCount();
    }
    return count;
}

class Builder {
  public:
    Builder(const scene::Scene& scene, const WorldOptions& options, const Stage& stage, World::Data& to)
        : scene_(scene), options_(options), stage_(stage), to_(to) {}

    Status run() {
        to_.device.reset(rtcNewDevice(nullptr));
        if (!to_.device) return Error{ErrorKind::limit, "Embree cannot start on this machine"};
        rtcSetDeviceMemoryMonitorFunction(to_.device.get(), countMemory, &to_.embreeBytes);
        countSurfaces();
        boxes_.resize(scene_.meshes.size());
        triangles_.resize(scene_.meshes.size());
        for (const auto& mesh : scene_.meshes) {
            if (stage_.cancelled()) return stage_.status();
            addMesh(mesh);
        }
        if (stage_.cancelled()) return stage_.status();
        placeInstances();
        if (const Status whole = stage_.status(); !whole) return whole;
        placeGrids();
        note("triangles with vertices that are not finite, left out", droppedTriangles_);
        note("instances with transforms that are not finite, flatten to nothing or reach too far, left out",
             droppedInstances_);
        if (rtcGetDeviceError(to_.device.get()) == RTC_ERROR_NONE) return {};
        return Error{ErrorKind::limit, "the scene does not fit into memory under Embree"};
    }

  private:
    void commit(RTCScene scene) const {
        rtcSetSceneProgressMonitorFunction(scene, goesOn, const_cast<Stage*>(&stage_));
        rtcCommitScene(scene);
        rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
    }

    // Surfaces must not move once Embree knows them.
    void countSurfaces() {
        size_t count = 0;
        for (const auto& mesh : scene_.meshes) count += mesh.primitives.size();
        to_.surfaces.reserve(count);
    }

    void addMesh(const scene::Mesh& mesh) {
        const size_t number = to_.meshes.size();
        to_.firstSurface.push_back(static_cast<uint32_t>(to_.surfaces.size()));
        SceneOwner owner(rtcNewScene(to_.device.get()));
        rtcSetSceneFlags(owner.get(), RTC_SCENE_FLAG_ROBUST);
        for (const auto& primitive : mesh.primitives) {
            if (primitive.triangleCount() == 0 || !isWanted(primitive)) continue;
            addSurface(primitive, owner.get());
            for (const auto& position : primitive.positions) {
                if (isFinite(position)) boxes_[number].extend(position);
            }
            triangles_[number] += primitive.triangleCount();
        }
        if (triangles_[number] > 0) commit(owner.get());
        stage_.advance(triangles_[number]);
        to_.meshes.push_back(std::move(owner));
    }

    [[nodiscard]] bool isWanted(const scene::Primitive& primitive) const {
        if (options_.opaque) return true;
        return primitive.material >= 0 &&
               alphaKind(scene_.materials[static_cast<size_t>(primitive.material)]) != AlphaKind::opaque;
    }

    [[nodiscard]] AlphaKind alphaKind(const scene::Material& material) const {
        if (material.alphaMode == scene::AlphaMode::mask) return AlphaKind::mask;
        if (material.alphaMode == scene::AlphaMode::blend && options_.blend) return AlphaKind::blend;
        return AlphaKind::opaque;
    }

    void addSurface(const scene::Primitive& primitive, RTCScene scene) {
        Surface& surface = to_.surfaces.emplace_back();
        surface.primitive = &primitive;
        surface.indices = primitive.indices.data();
        if (!primitive.uvs.empty()) surface.uvs = primitive.uvs.data();
        if (!primitive.alphas.empty()) surface.vertexAlphas = primitive.alphas.data();
        surface.number = static_cast<uint32_t>(to_.surfaces.size() - 1);
        if (primitive.material >= 0) setMaterial(surface);
        RTCGeometry geometry = rtcNewGeometry(to_.device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
        copyVertices(primitive, geometry);
        rtcSetGeometryUserData(geometry, &surface);
        if (surface.kind != AlphaKind::opaque) {
            rtcSetGeometryIntersectFilterFunction(geometry, filterCandidate);
            rtcSetGeometryOccludedFilterFunction(geometry, filterCandidate);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
    }

    void copyVertices(const scene::Primitive& primitive, RTCGeometry geometry) {
        const size_t vertices = primitive.positions.size();
        const size_t triangles = primitive.triangleCount();
        auto* to = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices));
        auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), triangles));
        if (to == nullptr || indices == nullptr) return;  // Embree keeps the error
        for (const auto& position : primitive.positions) to = std::ranges::copy(position, to).out;
        std::ranges::copy(primitive.indices, indices);
        to_.geometryBytes += 12 * (vertices + triangles);
        for (size_t t = 0; t < triangles; ++t) {
            // Embree leaves such a triangle out of its hierarchy.
            const auto corners = std::span(primitive.indices).subspan(3 * t, 3);
            const bool kept = std::ranges::all_of(
                corners, [&](uint32_t vertex) { return isFinite(primitive.positions[vertex]); });
            droppedTriangles_ += kept ? 0 : 1;
        }
    }

    void setMaterial(Surface& surface) {
        const scene::Material& material = scene_.materials[static_cast<size_t>(surface.primitive->material)];
        surface.material = &material;
        surface.cutoff = material.cutoff;
        surface.factor = material.baseColourFactor[3];
        surface.kind = alphaKind(material);
        if (material.image < 0) return;
        const scene::Image& image = scene_.images[static_cast<size_t>(material.image)];
        const bool hasCoordinates = !surface.primitive->uvs.empty();
        if (image.colour && hasCoordinates) surface.colour = &*image.colour;
        if (surface.kind != AlphaKind::opaque && image.alpha && hasCoordinates)
            surface.alpha = samplerOf(material);
    }

    // One sampler for each image and way to sample it.
    const Sampler* samplerOf(const scene::Material& material) {
        const auto key = std::tuple(material.image, material.wrapU, material.wrapV, material.filter);
        const Sampler*& sampler = samplers_[key];
        if (sampler == nullptr) {
            const scene::Image& image = scene_.images[static_cast<size_t>(material.image)];
            const image::AlphaTexture texture{*image.alpha, material.wrapU, material.wrapV, material.filter};
            const bool amongColours = options_.alphaAmongColours && image.colour && image.alpha->steps == 255;
            to_.samplers.push_back(amongColours ? std::make_unique<Sampler>(texture, *image.colour)
                                                : std::make_unique<Sampler>(texture));
            sampler = to_.samplers.back().get();
        }
        return sampler;
    }

    void placeInstances() {
        to_.top.reset(rtcNewScene(to_.device.get()));
        rtcSetSceneFlags(to_.top.get(), RTC_SCENE_FLAG_ROBUST);
        for (const auto& instance : scene_.instances) {
            if (triangles_[instance.mesh] == 0) continue;
            if (!isUsable(instance.transform, boxes_[instance.mesh])) {
                ++droppedInstances_;
                continue;
            }
            place(instance);
        }
        commit(to_.top.get());
    }

    void place(const scene::Instance& instance) {
        RTCGeometry geometry = rtcNewGeometry(to_.device.get(), RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, to_.meshes[instance.mesh].get());
        rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, instance.transform.data());
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(to_.top.get(), geometry, static_cast<unsigned>(to_.placements.size()));
        rtcReleaseGeometry(geometry);
        to_.placements.push_back({instance.mesh, instance.transform});
        to_.triangleCount += triangles_[instance.mesh];
        const Box& box = boxes_[instance.mesh];
        if (box.empty()) return;
        for (unsigned k = 0; k < 8; ++k) to_.bounds.extend(transformed(instance.transform, box.corner(k)));
    }

    void placeGrids() {
        to_.grids = options_.grids;
        if (to_.grids.grids == nullptr) return;
        to_.triangleCount += to_.grids.triangles;
        to_.bounds.extend(boundsOf(to_.grids));
    }

    void note(std::string_view what, uint64_t count) {
        if (count > 0) to_.notes.push_back(fmt::format("{}: {}", what, count));
    }

    const scene::Scene& scene_;
    const WorldOptions& options_;
    const Stage& stage_;
    World::Data& to_;
    std::vector<Box> boxes_;           // by mesh, in its own space
    std::vector<uint64_t> triangles_;  // by mesh
    std::map<std::tuple<int, image::Wrap, image::Wrap, image::Filter>, const Sampler*> samplers_;
    uint64_t droppedTriangles_ = 0;
    uint64_t droppedInstances_ = 0;
};

}  // namespace

mesh::Uv Surface::coordinatesAt(uint32_t triangle, float u, float v) const {
    const mesh::UvTriangle t = primitive->uvTriangle(triangle);
    return {static_cast<float>(mixed(t.uv[0].u, t.uv[1].u, t.uv[2].u, u, v)),
            static_cast<float>(mixed(t.uv[0].v, t.uv[1].v, t.uv[2].v, u, v))};
}

Result<World> World::build(const scene::Scene& scene, const WorldOptions& options, ProgressSink& progress) {
    auto data = std::make_unique<Data>();
    const Stage stage(serialExecutor(), progress, "world", triangleCountOf(scene), "triangles");
    if (auto built = Builder(scene, options, stage, *data).run(); !built) return built.error();
    return World(std::move(data));
}

World::World(std::unique_ptr<Data> data) : data_(std::move(data)) {}
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

size_t World::surfaceCount() const {
    return data_->surfaces.size();
}
const scene::Primitive& World::primitive(size_t surface) const {
    return *data_->surfaces[surface].primitive;
}
bool World::isTested(size_t surface) const {
    return data_->surfaces[surface].kind != AlphaKind::opaque;
}
Box World::bounds() const {
    return data_->bounds;
}
uint64_t World::triangleCount() const {
    return data_->triangleCount;
}
const std::vector<std::string>& World::notes() const {
    return data_->notes;
}

World::Bytes World::bytes() const {
    Bytes bytes;
    bytes.geometry = data_->geometryBytes;
    const auto all = static_cast<uint64_t>(std::max<int64_t>(0, data_->embreeBytes));
    bytes.bvh = all - std::min(all, data_->geometryBytes);
    if (data_->grids.grids != nullptr) {
        const grid::GridBytes grids = bytesOf(*data_->grids.grids);
        bytes.geometry += grids.geometry + grids.clusters;
        bytes.bvh += grids.bvh;
    }
    for (const auto& sampler : data_->samplers) bytes.textures += sampler->bytes();
    return bytes;
}

}  // namespace filigree::trace
