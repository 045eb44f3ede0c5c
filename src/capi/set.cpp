#include "capi/set.h"

#include "capi/arguments.h"
#include "capi/call.h"
#include "capi/context.h"
#include "capi/fill.h"
#include "capi/micromaps.h"
#include "capi/sized.h"

#include <algorithm>

namespace filigree::capi {
namespace {

constexpr filigree_set_blocks blockDefaults = FILIGREE_SET_BLOCKS_INIT;

std::optional<unsigned> commonLevel(std::span<const uint8_t> levels) {
    if (levels.empty()) return std::nullopt;
    const auto same = [&](uint8_t level) { return level == levels.front(); };
    return std::ranges::all_of(levels, same) ? std::optional<unsigned>(levels.front()) : std::nullopt;
}

void open(filigree_set& set, const encoding::EncodedView& view) {
    set.view = view;
    if (view.encoding == encoding::Encoding::bitmask) {
        set.textures.emplace(orFail(encoding::BitmaskReader::open(view)));
        return;
    }
    set.maps = orFail(encoding::openReader(view));
    set.levels = Array<uint8_t>(set.memory, view.mapCount);
    for (uint32_t map = 0; map < view.mapCount; ++map)
        set.levels[map] = static_cast<uint8_t>(set.maps->level(map));
    set.level = commonLevel(set.levels.values());
}

encoding::EncodedView viewOf(const filigree_set_blocks* given) {
    const filigree_set_blocks from = takenOf(given, blockDefaults, "blocks");
    encoding::EncodedView view;
    view.encoding = enumerator(from.encoding, encoding::Encoding::sdag, "blocks.encoding");
    view.format = formatOf(from.states, "blocks.states");
    view.mapCount = from.map_count;
    view.descriptors = listOf(from.descriptors, from.descriptor_bytes, "blocks.descriptors");
    view.payload = listOf(from.payload, from.payload_bytes, "blocks.payload");
    return view;
}

filigree_set_blocks blocksOf(const encoding::EncodedView& view) {
    filigree_set_blocks blocks = blockDefaults;
    blocks.encoding = static_cast<uint32_t>(view.encoding);
    blocks.states = statesOf(view.format);
    blocks.map_count = view.mapCount;
    blocks.descriptors = view.descriptors.data();
    blocks.descriptor_bytes = view.descriptors.size();
    blocks.payload = view.payload.data();
    blocks.payload_bytes = view.payload.size();
    return blocks;
}

filigree_set_info infoOf(const filigree_set& set) {
    filigree_set_info info{};
    info.encoding = static_cast<uint32_t>(set.view.encoding);
    info.states = statesOf(set.view.format);
    info.map_count = set.view.mapCount;
    info.bytes = set.view.descriptors.size() + set.view.payload.size();
    info.triangle_count = set.indices.size();
    return info;
}

}  // namespace

Owned<filigree_set> ownedSet(const Memory& memory, const encoding::EncodedView& blocks) {
    auto set = makeHandle<filigree_set>(memory);
    set->descriptors = Array<uint8_t>(memory, blocks.descriptors);
    set->payload = Array<uint8_t>(memory, blocks.payload);
    encoding::EncodedView view = blocks;
    view.descriptors = std::as_const(*set).descriptors.values();
    view.payload = std::as_const(*set).payload.values();
    open(*set, view);
    return set;
}

Owned<filigree_set> borrowedSet(const Memory& memory, const encoding::EncodedView& blocks) {
    auto set = makeHandle<filigree_set>(memory);
    open(*set, blocks);
    return set;
}

}  // namespace filigree::capi

using namespace filigree::capi;

void filigree_set_destroy(filigree_set* set) {
    destroy(set);
}

filigree_error filigree_set_blocks_init(filigree_set_blocks* blocks, size_t struct_size) {
    return initialise(blocks, struct_size, blockDefaults);
}

filigree_error filigree_set_get_blocks(const filigree_set* set, filigree_set_blocks* blocks,
                                       filigree_error_info* error) {
    return call(error, [&] { give(blocksOf(required(set, "set").view), blocks, "blocks"); });
}

filigree_error filigree_set_open(const filigree_context* context, const filigree_set_blocks* blocks,
                                 filigree_set** out, filigree_error_info* error) {
    return make(out, error, [&] { return borrowedSet(memoryOf(context), viewOf(blocks)).release(); });
}

filigree_error filigree_set_get_info(const filigree_set* set, filigree_set_info* info,
                                     filigree_error_info* error) {
    return call(error, [&] { give(infoOf(required(set, "set")), info, "info"); });
}

filigree_error filigree_set_get_indices(const filigree_set* set, int32_t* to, size_t capacity, size_t* count,
                                        filigree_error_info* error) {
    return call(error, [&] { fillFrom(required(set, "set").indices.values(), to, capacity, count); });
}

filigree_error filigree_set_get_levels(const filigree_set* set, uint8_t* to, size_t capacity, size_t* count,
                                       filigree_error_info* error) {
    return call(error, [&] { fillFrom(required(set, "set").levels.values(), to, capacity, count); });
}
