#include "filigree/vulkan/ray_scene.h"

#include "filigree/grid/record_boxes.h"

#include "vulkan/grid_words.h"
#include "vulkan/ray_scene_data.h"

#include <fmt/format.h>

namespace filigree::vulkan {
namespace {

// The structure over the boxes of records.
Result<Structure> buildGrids(Device::Data& device, const std::vector<VkAabbPositionsKHR>& boxes) {
    const auto buffer = uploadedOf(device, boxes, "the boxes of the grids", buildInput);
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
    auto uploadedWords = uploadedOf(device.data(), words->words, "the scene", buildInput);
    if (!uploadedWords) return uploadedWords.error();
    data->words = std::move(*uploadedWords);
    words->words = {};
    data->scene = &scene;
    data->layout = std::move(*words);
    auto structures = RayStructures::build(device.data(), data->source(), {});
    if (!structures) return structures.error();
    data->structures = std::move(*structures);
    return RayScene(std::move(data));
}

RayScene::RayScene(std::unique_ptr<Data> data) : data_(std::move(data)) {}
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;
RayScene::~RayScene() = default;

size_t RayScene::surfaceCount() const {
    return data_->layout.primitives.size();
}

const scene::Primitive& RayScene::primitive(size_t surface) const {
    return *data_->layout.primitives[surface];
}

RayScene::Bytes RayScene::bytes() const {
    Bytes bytes{data_->words.size(), data_->structures.bytes()};
    if (data_->grids) {
        bytes.gridWords = data_->gridWordBytes;
        bytes.gridStructures = data_->grids->bytes();
        bytes.structures += bytes.gridStructures;
    }
    return bytes;
}

}  // namespace filigree::vulkan
