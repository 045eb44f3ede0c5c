#include "io/micromap_bytes.h"

#include "filigree/core/bytes.h"
#include "filigree/micromap/buffers.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

namespace filigree::io {
namespace {

constexpr int64_t specials = 4;

uint64_t endOf(const micromap::Record& record) {
    return record.byteOffset + micromap::flatBytes(record.level, record.format);
}

}  // namespace

std::vector<uint8_t> encodeRecords(std::span<const micromap::Record> records) {
    std::vector<uint8_t> bytes(records.size() * micromap::recordBytes);
    micromap::writeRecords(records, bytes);
    return bytes;
}

RawRecord decodeRecord(const uint8_t* from) {
    return {loadLe<uint32_t>(from), loadLe<uint16_t>(from + 4), loadLe<uint16_t>(from + 6)};
}

bool isLegal(const RawRecord& record) {
    return record.level <= micromap::maxLevel && (record.format == 1 || record.format == 2);
}

uint64_t dataBytes(const RawRecord& record) {
    return micromap::flatBytes(record.level, static_cast<micromap::Format>(record.format));
}

Result<std::vector<micromap::Record>> decodeRecords(std::span<const uint8_t> bytes, size_t stride,
                                                    uint64_t dataSize) {
    std::vector<micromap::Record> records;
    records.reserve(bytes.size() / stride + 1);
    for (size_t at = 0; bytes.size() - at >= micromap::recordBytes;) {
        const RawRecord raw = decodeRecord(bytes.data() + at);
        if (!isLegal(raw)) {
            return Error{ErrorKind::format,
                         fmt::format("record {}: level {}, format {}, expected level 0 to {}, format 1 or 2",
                                     records.size(), raw.level, raw.format, micromap::maxLevel)};
        }
        if (raw.byteOffset + dataBytes(raw) > dataSize) {
            return Error{
                ErrorKind::format,
                fmt::format("record {}: bytes {} to {}, expected inside {} bytes of data", records.size(),
                            raw.byteOffset, raw.byteOffset + dataBytes(raw), dataSize)};
        }
        records.push_back({raw.byteOffset, raw.level, static_cast<micromap::Format>(raw.format)});
        if (bytes.size() - at < stride) break;
        at += stride;
    }
    return records;
}

std::optional<Overlap> findOverlap(std::span<const micromap::Record> records) {
    std::vector<size_t> order(records.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return records[a].byteOffset < records[b].byteOffset; });
    for (size_t k = 1; k < order.size(); ++k) {
        if (endOf(records[order[k - 1]]) > records[order[k]].byteOffset)
            return Overlap{order[k - 1], order[k]};
    }
    return std::nullopt;
}

std::vector<uint8_t> encodeIndices(std::span<const int32_t> indices, size_t bytes) {
    std::vector<uint8_t> encoded(indices.size() * bytes);
    micromap::writeIndices(indices, bytes, encoded);
    return encoded;
}

int64_t signedIndex(uint32_t value, size_t bytes) {
    const int64_t range = int64_t{1} << (8 * bytes);
    return int64_t{value} >= range - specials ? int64_t{value} - range : int64_t{value};
}

}  // namespace filigree::io
