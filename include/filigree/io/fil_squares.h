// Opacity squares of a scene's triangle pairs in a .fil (docs/spec/fil.md).
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/mapped_file.h"
#include "filigree/core/result.h"
#include "filigree/io/fil.h"
#include "filigree/quadmap/place.h"
#include "filigree/quadmap/reader.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace filigree::io {

// The half byte of a place in the file.
constexpr uint8_t codeOf(quadmap::SquarePlace place) {
    return static_cast<uint8_t>(static_cast<unsigned>(place.half) | static_cast<unsigned>(place.order) << 1);
}

// All that a file holds. The spans are not owned.
struct FilSquares {
    FilMeta meta;                                               // its level means nothing
    quadmap::SquareFormat format = quadmap::SquareFormat::vq2;  // not raw
    std::span<const int32_t> indices;  // [triangle_count], a map or special: -1 T, -2 O, -3 and -4 C
    std::span<const quadmap::SquarePlace> places;  // [triangle_count]; default where the index is special
    std::span<const uint8_t> blocks;               // a whole number of maps, below 2^31
};

// As writeFil.
FILIGREE_API Result<uint64_t> writeFilSquares(const std::filesystem::path& path, const FilSquares& squares,
                                              bool zstd);

// The same file in memory.
FILIGREE_API Result<std::vector<uint8_t>> encodeFilSquares(const FilSquares& squares, bool zstd);

// Checked in full: every lookup is one then.
class FILIGREE_API FilSquareFile {
  public:
    static Result<FilSquareFile> read(const std::filesystem::path& path, const FilReadOptions& options = {});

    // The same from memory. `name` stands for the file in errors.
    static Result<FilSquareFile> parse(std::vector<uint8_t> bytes, const std::string& name,
                                       const FilReadOptions& options = {});

    // The same from memory of the caller's, used in place, which must outlive this.
    static Result<FilSquareFile> view(std::span<const uint8_t> bytes, const std::string& name,
                                      const FilReadOptions& options = {});

    [[nodiscard]] const FilMeta& meta() const { return meta_; }
    [[nodiscard]] const quadmap::SquareReader& maps() const { return *maps_; }
    [[nodiscard]] uint64_t fileBytes() const { return fileBytes_; }

    // The indices and places of triangles `first`, `first` + 1, ... of all primitives one after another.
    void readIndices(uint64_t first, std::span<int32_t> to) const;
    [[nodiscard]] quadmap::SquarePlace place(uint64_t triangle) const;

  private:
    friend class FilLoading;
    FilSquareFile() = default;
    Status open(std::span<const uint8_t> bytes, const FilReadOptions& options);

    MappedFile mapped_;
    std::vector<uint8_t> bytes_;
    std::vector<std::vector<uint8_t>> plain_;  // of compressed sections
    uint64_t fileBytes_ = 0;
    FilMeta meta_;
    std::optional<quadmap::SquareReader> maps_;
    std::span<const uint8_t> indices_;
    std::span<const uint8_t> places_;
};

// What a .fil holds: squares of that format, or none where it holds micromaps or cannot be read.
FILIGREE_API std::optional<quadmap::SquareFormat> squaresIn(const std::filesystem::path& path);
FILIGREE_API std::optional<quadmap::SquareFormat> squaresIn(std::span<const uint8_t> bytes);

}  // namespace filigree::io
