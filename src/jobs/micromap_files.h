// The files that hold flat micromaps.
#pragma once

#include "filigree/core/result.h"
#include "filigree/io/gltf.h"
#include "filigree/io/gltf_write.h"

#include <filesystem>

namespace filigree::jobs {

// Writes `document` with the micromaps to `file` and blobs of them to `rawFolder`, each where it is not
// empty. On an error neither is left.
Status writeMicromapFiles(const io::GltfDocument& document, const io::MicromapOutput& output,
                          const std::filesystem::path& file, const std::filesystem::path& rawFolder);

}  // namespace filigree::jobs
