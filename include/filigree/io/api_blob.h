// Micromaps as files that a Vulkan or DXR 1.2 program uploads as they are (docs/spec/raw.md).
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/result.h"
#include "filigree/io/breach.h"
#include "filigree/io/gltf_write.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace filigree::io {

// Writes data, records, indices and usage counts of `output` to `folder` with a manifest.json; `source` names
// in it the file that they belong to. The folder appears whole or not at all. An earlier folder of blobs is
// replaced; any other folder with files in it is an error.
FILIGREE_API Status writeApiBlobs(const std::filesystem::path& folder, const MicromapOutput& output,
                                  const std::string& source);

// One file of such a folder, in memory.
struct ApiBlob {
    std::string name;  // manifest.json, or as the manifest names it
    std::vector<uint8_t> bytes;
};

// The files of that folder; the last is manifest.json. ErrorKind::usage where `output` does not agree with
// itself.
FILIGREE_API Result<std::vector<ApiBlob>> encodeApiBlobs(const MicromapOutput& output,
                                                         const std::string& source);

// Checks a folder of blobs by the rules of docs/spec/raw.md; paths in breaches are those of the manifest. An
// error means that the manifest cannot be read at all.
FILIGREE_API Result<std::vector<Breach>> checkApiBlobs(const std::filesystem::path& folder);
FILIGREE_API Result<std::vector<Breach>> checkApiBlobs(std::span<const ApiBlob> blobs);

}  // namespace filigree::io
