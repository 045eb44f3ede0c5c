#include "filigree/micromap/set.h"

#include <algorithm>
#include <cassert>
#include <map>

#include <fmt/format.h>

namespace filigree::micromap {

std::vector<UsageCount> usageCounts(const std::vector<Record>& records) {
    std::map<std::pair<uint32_t, Format>, uint32_t> counts;
    for (const Record& record : records) ++counts[{record.level, record.format}];
    std::vector<UsageCount> usage;
    for (const auto& [key, count] : counts) usage.push_back({count, key.first, key.second});
    return usage;
}

uint64_t flatDataBytes(const TreeSet& set) {
    uint64_t bytes = 0;
    for (size_t k = 0; k < set.trees.size(); ++k) bytes += flatBytes(set.trees[k].level, set.format);
    return bytes;
}

Result<FlatSet> flatten(const TreeSet& set, const Executor& executor) {
    const uint64_t bytes = flatDataBytes(set);
    if (bytes > UINT32_MAX) {
        return Error{
            ErrorKind::limit,
            fmt::format("the micromaps take {} bytes flat, the formats reach {}: choose a lower level or a "
                        "budget",
                        bytes, UINT32_MAX)};
    }
    FlatSet flat;
    flat.indices = set.indices;
    flat.records.reserve(set.trees.size());
    uint64_t offset = 0;
    for (size_t k = 0; k < set.trees.size(); ++k) {
        const unsigned level = set.trees[k].level;
        flat.records.push_back({static_cast<uint32_t>(offset), static_cast<uint16_t>(level), set.format});
        offset += flatBytes(level, set.format);
    }
    flat.data.resize(bytes);
    executor.parallelFor(set.trees.size(), 16, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k) {
            const QuadtreeView tree = set.trees[k];
            const auto to =
                std::span(flat.data).subspan(flat.records[k].byteOffset, flatBytes(tree.level, set.format));
            writeFlat(tree, set.format, to);
        }
    });
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
