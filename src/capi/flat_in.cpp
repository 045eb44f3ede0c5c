#include "filigree/micromap/distinct_trees.h"

#include "capi/arguments.h"
#include "capi/call.h"
#include "capi/context.h"
#include "capi/micromaps.h"
#include "capi/sized.h"

#include <vector>

namespace filigree::capi {
namespace {

using micromap::Format;

constexpr filigree_flat_micromaps flatDefaults = FILIGREE_FLAT_MICROMAPS_INIT;

// The caller's lists, checked.
struct Flat {
    std::span<const uint8_t> data;
    std::span<const filigree_record> records;
    std::span<const int32_t> indices;

    [[nodiscard]] Format format() const {
        for (const filigree_record& record : records) {
            if (record.format == static_cast<uint16_t>(Format::fourState)) return Format::fourState;
        }
        return records.empty() ? Format::fourState : Format::twoState;
    }
    [[nodiscard]] micromap::Quadtree tree(const filigree_record& record) const {
        const auto recordFormat = static_cast<Format>(record.format);
        const size_t bytes = micromap::flatBytes(record.level, recordFormat);
        return micromap::quadtreeFromFlat(data.subspan(record.byte_offset, bytes), record.level,
                                          recordFormat);
    }
};

void checkRecord(const Flat& flat, size_t number) {
    const filigree_record& record = flat.records[number];
    if (record.level > micromap::maxLevel || record.format < 1 || record.format > 2) {
        fail(FILIGREE_ERROR_FORMAT, "record {}: level {}, format {}, expected 0 to {} and 1 or 2", number,
             record.level, record.format, micromap::maxLevel);
    }
    const uint64_t end =
        record.byte_offset + micromap::flatBytes(record.level, static_cast<Format>(record.format));
    if (end > flat.data.size()) {
        fail(FILIGREE_ERROR_FORMAT, "record {}: ends at byte {} of {} bytes of data", number, end,
             flat.data.size());
    }
}

void checkIndex(const Flat& flat, size_t triangle) {
    const int32_t index = flat.indices[triangle];
    if (micromap::isSpecialIndex(index) || (index >= 0 && static_cast<size_t>(index) < flat.records.size()))
        return;
    fail(FILIGREE_ERROR_FORMAT, "triangle {}: index {}, expected -4 to {}", triangle, index,
         static_cast<int64_t>(flat.records.size()) - 1);
}

Flat flatOf(const filigree_flat_micromaps* given) {
    const filigree_flat_micromaps from = takenOf(given, flatDefaults, "flat");
    Flat flat;
    flat.data = listOf(static_cast<const uint8_t*>(from.data), from.data_bytes, "flat.data");
    flat.records = listOf(from.records, from.record_count, "flat.records");
    flat.indices = listOf(from.indices, from.triangle_count, "flat.indices");
    if (flat.records.size() > INT32_MAX)
        fail(FILIGREE_ERROR_LIMIT, "flat.record_count: is {}, expected less than 2^31", flat.records.size());
    for (size_t k = 0; k < flat.records.size(); ++k) checkRecord(flat, k);
    for (size_t t = 0; t < flat.indices.size(); ++t) checkIndex(flat, t);
    return flat;
}

}  // namespace
}  // namespace filigree::capi

using namespace filigree::capi;

filigree_error filigree_flat_micromaps_init(filigree_flat_micromaps* flat, size_t struct_size) {
    return initialise(flat, struct_size, flatDefaults);
}

filigree_error filigree_micromaps_from_flat(const filigree_context* context,
                                            const filigree_flat_micromaps* flat, filigree_micromaps** out,
                                            filigree_error_info* error) {
    return make(out, error, [&] {
        const Flat from = flatOf(flat);
        filigree::micromap::DistinctTrees distinct;
        std::vector<int32_t> places;
        for (const filigree_record& record : from.records)
            places.push_back(distinct.add(from.tree(record).view()));
        const Memory memory = memoryOf(context);
        auto maps = makeHandle<filigree_micromaps>(memory);
        maps->format = from.format();
        maps->trees = Trees(memory, std::move(distinct).take());
        maps->indices = Array<int32_t>(memory, from.indices);
        for (int32_t& index : maps->indices.values()) {
            if (index >= 0) index = places[static_cast<size_t>(index)];
        }
        return maps.release();
    });
}
