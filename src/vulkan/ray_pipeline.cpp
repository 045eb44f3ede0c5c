#include "vulkan/ray_pipeline.h"

#include "vulkan/stage.h"

#include <algorithm>
#include <cstring>

namespace filigree::vulkan {
namespace {

constexpr VkShaderStageFlags rayStages =
    VK_SHADER_STAGE_RAYGEN_BIT_KHR | VK_SHADER_STAGE_MISS_BIT_KHR | VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR |
    VK_SHADER_STAGE_ANY_HIT_BIT_KHR | VK_SHADER_STAGE_INTERSECTION_BIT_KHR;

constexpr VkBufferUsageFlags forTable =
    VK_BUFFER_USAGE_SHADER_BINDING_TABLE_BIT_KHR | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;

// Collects shaders and their groups: 0 the ray generation, 1 the miss, and the kinds of geometry.
class PipelineMaker {
  public:
    PipelineMaker(Device::Data& device, const RayShaders& shaders, std::span<const uint32_t> constants)
        : device_(device), shaders_(shaders), constants_(constants) {}

    Result<OwnedPipeline> run(VkPipelineLayout layout) {
        addGeneral(shaders_.generation, VK_SHADER_STAGE_RAYGEN_BIT_KHR);
        addGeneral(shaders_.miss, VK_SHADER_STAGE_MISS_BIT_KHR);
        for (const HitShaders& hit : shaders_.hits) addHit(hit);
        if (!status_) return status_.error();
        std::vector<VkPipelineShaderStageCreateInfo> infos;
        std::ranges::transform(stages_, std::back_inserter(infos), &Stage::info);
        VkRayTracingPipelineCreateInfoKHR info{};
        info.sType = VK_STRUCTURE_TYPE_RAY_TRACING_PIPELINE_CREATE_INFO_KHR;
        info.flags = shaders_.flags;
        info.stageCount = static_cast<uint32_t>(infos.size());
        info.pStages = infos.data();
        info.groupCount = static_cast<uint32_t>(groups_.size());
        info.pGroups = groups_.data();
        info.maxPipelineRayRecursionDepth = 1;
        info.layout = layout;
        VkPipeline made = VK_NULL_HANDLE;
        const VkResult result = device_.rayPipelines.create(device_.device.get(), VK_NULL_HANDLE,
                                                            VK_NULL_HANDLE, 1, &info, nullptr, &made);
        if (auto status = checked(result, "compile the ray-tracing shaders"); !status) return status.error();
        return OwnedPipeline(device_.device.get(), made);
    }

    [[nodiscard]] uint32_t groupCount() const { return static_cast<uint32_t>(groups_.size()); }

  private:
    uint32_t addStage(Shader shader, VkShaderStageFlagBits stage) {
        auto made = Stage::make(device_, shader, stage, constants_);
        if (!made) {
            status_ = made.error();
            return VK_SHADER_UNUSED_KHR;
        }
        stages_.push_back(std::move(*made));
        return static_cast<uint32_t>(stages_.size() - 1);
    }
    uint32_t addStage(const std::optional<Shader>& shader, VkShaderStageFlagBits stage) {
        return shader ? addStage(*shader, stage) : VK_SHADER_UNUSED_KHR;
    }

    VkRayTracingShaderGroupCreateInfoKHR& addGroup(VkRayTracingShaderGroupTypeKHR type) {
        auto& group = groups_.emplace_back();
        group.sType = VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR;
        group.type = type;
        group.generalShader = VK_SHADER_UNUSED_KHR;
        group.closestHitShader = VK_SHADER_UNUSED_KHR;
        group.anyHitShader = VK_SHADER_UNUSED_KHR;
        group.intersectionShader = VK_SHADER_UNUSED_KHR;
        return group;
    }

    void addGeneral(Shader shader, VkShaderStageFlagBits stage) {
        addGroup(VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR).generalShader = addStage(shader, stage);
    }

