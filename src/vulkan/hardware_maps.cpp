#include "vulkan/hardware_maps.h"

#include "vulkan/commands.h"

#include <utility>

namespace filigree::vulkan {
namespace {

// Of data and records: EXT asks for 256 bytes, KHR for 128.
constexpr uint64_t inputAlignment = 256;
constexpr VkBufferUsageFlags micromapInput =
    VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT | VK_BUFFER_USAGE_MICROMAP_BUILD_INPUT_READ_ONLY_BIT_EXT;
constexpr VkBufferUsageFlags micromapStorage =
    VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT | VK_BUFFER_USAGE_MICROMAP_STORAGE_BIT_EXT;

VkMicromapBuildInfoEXT buildInfoOf(const Buffer& data, const Buffer& records,
                                   const std::vector<VkMicromapUsageEXT>& usages, StructureBuild build) {
    VkMicromapBuildInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_MICROMAP_BUILD_INFO_EXT;
    info.type = VK_MICROMAP_TYPE_OPACITY_MICROMAP_EXT;
    info.flags = build == StructureBuild::fastTrace ? VK_BUILD_MICROMAP_PREFER_FAST_TRACE_BIT_EXT
                                                    : VK_BUILD_MICROMAP_PREFER_FAST_BUILD_BIT_EXT;
    info.mode = VK_BUILD_MICROMAP_MODE_BUILD_EXT;
    info.usageCountsCount = static_cast<uint32_t>(usages.size());
    info.pUsageCounts = usages.data();
    info.data.deviceAddress = data.address();
    info.triangleArray.deviceAddress = records.address();
    info.triangleArrayStride = micromap::recordBytes;
    return info;
}

Result<Structure> buildKhr(Device::Data& device, const Buffer& data, const Buffer& records,
                           const std::vector<VkMicromapUsageEXT>& usages, uint32_t mapCount,
                           StructureBuild build) {
    GeometryMicromapDataKhr maps;
    maps.usageCountsCount = static_cast<uint32_t>(usages.size());
    maps.pUsageCounts = usages.data();
    maps.data = data.address();
    maps.triangleArray = records.address();
    maps.triangleArrayStride = micromap::recordBytes;
    StructureInput input;
    input.type = micromapStructureKhr;
    input.flags = structureFlagsOf(build);
    auto& geometry = input.geometries.emplace_back();
    geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
    geometry.pNext = &maps;
    geometry.geometryType = micromapGeometryKhr;
    input.counts.push_back(mapCount);
    return Structure::build(device, input, "the micromaps");
}

}  // namespace

VkBuildAccelerationStructureFlagsKHR structureFlagsOf(StructureBuild build) {
    return build == StructureBuild::fastTrace ? VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR
                                              : VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_BUILD_BIT_KHR;
}

Result<MicromapExt> MicromapExt::build(Device::Data& device, const Buffer& data, const Buffer& records,
                                       const std::vector<VkMicromapUsageEXT>& usages, StructureBuild build) {
    VkMicromapBuildInfoEXT info = buildInfoOf(data, records, usages, build);
    VkMicromapBuildSizesInfoEXT sizes{};
    sizes.sType = VK_STRUCTURE_TYPE_MICROMAP_BUILD_SIZES_INFO_EXT;
    device.micromaps.sizes(device.device.get(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info,
                           &sizes);
    MicromapExt made;
    auto storage =
        Buffer::make(device, sizes.micromapSize, BufferPlace::onDevice, "the micromaps", micromapStorage);
    if (!storage) return storage.error();
    made.storage_ = std::move(*storage);
    const auto scratch =
        Buffer::make(device, sizes.buildScratchSize, BufferPlace::onDevice, "building micromaps",
                     VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                     device.scratchAlignment);
    if (!scratch) return scratch.error();
    VkMicromapCreateInfoEXT create{};
    create.sType = VK_STRUCTURE_TYPE_MICROMAP_CREATE_INFO_EXT;
    create.buffer = made.storage_.get();
    create.size = sizes.micromapSize;
    create.type = VK_MICROMAP_TYPE_OPACITY_MICROMAP_EXT;
    auto status = checked(device.micromaps.create(device.device.get(), &create, nullptr, &made.handle_),
                          "make the micromaps");
    if (!status) return status.error();
    made.device_ = &device;
    info.dstMicromap = made.handle_;
    info.scratchData.deviceAddress = scratch->address();
    status = submit(device, "build the micromaps",
                    [&](VkCommandBuffer commands) { device.micromaps.build(commands, 1, &info); });
    if (!status) return status.error();
    return made;
}

MicromapExt::MicromapExt(MicromapExt&& other) noexcept {
    *this = std::move(other);
}

MicromapExt& MicromapExt::operator=(MicromapExt&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(storage_, other.storage_);
    std::swap(handle_, other.handle_);
    return *this;
}

MicromapExt::~MicromapExt() {
    if (handle_ != VK_NULL_HANDLE) device_->micromaps.destroy(device_->device.get(), handle_, nullptr);
}

Result<HardwareMaps> HardwareMaps::make(Device::Data& device, const Method& method) {
    HardwareMaps made;
    made.api_ = device.micromaps.api;
    made.records_ = recordsOf(*method.set);
    if (auto good = checkLevels(made.records_, device.micromaps.limits); !good) return good.error();
    if (auto built = made.build(device, *method.set, method.build); !built) return built.error();
    made.layout_ = micromapIndices(method.surfaces, method.set->mapCount, method.states);
    auto indices = uploaded(device, made.layout_.bytes, "the triangles' maps", buildInput, 0, 16);
    if (!indices) return indices.error();
    made.indices_ = std::move(*indices);
    made.link(method);
    return made;
}

Status HardwareMaps::build(Device::Data& device, const encoding::EncodedView& set, StructureBuild build) {
    if (records_.empty()) return {};
    const VkBufferUsageFlags usage = api_ == MicromapApi::ext ? micromapInput : buildInput;
    const auto data = uploaded(device, set.payload, "micromaps", usage, 8, inputAlignment);
    if (!data) return data.error();
    const auto records = uploaded(device, set.descriptors, "records of micromaps", usage, 8, inputAlignment);
    if (!records) return records.error();
    const auto usages = usagesOf(micromap::usageCounts(records_));
    if (api_ == MicromapApi::ext) {
        auto built = MicromapExt::build(device, *data, *records, usages, build);
        if (!built) return built.error();
        ext_.emplace(std::move(*built));
        return {};
    }
    auto built = buildKhr(device, *data, *records, usages, set.mapCount, build);
    if (!built) return built.error();
    khr_.emplace(std::move(*built));
    return {};
}

void HardwareMaps::link(const Method& method) {
    for (const SurfaceMaps& surface : method.surfaces) hasMaps_.push_back(!surface.indices.empty());
    if (api_ == MicromapApi::ext) {
        linkExt(method);
    } else {
        linkKhr();
    }
}

void HardwareMaps::linkExt(const Method& method) {
    for (size_t k = 0; k < hasMaps_.size(); ++k)
        usages_.push_back(usagesOf(micromap::usageByTriangles(method.surfaces[k].indices, records_)));
    for (size_t k = 0; k < hasMaps_.size(); ++k) {
        VkAccelerationStructureTrianglesOpacityMicromapEXT& link = linksExt_.emplace_back();
        link.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_TRIANGLES_OPACITY_MICROMAP_EXT;
        link.indexType = layout_.type;
        link.indexBuffer.deviceAddress = indices_.address() + layout_.firstBytes[k];
        link.indexStride = layout_.stride;
        link.usageCountsCount = static_cast<uint32_t>(usages_[k].size());
        link.pUsageCounts = usages_[k].data();
        link.micromap = ext_ ? ext_->get() : VK_NULL_HANDLE;
    }
}

void HardwareMaps::linkKhr() {
    for (size_t k = 0; k < hasMaps_.size(); ++k) {
        TrianglesMicromapKhr& link = linksKhr_.emplace_back();
        link.indexType = layout_.type;
        link.indexBuffer = indices_.address() + layout_.firstBytes[k];
        link.indexStride = layout_.stride;
        link.micromap = khr_ ? khr_->get() : VK_NULL_HANDLE;
    }
}

bool HardwareMaps::hasMaps(size_t surface) const {
    return surface < hasMaps_.size() && hasMaps_[surface];
}

void HardwareMaps::attach(size_t surface, VkAccelerationStructureGeometryTrianglesDataKHR& triangles) {
    if (!hasMaps(surface)) return;
    triangles.pNext = api_ == MicromapApi::ext ? static_cast<const void*>(&linksExt_[surface])
                                               : static_cast<const void*>(&linksKhr_[surface]);
}

uint64_t HardwareMaps::bytes() const {
    return (ext_ ? ext_->bytes() : 0) + (khr_ ? khr_->bytes() : 0) + layout_.bytes.size();
}

}  // namespace filigree::vulkan
