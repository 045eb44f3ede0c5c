#include "filigree/micromap/buffers.h"

#include "filigree/core/bytes.h"

#include "micromap/flat_data.h"

#include <algorithm>
#include <cassert>
#include <functional>

#include <fmt/format.h>

namespace filigree::micromap {
namespace {

Error usageError(std::string message) {
    return {ErrorKind::usage, std::move(message)};
}

Status checkSpace(std::string_view name, std::span<const uint8_t> buffer, uint64_t bytes) {
    if (buffer.size() >= bytes) return {};
    return usageError(
        fmt::format("the buffer of {} has {} bytes, expected at least {}", name, buffer.size(), bytes));
}

bool overlap(std::span<const uint8_t> a, std::span<const uint8_t> b) {
    const std::less<> before;
    return before(a.data(), b.data() + b.size()) && before(b.data(), a.data() + a.size());
}

// The parts of the buffers that are written, once they are known to be there and apart.
Result<Buffers> partsOf(const Buffers& to, const BufferSizes& sizes) {
    Status status = checkSpace("data", to.data, sizes.dataBytes);
    if (status) status = checkSpace("records", to.records, sizes.recordBytes);
    if (status) status = checkSpace("indices", to.indices, sizes.indexBytes);
    if (!status) return status.error();
    const Buffers parts{to.data.first(sizes.dataBytes), to.records.first(sizes.recordBytes),
                        to.indices.first(sizes.indexBytes)};
    if (overlap(parts.data, parts.records)) return usageError("the buffers of data and records overlap");
    if (overlap(parts.data, parts.indices)) return usageError("the buffers of data and indices overlap");
    if (overlap(parts.records, parts.indices))
        return usageError("the buffers of records and indices overlap");
    return parts;
}

// The one record of a set that needs none: no index names it.
FlatSet lonelyRecord(Format format) {
    FlatSet set;
    ensureOneRecord(set, format);
    return set;
}

}  // namespace

Result<BufferSizes> sizesOf(const TreeSet& set, IndexType type) {
    const bool isEmpty = set.trees.size() == 0;
    BufferSizes sizes;
    sizes.dataBytes = isEmpty ? lonelyRecord(set.format).data.size() : flatDataBytes(set);
    if (const Status reach = checkDataBytes(sizes.dataBytes); !reach) return reach.error();
    sizes.recordCount = isEmpty ? 1 : static_cast<uint32_t>(set.trees.size());
    sizes.recordBytes = recordBytes * sizes.recordCount;
    sizes.indexCount = set.indices.size();
    const size_t smallest = indexBytes(set.indices);
    sizes.indexType = type == IndexType::smallest ? static_cast<IndexType>(smallest) : type;
    const auto width = static_cast<size_t>(sizes.indexType);
    if (width < smallest)
        return usageError(fmt::format("indices of {} byte{}, but {} records need {}", width,
                                      width == 1 ? "" : "s", sizes.recordCount, smallest));
    sizes.indexBytes = width * sizes.indexCount;
    return sizes;
}

Status fill(const TreeSet& set, const Buffers& to, IndexType type, const Executor& executor,
            ProgressSink& progress) {
    const Result<BufferSizes> sizes = sizesOf(set, type);
    if (!sizes) return sizes.error();
    const Result<Buffers> parts = partsOf(to, *sizes);
    if (!parts) return parts.error();
    writeIndices(set.indices, static_cast<size_t>(sizes->indexType), parts->indices);
    if (set.trees.size() == 0) {
        const FlatSet lonely = lonelyRecord(set.format);
        writeRecords(lonely.records, parts->records);
        std::ranges::copy(lonely.data, parts->data.begin());
        return {};
    }
    const Result<std::vector<Record>> records = recordsOf(set);
    if (!records) return records.error();
    writeRecords(*records, parts->records);
    return writeData(set, *records, parts->data, executor, progress);
}

void writeRecords(std::span<const Record> records, std::span<uint8_t> to) {
    assert(to.size() >= recordBytes * records.size());
    for (size_t k = 0; k < records.size(); ++k) {
        storeLe(&to[recordBytes * k], records[k].byteOffset);
        storeLe(&to[recordBytes * k + 4], records[k].level);
        storeLe(&to[recordBytes * k + 6], static_cast<uint16_t>(records[k].format));
    }
}

void writeIndices(std::span<const int32_t> indices, size_t bytes, std::span<uint8_t> to) {
    assert(to.size() >= bytes * indices.size());
    for (size_t k = 0; k < indices.size(); ++k) {
        const auto value = static_cast<uint32_t>(indices[k]);
        for (size_t b = 0; b < bytes; ++b) to[k * bytes + b] = static_cast<uint8_t>(value >> (8 * b));
    }
}

}  // namespace filigree::micromap