    void addHit(const HitShaders& hit) {
        auto& group = addGroup(hit.intersection ? VK_RAY_TRACING_SHADER_GROUP_TYPE_PROCEDURAL_HIT_GROUP_KHR
                                                : VK_RAY_TRACING_SHADER_GROUP_TYPE_TRIANGLES_HIT_GROUP_KHR);
        group.closestHitShader = addStage(hit.closest, VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR);
        group.anyHitShader = addStage(hit.any, VK_SHADER_STAGE_ANY_HIT_BIT_KHR);
        group.intersectionShader = addStage(hit.intersection, VK_SHADER_STAGE_INTERSECTION_BIT_KHR);
    }

    Device::Data& device_;
    const RayShaders& shaders_;
    std::span<const uint32_t> constants_;
    std::vector<Stage> stages_;
    std::vector<VkRayTracingShaderGroupCreateInfoKHR> groups_;
    Status status_;
};

uint32_t roundedUp(uint32_t value, uint32_t multiple) {
    return (value + multiple - 1) / multiple * multiple;
}

// Where the groups stand in the table. Every part begins at the device's base alignment.
struct TableLayout {
    uint32_t handle = 0;  // bytes
    uint32_t stride = 0;  // of kinds of geometry
    uint32_t part = 0;    // bytes of the first two parts

    TableLayout(const RayPipelineFunctions& limits)
        : handle(limits.handleBytes),
          stride(roundedUp(handle, limits.handleAlignment)),
          part(roundedUp(handle, limits.baseAlignment)) {}
    [[nodiscard]] uint32_t placeOf(uint32_t group) const {
        return group < 2 ? group * part : 2 * part + (group - 2) * stride;
    }
};

Result<std::vector<uint8_t>> tableOf(Device::Data& device, VkPipeline pipeline, uint32_t groups,
                                     const TableLayout& layout) {
    std::vector<uint8_t> handles(size_t{groups} * layout.handle);
    auto status = checked(
        device.rayPipelines.handles(device.device.get(), pipeline, 0, groups, handles.size(), handles.data()),
        "name the ray-tracing shaders");
    if (!status) return status.error();
    std::vector<uint8_t> table(layout.placeOf(groups));
    for (uint32_t k = 0; k < groups; ++k)
        std::memcpy(&table[layout.placeOf(k)], &handles[size_t{k} * layout.handle], layout.handle);
    return table;
}

}  // namespace

Result<RayPipeline> RayPipeline::make(Device::Data& device, const RayShaders& shaders,
                                      const BindingShape& shape, std::span<const uint32_t> constants) {
    auto bindings = Bindings::make(device, shape, rayStages);
    if (!bindings) return bindings.error();
    PipelineMaker maker(device, shaders, constants);
    auto pipeline = maker.run(bindings->layout());
    if (!pipeline) return pipeline.error();
    const TableLayout layout(device.rayPipelines);
    const auto bytes = tableOf(device, pipeline->get(), maker.groupCount(), layout);
    if (!bytes) return bytes.error();
    auto table =
        uploaded(device, *bytes, "the table of shaders", forTable, 0, device.rayPipelines.baseAlignment);
    if (!table) return table.error();
    RayPipeline made;
    made.trace_ = device.rayPipelines.trace;
    made.bindings_ = std::move(*bindings);
    made.pipeline_ = std::move(*pipeline);
    made.table_ = std::move(*table);
    const VkDeviceAddress first = made.table_.address();
    made.generation_ = {first, layout.part, layout.part};
    made.miss_ = {first + layout.placeOf(1), layout.stride, layout.stride};
    made.hits_ = {first + layout.placeOf(2), layout.stride, layout.stride * shaders.hits.size()};
    return made;
}

void RayPipeline::record(VkCommandBuffer commands, const void* push, uint32_t width, uint32_t height) const {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR, pipeline_.get());
    bindings_.record(commands, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR, push);
    trace_(commands, &generation_, &miss_, &hits_, &callable_, width, height, 1);
}

}  // namespace filigree::vulkan
