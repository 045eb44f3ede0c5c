// The header of a PLY file.
#pragma once

#include "filigree/core/result.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filigree::io {

enum class PlyFormat : uint8_t { ascii, littleEndian, bigEndian };
enum class PlyType : uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
size_t sizeOf(PlyType type);  // bytes in a binary file

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    std::optional<PlyType> countType;  // of a list

    // The fewest bytes one value, or an empty list, takes.
    [[nodiscard]] size_t leastBytes(PlyFormat format) const;
};

struct PlyElement {
    std::string name;
    uint64_t count = 0;
    std::vector<PlyProperty> properties;

    [[nodiscard]] size_t leastBytes(PlyFormat format) const;
    [[nodiscard]] std::optional<size_t> find(std::string_view property) const;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    size_t bytes = 0;  // of the header, its last line break included
};

// Element and property names are unique. Errors name the line.
Result<PlyHeader> readPlyHeader(std::span<const uint8_t> bytes);

}  // namespace filigree::io
