// Buffers of a glTF file that is written again: old bytes in place, new ones behind them.
#pragma once

#include "io/document.h"

#include <deque>
#include <filesystem>
#include <span>
#include <vector>

namespace filigree::io {

// Collects bytes for one buffer without copying them.
class BufferPieces {
  public:
    // Appends `bytes` on a multiple of 4 and returns where. They must outlive this.
    size_t add(std::span<const uint8_t> bytes);
    size_t add(std::vector<uint8_t>&& bytes);  // kept here

    [[nodiscard]] size_t size() const { return size_; }
    [[nodiscard]] std::span<const std::span<const uint8_t>> pieces() const { return pieces_; }

  private:
    std::vector<std::span<const uint8_t>> pieces_;
    std::deque<std::vector<uint8_t>> owned_;
    size_t size_ = 0;
};

// A copy of a document to edit, with one buffer that takes new bytes.
struct Rewrite {
    Json json;
    BufferPieces pieces;
    size_t buffer = 0;  // the buffer that `pieces` makes

    // Appends an item to a top-level list and returns its index.
    size_t append(const char* list, Json item);

    // A new buffer view of `bytes`.
    size_t addView(std::vector<uint8_t>&& bytes, const char* name);
};

// The copy for a GLB: buffers with nothing but bytes become one, the BIN chunk, and image files join it.
Result<Rewrite> rewriteForGlb(const GltfDocument::Data& data);

// The copy for a .gltf in `folder`: relative URIs are made right for it, and a BIN chunk becomes a data URI.
Result<Rewrite> rewriteForGltf(const GltfDocument::Data& data, const std::filesystem::path& folder);

// The file's bytes once all is added.
Result<std::vector<uint8_t>> finishGlb(Rewrite& rewrite, const GltfDocument::Data& data);
Result<std::vector<uint8_t>> finishGltf(Rewrite& rewrite);

// The member `key` of `owner`, made an object or array where it is none.
Json& objectIn(Json& owner, const char* key);
Json& arrayIn(Json& owner, const char* key);

}  // namespace filigree::io
