#include "vulkan/ray_structures.h"

#include "filigree/core/vec3.h"

#include "vulkan/hardware_maps.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace filigree::vulkan {
namespace {

// Builds the structures over the words of a scene.
class StructuresBuilder {
  public:
    StructuresBuilder(Device::Data& device, const StructureSource& source, const StructureOptions& options)
        : device_(device),
          scene_(source.scene),
          layout_(source.layout),
          words_(source.words.address()),
          grids_(source.grids),
          options_(options) {}

    Result<RayStructures> run() {
        structureOf_.assign(scene_.meshes.size(), noWord);
        for (size_t mesh = 0; mesh < scene_.meshes.size(); ++mesh) {
            if (layout_.firstSurface[mesh] == layout_.firstSurface[mesh + 1]) continue;
            auto built =
                Structure::build(device_, meshInput(mesh), fmt::format("the structure of mesh {}", mesh));
            if (!built) return built.error();
            structureOf_[mesh] = static_cast<uint32_t>(made_.meshes.size());
            made_.meshes.push_back(std::move(*built));
        }
        if (auto built = buildTop(); !built) return built.error();
        return std::move(made_);
    }

  private:
    [[nodiscard]] StructureInput meshInput(size_t mesh) const {
        StructureInput input;
        input.flags = options_.flags;
        for (uint32_t k = layout_.firstSurface[mesh]; k < layout_.firstSurface[mesh + 1]; ++k) {
            input.geometries.push_back(geometryOf(k));
            input.counts.push_back(static_cast<uint32_t>(layout_.primitives[k]->triangleCount()));
        }
        return input;
    }

    [[nodiscard]] VkAccelerationStructureGeometryKHR geometryOf(uint32_t number) const {
        const SurfaceWords& surface = layout_.surfaces[number];
        VkAccelerationStructureGeometryKHR geometry{};
        geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
        geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
        geometry.flags = surface.kind == 0 ? VK_GEOMETRY_OPAQUE_BIT_KHR
                                           : VK_GEOMETRY_NO_DUPLICATE_ANY_HIT_INVOCATION_BIT_KHR;
        auto& triangles = geometry.geometry.triangles;
        triangles.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR;
        triangles.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
        triangles.vertexData.deviceAddress = words_ + 4ull * surface.positionsAt;
        triangles.vertexStride = 3 * sizeof(float);
        triangles.maxVertex = static_cast<uint32_t>(layout_.primitives[number]->positions.size() - 1);
        triangles.indexType = VK_INDEX_TYPE_UINT32;
        triangles.indexData.deviceAddress = words_ + 4ull * surface.indicesAt;
        if (options_.maps != nullptr) options_.maps->attach(number, triangles);
        return geometry;
    }

    Status buildTop() {
        std::vector<VkAccelerationStructureInstanceKHR> instances;
        if (grids_ != nullptr) instances.push_back(placedGrids());
        for (const scene::Instance& instance : scene_.instances) {
            if (structureOf_[instance.mesh] != noWord && isPlaceable(instance.transform))
                instances.push_back(placed(instance));
        }
        const auto buffer = uploadedOf(device_, instances, "the instances", buildInput);
        if (!buffer) return buffer.error();
        StructureInput input;
        input.type = VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR;
        input.flags = options_.flags;
        auto& geometry = input.geometries.emplace_back();
        geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
        geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
        geometry.geometry.instances.sType =
            VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR;
        geometry.geometry.instances.data.deviceAddress = buffer->address();
        input.counts.push_back(static_cast<uint32_t>(instances.size()));
        auto built = Structure::build(device_, input, "the structure of all instances");
        if (!built) return built.error();
        made_.top.emplace(std::move(*built));
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
        made.instanceCustomIndex = layout_.firstSurface[instance.mesh] & 0xffffff;
        made.mask = 0xff;
        made.flags =
            (VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR | options_.instanceFlags) & 0xff;
        made.accelerationStructureReference = made_.meshes[structureOf_[instance.mesh]].address();
        return made;
    }

    // In world units, with the second record of shaders.
    [[nodiscard]] VkAccelerationStructureInstanceKHR placedGrids() const {
        VkAccelerationStructureInstanceKHR made{};
        for (size_t row = 0; row < 3; ++row) made.transform.matrix[row][row] = 1;
        made.mask = 0xff;
        made.instanceShaderBindingTableRecordOffset = 1;
        made.accelerationStructureReference = grids_->address();
        return made;
    }

    Device::Data& device_;
    const scene::Scene& scene_;
    const SceneWords& layout_;
    VkDeviceAddress words_;
    const Structure* grids_;
    const StructureOptions& options_;
    RayStructures made_;
    std::vector<uint32_t> structureOf_;  // [mesh_count], noWord: without triangles
};

}  // namespace

Result<RayStructures> RayStructures::build(Device::Data& device, const StructureSource& source,
                                           const StructureOptions& options) {
    return StructuresBuilder(device, source, options).run();
}

uint64_t RayStructures::bytes() const {
    uint64_t bytes = top->bytes();
    for (const Structure& mesh : meshes) bytes += mesh.bytes();
    return bytes;
}

}  // namespace filigree::vulkan
