// glTF 2.0 files out: a document with micromaps attached (docs/spec/gltf.md).
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/result.h"
#include "filigree/image/alpha_image.h"
#include "filigree/io/gltf.h"
#include "filigree/micromap/set.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace filigree::io {

// One micromap array of the root extension. `set` is not owned; its indices are not used.
struct OutputMicromaps {
    std::string name;                        // may be empty
    const micromap::FlatSet* set = nullptr;  // at least one record, regions of the data apart from each other
    std::optional<image::AlphaTest> test;    // recorded under extras.filigree where it is known
};

// What one primitive of the file gets.
struct OutputPrimitive {
    unsigned mesh = 0;                 // into glTF meshes
    unsigned primitive = 0;            // into that mesh's primitives
    size_t micromaps = 0;              // into MicromapOutput::micromaps
    std::span<const int32_t> indices;  // [triangle_count], a record or special (-1..-4)
    std::span<const uint32_t>
        vertexIndices;  // [3 * triangle_count] to replace the primitive's; empty: they stay
};

// All micromaps that a file gets.
struct MicromapOutput {
    std::vector<OutputMicromaps> micromaps;
    std::vector<OutputPrimitive> primitives;
};

// Writes `document` with EXT_mesh_opacity_micromap to `path`, GLB unless it ends in .gltf, whole or not at
// all. Everything else in the document stays. A GLB holds all its buffers and images; a .gltf keeps its
// relative files, their paths made right for the new folder, and holds the new buffer itself. Micromaps that
// a primitive had before are replaced. Fails with ErrorKind::limit where a GLB would pass 4 GiB, and with
// ErrorKind::file.
FILIGREE_API Status writeWithMicromaps(const GltfDocument& document, const MicromapOutput& output,
                                       const std::filesystem::path& path);

// The GLB of that in memory.
FILIGREE_API Result<std::vector<uint8_t>> encodeWithMicromaps(const GltfDocument& document,
                                                              const MicromapOutput& output);

}  // namespace filigree::io
