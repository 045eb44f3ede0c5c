// The numbers of docs/spec/fil.md.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace filigree::io {

inline constexpr std::array<uint8_t, 8> filMagic{0x89, 'F', 'I', 'L', '\r', '\n', 0x1a, '\n'};
inline constexpr uint32_t filVersion = 1;
inline constexpr size_t filHeaderBytes = 24;
inline constexpr size_t filEntryBytes = 40;
inline constexpr size_t filHashBytes = 8;
inline constexpr uint32_t filMaxSections = 64;
inline constexpr uint64_t filAlignment = 64;
inline constexpr uint8_t filNoLevel = 255;
inline constexpr uint32_t filSpecials = 4;
inline constexpr uint8_t filFirstSquares = 16;  // from here on encodings of squares: vq2, vq2+, vq4, vq4+
inline constexpr uint8_t filSquareFormats = 4;
inline constexpr uint8_t filFirstGrids = 32;  // grids: paper, lattice
inline constexpr uint8_t filGridCodecs = 2;

// The most bytes a section may have.
inline constexpr uint64_t filMostMetaBytes = uint64_t{1} << 30;
inline constexpr uint64_t filMostDescriptorBytes = 64;  // for each map, and once more
inline constexpr uint64_t filMostPayloadGrowth = 4;     // times the flat 4-state map, for each map,
inline constexpr uint64_t filMostMapBytes = 256;        // and this,
inline constexpr uint64_t filMostPayloadBase = uint64_t{1} << 20;  // and this once
inline constexpr uint64_t filMostRecordBytes = 4096;               // of grids, for each record

enum class FilKind : uint32_t {
    meta = 1,
    indices = 2,
    descriptors = 3,
    payload = 4,
    pairs = 5,
    grids = 6,
    nodes = 7,
    offsets = 8,
    diagonals = 9,
    sources = 10,
    corners = 11,
    normals = 12,
    uvs = 13,
};
inline constexpr FilKind filLastKind = FilKind::uvs;
inline constexpr uint32_t filOptionalKind = 0x80000000;  // kinds from here on may be passed over
inline constexpr uint32_t filZstd = 1;                   // the one flag

inline std::string filKindName(uint32_t kind) {
    static constexpr std::array<std::string_view, 14> names{
        "",      "meta",    "indices",   "descriptors", "payload", "pairs",   "grids",
        "nodes", "offsets", "diagonals", "sources",     "corners", "normals", "uvs"};
    return kind > 0 && kind < names.size() ? std::string(names[kind]) : fmt::format("of kind {}", kind);
}

constexpr uint64_t filAligned(uint64_t offset) {
    return (offset + filAlignment - 1) / filAlignment * filAlignment;
}

}  // namespace filigree::io
