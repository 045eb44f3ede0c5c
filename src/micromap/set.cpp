#include "filigree/micromap/set.h"

#include "micromap/flat_data.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <utility>

#include <fmt/format.h>

namespace filigree::micromap {

namespace {

using UsageMap = std::map<std::pair<uint32_t, Format>, uint32_t>;

std::vector<UsageCount> usagesOf(const UsageMap& counts) {
    std::vector<UsageCount> usage;
    for (const auto& [key, count] : counts) usage.push_back({count, key.first, key.second});
    return usage;
}

}  // namespace

std::vector<UsageCount> usageCounts(const std::vector<Record>& records) {
    UsageMap counts;
    for (const Record& record : records) ++counts[{record.level, record.format}];
    return usagesOf(counts);
}

std::vector<UsageCount> usageByTriangles(std::span<const int32_t> indices, std::span<const Record> records) {
    UsageMap counts;
    for (const int32_t index : indices) {
        if (index < 0 || static_cast<size_t>(index) >= records.size()) continue;
        const Record& record = records[static_cast<size_t>(index)];
        ++counts[{record.level, record.format}];
    }
    return usagesOf(counts);
}

uint64_t flatDataBytes(const TreeSet& set) {
    uint64_t bytes = 0;
    for (size_t k = 0; k < set.trees.size(); ++k) bytes += flatBytes(set.trees[k].level, set.format);
    return bytes;
}

Status checkDataBytes(uint64_t bytes) {
    if (bytes <= UINT32_MAX) return {};
    return Error{
        ErrorKind::limit,
        fmt::format("the micromaps take {} bytes flat, the formats reach {}: choose a lower level or a "
                    "budget",
                    bytes, UINT32_MAX)};
}

Result<std::vector<Record>> recordsOf(const TreeSet& set) {
    if (const Status reach = checkDataBytes(flatDataBytes(set)); !reach) return reach.error();
    std::vector<Record> records;
    records.reserve(set.trees.size());
    uint64_t offset = 0;
    for (size_t k = 0; k < set.trees.size(); ++k) {
        const unsigned level = set.trees[k].level;
        records.push_back({static_cast<uint32_t>(offset), static_cast<uint16_t>(level), set.format});
        offset += flatBytes(level, set.format);
    }
    return records;
}

Status writeData(const TreeSet& set, std::span<const Record> records, std::span<uint8_t> to,
                 const Executor& executor, ProgressSink& progress) {
    progress.begin("flatten", set.trees.size(), "micromaps");
    executor.parallelFor(set.trees.size(), 16, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end && !progress.cancelled(); ++k) {
            const QuadtreeView tree = set.trees[k];
            writeFlat(tree, set.format, to.subspan(records[k].byteOffset, flatBytes(tree.level, set.format)));
        }
        progress.advance(end - begin);
    });
    progress.end();
    if (progress.cancelled()) return Error{ErrorKind::cancelled, "stopped while flattening micromaps"};
    return {};
}

Result<FlatSet> flatten(const TreeSet& set, const Executor& executor, ProgressSink& progress) {
    Result<std::vector<Record>> records = recordsOf(set);
    if (!records) return records.error();
    FlatSet flat{std::vector<uint8_t>(flatDataBytes(set)), std::move(*records), set.indices};
    if (const Status written = writeData(set, flat.records, flat.data, executor, progress); !written)
        return written.error();
    return flat;
}

void ensureOneRecord(FlatSet& set, Format format) {
    if (!set.records.empty()) return;
    set.records.push_back({0, 0, format});
    const auto bits = (1U << bitsPerState(format)) - 1;
    set.data.push_back(static_cast<uint8_t>(static_cast<unsigned>(State::unknownOpaque) & bits));
}

size_t indexBytes(std::span<const int32_t> indices) {
    const int32_t most = indices.empty() ? 0 : *std::ranges::max_element(indices);
    if (most < 0x100 - 4) return 1;
    return most < 0x10000 - 4 ? 2 : 4;
}

State flatState(const FlatSet& set, const Record& record, uint64_t index) {
    const unsigned bits = bitsPerState(record.format);
    const uint64_t bit = index * bits;
    assert(index < microTriangleCount(record.level) && record.byteOffset + bit / 8 < set.data.size());
    return static_cast<State>((set.data[record.byteOffset + bit / 8] >> (bit % 8)) & ((1u << bits) - 1));
}

}  // namespace filigree::micromap
