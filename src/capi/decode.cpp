#include "capi/arguments.h"
#include "capi/call.h"
#include "capi/context.h"
#include "capi/fill.h"
#include "capi/micromaps.h"
#include "capi/set.h"

namespace filigree::capi {
namespace {

const encoding::MapReader& mapsOf(const filigree_set& set) {
    if (!set.maps) fail(FILIGREE_ERROR_UNSUPPORTED, "set: a bitmask holds textures, not micromaps");
    return *set.maps;
}

micromap::QuadtreeList decodeAll(const filigree_set& set) {
    const encoding::MapReader& reader = mapsOf(set);
    micromap::QuadtreeList trees;
    for (uint32_t map = 0; map < reader.mapCount(); ++map) trees.push(reader.decode(map).view());
    return trees;
}

}  // namespace
}  // namespace filigree::capi

using namespace filigree::capi;

filigree_error filigree_decode(const filigree_context* context, const filigree_set* set,
                               filigree_micromaps** out, filigree_error_info* error) {
    return make(out, error, [&] {
        const filigree_set& from = required(set, "set");
        const Memory memory = memoryOf(context);
        auto maps = makeHandle<filigree_micromaps>(memory);
        maps->format = from.view.format;
        maps->trees = Trees(memory, decodeAll(from));
        maps->indices = Array<int32_t>(memory, from.indices.values());
        return maps.release();
    });
}

filigree_error filigree_set_get_map(const filigree_set* set, uint32_t map, uint8_t* to, size_t capacity,
                                    size_t* count, filigree_error_info* error) {
    return call(error, [&] {
        const filigree_set& from = required(set, "set");
        const filigree::encoding::MapReader& reader = mapsOf(from);
        if (map >= reader.mapCount())
            fail(FILIGREE_ERROR_ARGUMENT, "map: is {}, the set holds {}", map, reader.mapCount());
        const uint64_t bytes = filigree::micromap::flatBytes(reader.level(map), from.view.format);
        fill(to, capacity, count, bytes, [&](std::span<uint8_t> room) {
            filigree::micromap::writeFlat(reader.decode(map).view(), from.view.format, room);
        });
    });
}
