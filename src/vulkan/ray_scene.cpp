#include "filigree/vulkan/ray_scene.h"

#include "filigree/core/vec3.h"
#include "filigree/grid/record_boxes.h"

#include "vulkan/grid_words.h"
#include "vulkan/ray_scene_data.h"
#include "vulkan/scene_words.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace filigree::vulkan {
namespace {

constexpr VkBufferUsageFlags forBuilding =
    VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
    VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR;

// Builds the structures over the words of a scene.
class RaySceneBuilder {
  public:
    RaySceneBuilder(Device::Data& device, const scene::Scene& scene, const SceneWords& words,
                    RayScene::Data& to)
        : device_(device), scene_(scene), words_(words), to_(to) {}

    Status run() {
        structureOf_.assign(scene_.meshes.size(), noWord);
        for (size_t mesh = 0; mesh < scene_.meshes.size(); ++mesh) {
            if (words_.firstSurface[mesh] == words_.firstSurface[mesh + 1]) continue;
            auto built =
                Structure::build(device_, meshInput(mesh), fmt::format("the structure of mesh {}", mesh));
            if (!built) return built.error();
            structureOf_[mesh] = static_cast<uint32_t>(to_.meshes.size());
            to_.meshes.push_back(std::move(*built));
        }
        return buildTop();
    }

  private:
    [[nodiscard]] StructureInput meshInput(size_t mesh) const {
        StructureInput input;
        for (uint32_t k = words_.firstSurface[mesh]; k < words_.firstSurface[mesh + 1]; ++k) {
            input.geometries.push_back(geometryOf(k));
            input.counts.push_back(static_cast<uint32_t>(words_.primitives[k]->triangleCount()));
        }
        return input;
    }

    [[nodiscard]] VkAccelerationStructureGeometryKHR geometryOf(uint32_t number) const {
        const SurfaceWords& surface = words_.surfaces[number];
        VkAccelerationStructureGeometryKHR geometry{};
        geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
        geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
        geometry.flags = surface.kind == 0 ? VK_GEOMETRY_OPAQUE_BIT_KHR
                                           : VK_GEOMETRY_NO_DUPLICATE_ANY_HIT_INVOCATION_BIT_KHR;
        auto& triangles = geometry.geometry.triangles;
        triangles.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR;
        triangles.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
        triangles.vertexData.deviceAddress = to_.words.address() + 4ull * surface.positionsAt;
        triangles.vertexStride = 3 * sizeof(float);
        triangles.maxVertex = static_cast<uint32_t>(words_.primitives[number]->positions.size() - 1);
        triangles.indexType = VK_INDEX_TYPE_UINT32;
        triangles.indexData.deviceAddress = to_.words.address() + 4ull * surface.indicesAt;
        return geometry;
    }

    Status buildTop() {
        std::vector<VkAccelerationStructureInstanceKHR> instances;
        if (to_.grids) instances.push_back(placedGrids());
        for (const scene::Instance& instance : scene_.instances) {
            if (structureOf_[instance.mesh] != noWord && isPlaceable(instance.transform))
                instances.push_back(placed(instance));
        }
        const auto buffer = uploadedOf(device_, instances, "the instances", forBuilding);
        if (!buffer) return buffer.error();
        StructureInput input;
        input.type = VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR;
        auto& geometry = input.geometries.emplace_back();
        geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
        geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
        geometry.geometry.instances.sType =
            VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR;
        geometry.geometry.instances.data.deviceAddress = buffer->address();
        input.counts.push_back(static_cast<uint32_t>(instances.size()));
        auto built = Structure::build(device_, input, "the structure of all instances");
        if (!built) return built.error();
        to_.top.emplace(std::move(*built));
        return {};
    }

    static bool isPlaceable(const std::array<float, 16>& m) {
        const float volume =
            dot(Vec3{m[0], m[1], m[2]}, cross(Vec3{m[4], m[5], m[6]}, Vec3{m[8], m[9], m[10]}));
        return std::ranges::all_of(m, [](float x) { return std::isfinite(x); }) && std::isfinite(volume) &&
               volume != 0;
    }

    // Its number is that of the mesh's first surface; the geometry's number is added.
    [[nodiscard]] VkAccelerationStructureInstanceKHR placed(const scene::Instance& instance) const {
        VkAccelerationStructureInstanceKHR made{};
        for (size_t row = 0; row < 3; ++row) {
            for (size_t column = 0; column < 4; ++column)
                made.transform.matrix[row][column] = instance.transform[4 * column + row];
        }
        made.instanceCustomIndex = words_.firstSurface[instance.mesh] & 0xffffff;
        made.mask = 0xff;
        made.flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR;
        made.accelerationStructureReference = to_.meshes[structureOf_[instance.mesh]].address();
        return made;
    }

