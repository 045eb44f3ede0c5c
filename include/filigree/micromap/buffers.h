// Micromaps into buffers of the caller's, as Vulkan, DXR and glTF take them: data, 8-byte records, indices.
//
// Ask for the sizes, make buffers of them (mapped memory of a device will do), fill them.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/micromap/set.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace filigree::micromap {

// The index types of the APIs: VK_INDEX_TYPE_UINT8, 16 and 32, DXGI_FORMAT_R8, R16 and R32_UINT. The numbers
// are bytes an index.
enum class IndexType : uint8_t {
    smallest = 0,  // the smallest that holds all indices of the set
    uint8 = 1,
    uint16 = 2,
    uint32 = 4,
};

// What a set takes in buffers.
struct BufferSizes {
    uint64_t dataBytes = 0;
    uint32_t recordCount = 0;  // at least 1: the lists of the APIs may not be empty
    uint64_t recordBytes = 0;  // 8 a record
    uint64_t indexCount = 0;   // triangles
    IndexType indexType = IndexType::uint8;
    uint64_t indexBytes = 0;
};

// What fill() writes. ErrorKind::usage where `type` does not hold all indices beside the special ones,
// ErrorKind::limit above 4 GiB - 1 of data, the reach of the 32-bit offsets.
FILIGREE_API Result<BufferSizes> sizesOf(const TreeSet& set, IndexType type = IndexType::smallest);

// Memory of the caller's, at any address; what lies beyond the sizes stays as it is.
struct Buffers {
    std::span<uint8_t> data;     // at least BufferSizes::dataBytes
    std::span<uint8_t> records;  // likewise; VkMicromapTriangleEXT, D3D12_RAYTRACING_OPACITY_MICROMAP_DESC
    std::span<uint8_t> indices;  // likewise; [indexCount], special ones in two's complement
};

// Writes `set` into `to`: what flatten() makes, after ensureOneRecord(), without a copy between. Same set,
// same bytes. ErrorKind::usage, with nothing written, where a buffer is too small or two of them overlap;
// further errors as sizesOf(), and ErrorKind::cancelled, after which the buffers' contents mean nothing.
FILIGREE_API Status fill(const TreeSet& set, const Buffers& to, IndexType type = IndexType::smallest,
                         const Executor& executor = serialExecutor(),
                         ProgressSink& progress = silentProgress());

// Records and indices as bytes, little-endian. `to` holds recordBytes a record, `bytes` (1, 2 or 4) an index.
FILIGREE_API void writeRecords(std::span<const Record> records, std::span<uint8_t> to);
FILIGREE_API void writeIndices(std::span<const int32_t> indices, size_t bytes, std::span<uint8_t> to);

}  // namespace filigree::micromap
