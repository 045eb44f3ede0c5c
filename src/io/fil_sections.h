// The sections of a .fil as plain bytes, and the codes of its indices.
#pragma once

#include "filigree/core/result.h"

#include "io/fil_table.h"

#include <cstdint>
#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

namespace filigree::io {

// The plain bytes of sections; those of compressed ones go to `plain`.
class FilSections {
  public:
    FilSections(std::vector<FilSection> sections, uint64_t maxBytes, std::vector<std::vector<uint8_t>>& plain)
        : sections_(std::move(sections)), left_(maxBytes), plain_(plain) {}

    [[nodiscard]] bool has(FilKind kind) const { return find(kind) != nullptr; }

    // Fails where there is a section of another kind than these.
    [[nodiscard]] Status allowOnly(std::initializer_list<FilKind> kinds) const;

    // The section must have between `least` and `most` bytes when plain.
    Result<std::span<const uint8_t>> take(FilKind kind, uint64_t least, uint64_t most);

  private:
    [[nodiscard]] const FilSection* find(FilKind kind) const;

    std::vector<FilSection> sections_;
    uint64_t left_;
    std::vector<std::vector<uint8_t>>& plain_;
};

// Checks the codes of `triangles` triangles, `bits` each: below mapCount + filSpecials, spare bits 0.
Status checkFilIndices(std::span<const uint8_t> indices, unsigned bits, uint64_t triangles,
                       uint32_t mapCount);

// The codes from triangle `first` on as indices: a map, or special (-1..-4).
void readFilIndices(std::span<const uint8_t> indices, unsigned bits, uint64_t first, std::span<int32_t> to);

}  // namespace filigree::io
