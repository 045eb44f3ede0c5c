// What the writer and the checker of API blobs share: the names of docs/spec/raw.md.
#pragma once

#include "filigree/micromap/set.h"

#include "io/json.h"

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace filigree::io {

inline constexpr const char* manifestName = "manifest.json";
inline constexpr std::string_view blobFormat = "filigree-raw";
inline constexpr unsigned blobVersion = 1;
// VK_EXT_opacity_micromap asks for 256 bytes, VK_KHR_opacity_micromap and DXR 1.2 for 128.
inline constexpr size_t blobAlignment = 256;

// What the APIs call an index type.
struct IndexTypeNames {
    size_t bytes;
    const char* vulkan;
    const char* dxgi;
};
inline constexpr std::array<IndexTypeNames, 3> indexTypes{
    {{1, "VK_INDEX_TYPE_UINT8", "DXGI_FORMAT_R8_UINT"},
     {2, "VK_INDEX_TYPE_UINT16", "DXGI_FORMAT_R16_UINT"},
     {4, "VK_INDEX_TYPE_UINT32", "DXGI_FORMAT_R32_UINT"}}};

Json usageToJson(const std::vector<micromap::UsageCount>& usages);

}  // namespace filigree::io