    // In world units, with the second record of shaders.
    [[nodiscard]] VkAccelerationStructureInstanceKHR placedGrids() const {
        VkAccelerationStructureInstanceKHR made{};
        for (size_t row = 0; row < 3; ++row) made.transform.matrix[row][row] = 1;
        made.mask = 0xff;
        made.instanceShaderBindingTableRecordOffset = 1;
        made.accelerationStructureReference = to_.grids->address();
        return made;
    }

    Device::Data& device_;
    const scene::Scene& scene_;
    const SceneWords& words_;
    RayScene::Data& to_;
    std::vector<uint32_t> structureOf_;  // [mesh_count], noWord: without triangles
};

// The structure over the boxes of records.
Result<Structure> buildGrids(Device::Data& device, const std::vector<VkAabbPositionsKHR>& boxes) {
    const auto buffer = uploadedOf(device, boxes, "the boxes of the grids", forBuilding);
    if (!buffer) return buffer.error();
    StructureInput input;
    auto& geometry = input.geometries.emplace_back();
    geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
    geometry.geometryType = VK_GEOMETRY_TYPE_AABBS_KHR;
    geometry.flags = VK_GEOMETRY_OPAQUE_BIT_KHR;
    auto& aabbs = geometry.geometry.aabbs;
    aabbs.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_AABBS_DATA_KHR;
    aabbs.data.deviceAddress = buffer->address();
    aabbs.stride = sizeof(VkAabbPositionsKHR);
    input.counts.push_back(static_cast<uint32_t>(boxes.size()));
    return Structure::build(device, input, "the structure of the grids");
}

// Puts the grids behind the scene's words and builds their structure.
Status addGrids(Device::Data& device, const GridPart& part, const Executor& executor, SceneWords& words,
                RayScene::Data& to) {
    if (part.grids->codec != grid::Codec::lattice)
        return Error{ErrorKind::unsupported,
                     "grids of the codec paper have no shader; give some of the codec lattice"};
    const std::vector<Box> boxes = recordBoxes(*part.grids, executor);
    const size_t before = words.words.size();
    const auto at = appendGrids(part, boxes, words.words);
    if (!at) return at.error();
    to.gridsAt = *at;
    to.gridWordBytes = (words.words.size() - before) * sizeof(uint32_t);
    auto built = buildGrids(device, gridAabbs(part.grids->lattice, boxes));
    if (!built) return built.error();
    to.grids.emplace(std::move(*built));
    return {};
}

}  // namespace

Result<RayScene> RayScene::build(const Device& device, const scene::Scene& scene,
                                 const RaySceneOptions& options, const Executor& executor) {
    if (auto path = chooseRayPath(device.facts(), {}); !path) return path.error();
    auto words = sceneWords(scene, options.opaque);
    if (!words) return words.error();
    if (words->surfaces.size() >= uint32_t{1} << 24)
        return Error{ErrorKind::limit, fmt::format("{} primitives; a device tells fewer than 2^24 apart",
                                                   words->surfaces.size())};
    auto data = std::make_unique<Data>();
    if (options.grids.grids != nullptr) {
        auto added = addGrids(device.data(), options.grids, executor, *words, *data);
        if (!added) return added.error();
    }
    auto uploadedWords = uploadedOf(device.data(), words->words, "the scene", forBuilding);
    if (!uploadedWords) return uploadedWords.error();
    data->words = std::move(*uploadedWords);
    if (auto built = RaySceneBuilder(device.data(), scene, *words, *data).run(); !built) return built.error();
    data->primitives = std::move(words->primitives);
    return RayScene(std::move(data));
}

RayScene::RayScene(std::unique_ptr<Data> data) : data_(std::move(data)) {}
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;
RayScene::~RayScene() = default;

size_t RayScene::surfaceCount() const {
    return data_->primitives.size();
}

const scene::Primitive& RayScene::primitive(size_t surface) const {
    return *data_->primitives[surface];
}

RayScene::Bytes RayScene::bytes() const {
    Bytes bytes{data_->words.size(), data_->top->bytes()};
    for (const Structure& mesh : data_->meshes) bytes.structures += mesh.bytes();
    if (data_->grids) {
        bytes.gridWords = data_->gridWordBytes;
        bytes.gridStructures = data_->grids->bytes();
        bytes.structures += bytes.gridStructures;
    }
    return bytes;
}

}  // namespace filigree::vulkan
