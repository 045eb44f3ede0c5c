// The inside of GltfDocument: its JSON, its buffers, and bounded access to them.
#pragma once

#include "filigree/io/gltf.h"

#include "io/glb.h"
#include "io/json.h"

#include <optional>
#include <span>
#include <string_view>

namespace filigree::io {

// Both names of the extension, newest first. The second is an earlier draft's and is only read.
inline constexpr std::array<const char*, 2> micromapExtensions{"EXT_mesh_opacity_micromap",
                                                               "KHR_mesh_opacity_micromap"};

// A buffer of the document. `bytes` are its byteLength bytes, or `missing` says why there are none.
struct Buffer {
    std::span<const uint8_t> bytes;
    std::optional<Error> missing;
};

struct GltfDocument::Data {
    Json json;
    std::string name;
    std::filesystem::path folder;             // relative URIs start here
    bool binary = false;                      // came as GLB
    std::vector<uint8_t> file;                // a GLB's bytes where they are ours, which the rest looks into
    std::vector<std::vector<uint8_t>> owned;  // buffers from data URIs and files
    std::vector<Buffer> buffers;
    std::vector<GlbChunk> others;

    // A top-level list such as "accessors"; an empty one when the document has none. Loading has made sure
    // that it is an array.
    [[nodiscard]] const Json& list(const char* key) const;

    // A reader for one item of a top-level list.
    [[nodiscard]] ObjectReader item(const char* key, size_t index) const;

    // The root extension object of that name, or null.
    [[nodiscard]] const Json* rootExtension(const char* extension) const;
};

// The member `key` of an object, or null.
const Json* memberOf(const Json& object, std::string_view key);

// The extension object that `owner` carries under "extensions", or null.
const Json* extensionOf(const Json& owner, const char* extension);

// True when the document lists `extension` under `key` ("extensionsUsed", "extensionsRequired").
bool listsExtension(const Json& document, const char* key, std::string_view extension);

struct BufferView {
    size_t buffer = 0;
    std::optional<uint64_t> byteStride;
    std::span<const uint8_t> bytes;
};

// A buffer view and its bytes. Fails when it does not lie in its buffer, and with ErrorKind::unsupported when
// it is compressed (EXT_meshopt_compression).
Result<BufferView> readBufferView(const GltfDocument::Data& data, size_t index);

// The bytes that a file next to the document holds.
Result<std::vector<uint8_t>> readSibling(const GltfDocument::Data& data, std::string_view uri);

}  // namespace filigree::io
