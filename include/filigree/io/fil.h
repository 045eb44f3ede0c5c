// The container .fil: encoded micromaps of a scene, and which asset they belong to (docs/spec/fil.md).
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/mapped_file.h"
#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/image/alpha_image.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace filigree::io {

// A file by name and content. Of a .gltf only the document itself counts, not the files that it names.
struct FilAsset {
    std::string name;                // file name without folders
    uint64_t bytes = 0;              // its size
    std::array<uint64_t, 2> hash{};  // XXH3-128: low half, high half
    bool operator==(const FilAsset&) const = default;
};
FILIGREE_API Result<FilAsset> identifyAsset(const std::filesystem::path& path);
FILIGREE_API FilAsset identifyAsset(std::span<const uint8_t> bytes, const std::string& name);

// "6790060 bytes, hash 0123456789abcdef0123456789abcdef".
FILIGREE_API std::string contentOf(const FilAsset& asset);

// Micromaps that are written as one list when they are made flat.
struct FilGroup {
    std::string name;
    std::optional<image::AlphaTest> test;  // what they were baked with, if that is known
};

// Whose triangles come next in the indices of a file.
struct FilPrimitive {
    uint32_t mesh = 0;       // into glTF meshes
    uint32_t primitive = 0;  // into that mesh's primitives
    uint32_t triangles = 0;
    uint32_t group = 0;  // into FilMeta::groups
};

// What a file says of itself.
struct FILIGREE_API FilMeta {
    FilAsset asset;
    std::optional<unsigned> level;  // of all micromaps, 0..maxLevel; none where they differ
    std::vector<FilGroup> groups;
    std::vector<FilPrimitive> primitives;  // by rising mesh, then primitive

    [[nodiscard]] uint64_t triangleCount() const;
};

// Bits that address one of `mapCount` maps or one of the four special states; 0 for Encoding::bitmask, whose
// texture is that of the primitive's group.
FILIGREE_API unsigned filIndexBits(encoding::Encoding encoding, uint32_t mapCount);

// Bytes of the indices of `triangles` triangles.
FILIGREE_API uint64_t filIndexBytes(encoding::Encoding encoding, uint32_t mapCount, uint64_t triangles);

// All that a file holds. The spans are not owned.
struct FilContents {
    FilMeta meta;
    encoding::EncodedView set;         // below 2^31 maps
    std::span<const int32_t> indices;  // of all primitives, one after another; empty for Encoding::bitmask
    std::span<const uint8_t> pairs;    // [mapCount / 4, rounded up], 2 bits a map; empty: none
};

// Writes `path`, whole or not at all; same contents, same bytes. With `zstd` each section is compressed that
// becomes smaller. Gives the size of the file in bytes. ErrorKind::usage where counts do not agree or an
// index is out of range.
FILIGREE_API Result<uint64_t> writeFil(const std::filesystem::path& path, const FilContents& contents,
                                       bool zstd);

// The same file in memory.
FILIGREE_API Result<std::vector<uint8_t>> encodeFil(const FilContents& contents, bool zstd);

// True for a file that begins as a .fil does.
FILIGREE_API bool isFil(const std::filesystem::path& path);
FILIGREE_API bool isFil(std::span<const uint8_t> bytes);

// How much a file may take.
struct FilReadOptions {
    // The most memory that compressed sections may take together once they are plain; above it
    // ErrorKind::limit.
    uint64_t maxBytes = uint64_t{8} << 30;
};

// A container whose bytes agree with their hashes and whose table, meta and indices are checked in full. The
// blocks of the set are as they come: encoding::openReader checks them.
class FILIGREE_API FilFile {
  public:
    // Maps the file; sections that are not compressed are used in place.
    static Result<FilFile> read(const std::filesystem::path& path, const FilReadOptions& options = {});

    // The same from memory. `name` stands for the file in errors.
    static Result<FilFile> parse(std::vector<uint8_t> bytes, const std::string& name,
                                 const FilReadOptions& options = {});

    // The same from memory of the caller's, used in place, which must outlive this.
    static Result<FilFile> view(std::span<const uint8_t> bytes, const std::string& name,
                                const FilReadOptions& options = {});

    [[nodiscard]] const FilMeta& meta() const { return meta_; }
    [[nodiscard]] const encoding::EncodedView& set() const { return set_; }
    [[nodiscard]] std::span<const uint8_t> pairs() const { return pairs_; }
    [[nodiscard]] uint64_t indexBytes() const { return indices_.size(); }
    [[nodiscard]] uint64_t fileBytes() const { return fileBytes_; }

    // The indices of triangles `first`, `first` + 1, ... of all primitives one after another: below
    // set().mapCount, or special. Not with Encoding::bitmask.
    void readIndices(uint64_t first, std::span<int32_t> to) const;

  private:
    friend class FilLoading;
    FilFile() = default;
    Status open(std::span<const uint8_t> bytes, const FilReadOptions& options);

    MappedFile mapped_;
    std::vector<uint8_t> bytes_;
    std::vector<std::vector<uint8_t>> plain_;  // of compressed sections
    uint64_t fileBytes_ = 0;
    FilMeta meta_;
    encoding::EncodedView set_;
    std::span<const uint8_t> indices_;
    std::span<const uint8_t> pairs_;
};

}  // namespace filigree::io
