// Micromap sets as bytes, shared by glTF files and API blobs: 8-byte records, and indices of the smallest
// type.
#pragma once

#include "filigree/core/result.h"
#include "filigree/micromap/set.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::io {

// The 8-byte records of glTF, Vulkan and DXR: u32 offset, u16 level, u16 format.
std::vector<uint8_t> encodeRecords(std::span<const micromap::Record> records);

// A record as it stands in a file, nothing checked.
struct RawRecord {
    uint32_t byteOffset = 0;
    uint16_t level = 0;
    uint16_t format = 0;
};
RawRecord decodeRecord(const uint8_t* from);

// True for a level and format that exist.
bool isLegal(const RawRecord& record);

// Bytes of data that a legal record covers, from its offset on.
uint64_t dataBytes(const RawRecord& record);

// Checked records: each of a legal level and format, inside `dataSize` bytes.
Result<std::vector<micromap::Record>> decodeRecords(std::span<const uint8_t> bytes, size_t stride,
                                                    uint64_t dataSize);

// Two records whose regions of the data overlap, or none.
struct Overlap {
    size_t first = 0;
    size_t second = 0;
};
std::optional<Overlap> findOverlap(std::span<const micromap::Record> records);

// `bytes` for each index, as micromap::indexBytes finds them.
std::vector<uint8_t> encodeIndices(std::span<const int32_t> indices, size_t bytes);

// An unsigned n-byte index as a record (>= 0) or special (-1..-4).
int64_t signedIndex(uint32_t value, size_t bytes);

}  // namespace filigree::io
