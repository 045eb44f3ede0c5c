#include "filigree/micromap/buffers.h"

#include "capi/call.h"
#include "capi/fill.h"
#include "capi/flat.h"
#include "capi/sized.h"

#include <array>

namespace filigree::capi {
namespace {

uint64_t flatBytesOf(const filigree_micromaps& maps) {
    uint64_t bytes = 0;
    for (size_t k = 0; k < recordCount(maps); ++k) bytes += recordBytes(maps, k);
    return bytes;
}

// Those of data that records can reach.
uint64_t reachableBytesOf(const filigree_micromaps& maps) {
    const uint64_t bytes = flatBytesOf(maps);
    if (bytes > UINT32_MAX) {
        fail(FILIGREE_ERROR_LIMIT, "the micromaps take {} bytes flat, records reach {}: choose a lower level",
             bytes, UINT32_MAX);
    }
    return bytes;
}

void writeData(const filigree_micromaps& maps, std::span<uint8_t> to) {
    if (maps.trees.size() == 0) {
        const auto mask = (1U << micromap::bitsPerState(maps.format)) - 1;
        to[0] = static_cast<uint8_t>(static_cast<unsigned>(micromap::State::unknownOpaque) & mask);
        return;
    }
    for (size_t k = 0; k < maps.trees.size(); ++k) {
        const size_t bytes = recordBytes(maps, k);
        micromap::writeFlat(maps.trees[k], maps.format, to.first(bytes));
        to = to.subspan(bytes);
    }
}

void writeRecords(const filigree_micromaps& maps, std::span<filigree_record> to) {
    uint32_t offset = 0;
    for (size_t k = 0; k < to.size(); ++k) {
        to[k] = {offset, static_cast<uint16_t>(recordLevel(maps, k)), static_cast<uint16_t>(maps.format)};
        offset += static_cast<uint32_t>(recordBytes(maps, k));
    }
}

// A usage for each level that occurs; returns how many.
struct Usage {
    std::array<filigree_usage, micromap::maxLevel + 1> list{};
    size_t count = 0;
    [[nodiscard]] std::span<const filigree_usage> values() const { return std::span(list).first(count); }
};

Usage usageOf(const filigree_micromaps& maps, bool ofTriangles) {
    std::array<uint32_t, micromap::maxLevel + 1> counts{};
    if (ofTriangles) {
        for (const int32_t index : maps.indices.values()) {
            if (index >= 0) ++counts[maps.trees[static_cast<size_t>(index)].level];
        }
    } else {
        for (size_t k = 0; k < recordCount(maps); ++k) ++counts[recordLevel(maps, k)];
    }
    Usage usage;
    for (uint32_t level = 0; level < counts.size(); ++level) {
        if (counts[level] > 0)
            usage.list[usage.count++] = {counts[level], level, static_cast<uint32_t>(maps.format)};
    }
    return usage;
}

filigree_micromaps_info infoOf(const filigree_micromaps& maps) {
    filigree_micromaps_info info{};
    info.triangle_count = maps.indices.size();
    info.states = statesOf(maps.format);
    info.map_count = static_cast<uint32_t>(maps.trees.size());
    info.data_bytes = flatBytesOf(maps);
    info.record_count = recordCount(maps);
    info.usage_count = static_cast<uint32_t>(usageOf(maps, false).count);
    info.index_bytes = static_cast<uint32_t>(micromap::indexBytes(maps.indices.values()));
    info.distinct_triangles = maps.statistics.distinctTriangles;
    info.unplaced_triangles = maps.statistics.nonFiniteTriangles;
    info.micro_triangles = maps.statistics.microTriangles;
    std::copy_n(maps.statistics.states.of, 4, info.state_counts);
    return info;
}

}  // namespace
}  // namespace filigree::capi

using namespace filigree::capi;

filigree_error filigree_micromaps_get_info(const filigree_micromaps* maps, filigree_micromaps_info* info,
                                           filigree_error_info* error) {
    return call(error, [&] { give(infoOf(required(maps, "maps")), info, "info"); });
}

filigree_error filigree_micromaps_get_data(const filigree_micromaps* maps, void* to, size_t capacity,
                                           size_t* count, filigree_error_info* error) {
    return call(error, [&] {
        const filigree_micromaps& from = required(maps, "maps");
        fill(static_cast<uint8_t*>(to), capacity, count, reachableBytesOf(from),
             [&](std::span<uint8_t> room) { writeData(from, room); });
    });
}

filigree_error filigree_micromaps_get_records(const filigree_micromaps* maps, filigree_record* to,
                                              size_t capacity, size_t* count, filigree_error_info* error) {
    return call(error, [&] {
        const filigree_micromaps& from = required(maps, "maps");
        reachableBytesOf(from);
        fill(to, capacity, count, recordCount(from),
             [&](std::span<filigree_record> room) { writeRecords(from, room); });
    });
}

filigree_error filigree_micromaps_get_usage(const filigree_micromaps* maps, uint32_t of, filigree_usage* to,
                                            size_t capacity, size_t* count, filigree_error_info* error) {
    return call(error, [&] {
        const auto which = enumerator(of, FILIGREE_USAGE_OF_TRIANGLES, "of");
        const Usage usage = usageOf(required(maps, "maps"), which == FILIGREE_USAGE_OF_TRIANGLES);
        fillFrom(usage.values(), to, capacity, count);
    });
}

filigree_error filigree_micromaps_get_indices(const filigree_micromaps* maps, uint32_t index_bytes, void* to,
                                              size_t capacity, size_t* count, filigree_error_info* error) {
    return call(error, [&] {
        const std::span<const int32_t> indices = required(maps, "maps").indices.values();
        if (index_bytes != 1 && index_bytes != 2 && index_bytes != 4)
            fail(FILIGREE_ERROR_ARGUMENT, "index_bytes: is {}, expected 1, 2 or 4", index_bytes);
        const size_t least = filigree::micromap::indexBytes(indices);
        if (index_bytes < least)
            fail(FILIGREE_ERROR_LIMIT, "index_bytes: is {}, the indices need {}", index_bytes, least);
        fillElements(to, index_bytes, capacity, count, indices.size(), [&](void* room) {
            const std::span bytes(static_cast<uint8_t*>(room), indices.size() * index_bytes);
            filigree::micromap::writeIndices(indices, index_bytes, bytes);
        });
    });
}

filigree_error filigree_micromaps_get_levels(const filigree_micromaps* maps, uint8_t* to, size_t capacity,
                                             size_t* count, filigree_error_info* error) {
    return call(error, [&] { fillFrom(required(maps, "maps").levels.values(), to, capacity, count); });
}

filigree_error filigree_micromaps_get_rotations(const filigree_micromaps* maps, uint8_t* to, size_t capacity,
                                                size_t* count, filigree_error_info* error) {
    return call(error, [&] { fillFrom(required(maps, "maps").rotations.values(), to, capacity, count); });
}
