// Micromaps that the device itself looks into: those of VK_EXT_opacity_micromap or VK_KHR_opacity_micromap.
#pragma once

#include "filigree/vulkan/picture.h"

#include "vulkan/micromap_api.h"
#include "vulkan/micromap_input.h"
#include "vulkan/structure.h"

#include <optional>
#include <vector>

namespace filigree::vulkan {

// A micromap of EXT on the device; of KHR it is a Structure.
class MicromapExt {
  public:
    // `data` and `records` at addresses that are multiples of 256. Built when the call returns.
    static Result<MicromapExt> build(Device::Data& device, const Buffer& data, const Buffer& records,
                                     const std::vector<VkMicromapUsageEXT>& usages, StructureBuild build);
    MicromapExt(MicromapExt&& other) noexcept;
    MicromapExt& operator=(MicromapExt&& other) noexcept;
    ~MicromapExt();

    [[nodiscard]] VkMicromapEXT get() const { return handle_; }
    [[nodiscard]] uint64_t bytes() const { return storage_.size(); }

  private:
    MicromapExt() = default;
    Device::Data* device_ = nullptr;
    Buffer storage_;
    VkMicromapEXT handle_ = VK_NULL_HANDLE;
};

// A method's maps on the device. Structures that they are attached to need them as long as rays are traced.
class HardwareMaps {
  public:
    // The method's set is flat and checked. ErrorKind::unsupported where levels are above the device's.
    static Result<HardwareMaps> make(Device::Data& device, const Method& method);

    // Chains what the triangles of a surface find, if they find anything, to what their structure is built
    // from. The chain looks into this, which must stay where it is until the structure is built.
    void attach(size_t surface, VkAccelerationStructureGeometryTrianglesDataKHR& triangles);

    // Of the micromap and all triangles' indices.
    [[nodiscard]] uint64_t bytes() const;

  private:
    HardwareMaps() = default;
    [[nodiscard]] bool hasMaps(size_t surface) const;
    Status build(Device::Data& device, const encoding::EncodedView& set, StructureBuild build);
    void link(const Method& method);
    void linkExt(const Method& method);
    void linkKhr();

    MicromapApi api_ = MicromapApi::none;
    std::vector<micromap::Record> records_;
    std::optional<MicromapExt> ext_;  // one of the two, and neither where all indices are special
    std::optional<Structure> khr_;
    MicromapIndices layout_;
    std::vector<bool> hasMaps_;  // [surface_count]
    Buffer indices_;
    std::vector<std::vector<VkMicromapUsageEXT>> usages_;                       // [surface_count], of EXT
    std::vector<VkAccelerationStructureTrianglesOpacityMicromapEXT> linksExt_;  // [surface_count]
    std::vector<TrianglesMicromapKhr> linksKhr_;                                // [surface_count]
};

VkBuildAccelerationStructureFlagsKHR structureFlagsOf(StructureBuild build);

}  // namespace filigree::vulkan
