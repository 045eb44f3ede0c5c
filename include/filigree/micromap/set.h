// Sets of micromaps for the triangles of a mesh: as quadtrees, and flat as the APIs take them.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/micromap/quadtree.h"
#include "filigree/micromap/state.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::micromap {

// Distinct micromaps as quadtrees and each triangle's index: one of `trees`, or special (-1..-4).
struct TreeSet {
    Format format = Format::fourState;
    QuadtreeList trees;
    std::vector<int32_t> indices;  // [triangle_count]
};

// The 8-byte record of VkMicromapTriangleKHR, D3D12_RAYTRACING_OPACITY_MICROMAP_DESC and glTF.
struct Record {
    uint32_t byteOffset = 0;  // into the data, any byte
    uint16_t level = 0;       // 0..maxLevel
    Format format = Format::fourState;
};
inline constexpr size_t recordBytes = 8;

// How many records have a (level, format).
struct UsageCount {
    uint32_t count = 0;
    uint32_t level = 0;
    Format format = Format::fourState;
};

// Flat micromaps as the APIs and glTF take them: data, records, indices.
struct FlatSet {
    std::vector<uint8_t> data;
    std::vector<Record> records;
    std::vector<int32_t> indices;  // [triangle_count], a record or special
};

// One entry for each (level, format) that occurs, by rising level, then format.
FILIGREE_API std::vector<UsageCount> usageCounts(const std::vector<Record>& records);

// How many triangles use records of each level and format, which an acceleration structure with micromaps of
// VK_EXT_opacity_micromap is built with. Indices that are special or no record do not count.
FILIGREE_API std::vector<UsageCount> usageByTriangles(std::span<const int32_t> indices,
                                                      std::span<const Record> records);

// Bytes of data that flatten() would write.
FILIGREE_API uint64_t flatDataBytes(const TreeSet& set);

// Where flatten() puts each micromap: one after another. ErrorKind::limit above 4 GiB - 1 of data, the reach
// of the 32-bit offsets.
FILIGREE_API Result<std::vector<Record>> recordsOf(const TreeSet& set);

// The flat set of `set`, in the same order. ErrorKind::limit as recordsOf(), ErrorKind::cancelled.
// micromap/buffers.h writes the same into memory of the caller's.
FILIGREE_API Result<FlatSet> flatten(const TreeSet& set, const Executor& executor = serialExecutor(),
                                     ProgressSink& progress = silentProgress());

// Gives a set without records one that no index names: lists of micromaps may not be empty in glTF and
// Vulkan, even where every index is special.
FILIGREE_API void ensureOneRecord(FlatSet& set, Format format);

// Bytes of the smallest unsigned type that holds all `indices`, special ones in two's complement: 1, 2 or 4.
// An n-bit type holds records below 2^n - 4, so that no record reads as special.
FILIGREE_API size_t indexBytes(std::span<const int32_t> indices);

// The four-state value of micro-triangle `index` of a flat record. 2-state gives transparent or opaque.
FILIGREE_API State flatState(const FlatSet& set, const Record& record, uint64_t index);

}  // namespace filigree::micromap
