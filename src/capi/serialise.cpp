#include "filigree/io/fil.h"
#include "filigree/io/fil_grids.h"
#include "filigree/io/fil_squares.h"

#include "capi/arguments.h"
#include "capi/call.h"
#include "capi/context.h"
#include "capi/grids.h"
#include "capi/image.h"
#include "capi/set.h"
#include "capi/sized.h"
#include "capi/squares.h"

#include <string>

struct filigree_blob {
    filigree::capi::Memory memory;
    filigree::capi::Array<uint8_t> bytes;
};

namespace filigree::capi {
namespace {

constexpr filigree_container_settings containerDefaults = FILIGREE_CONTAINER_SETTINGS_INIT;

struct ContainerSettings {
    io::FilAsset asset;
    io::FilGroup group;
    bool zstd = false;
};

ContainerSettings settingsOf(const filigree_container_settings* given) {
    const filigree_container_settings from = taken(given, containerDefaults, "settings");
    ContainerSettings settings;
    const std::string name(from.asset_name != nullptr ? from.asset_name : "");
    const auto bytes = listOf(static_cast<const uint8_t*>(from.asset), from.asset_bytes, "settings.asset");
    settings.asset.name = name;
    if (from.asset != nullptr) settings.asset = io::identifyAsset(bytes, name);
    settings.group.name = name;
    if (from.test != nullptr) settings.group.test = testOf(from.test);
    settings.zstd = flag(from.zstd, "settings.zstd");
    return settings;
}

io::FilMeta metaOf(const ContainerSettings& settings, const Array<filigree_primitive>& primitives) {
    io::FilMeta meta;
    meta.asset = settings.asset;
    meta.groups.push_back(settings.group);
    for (const filigree_primitive& p : primitives.values())
        meta.primitives.push_back({p.mesh, p.primitive, p.triangles, 0});
    return meta;
}

filigree_blob* blobOf(const filigree_context* context, std::span<const uint8_t> bytes) {
    const Memory memory = memoryOf(context);
    auto blob = makeHandle<filigree_blob>(memory);
    blob->bytes = Array<uint8_t>(memory, bytes);
    return blob.release();
}

}  // namespace
}  // namespace filigree::capi

using namespace filigree::capi;

filigree_error filigree_container_settings_init(filigree_container_settings* settings, size_t struct_size) {
    return initialise(settings, struct_size, containerDefaults);
}

const void* filigree_blob_data(const filigree_blob* blob) {
    return blob == nullptr ? nullptr : blob->bytes.values().data();
}

size_t filigree_blob_size(const filigree_blob* blob) {
    return blob == nullptr ? 0 : blob->bytes.size();
}

void filigree_blob_destroy(filigree_blob* blob) {
    destroy(blob);
}

filigree_error filigree_set_serialise(const filigree_context* context, const filigree_set* set,
                                      const filigree_container_settings* settings, filigree_blob** out,
                                      filigree_error_info* error) {
    return make(out, error, [&] {
        const filigree_set& from = required(set, "set");
        const ContainerSettings chosen = settingsOf(settings);
        filigree::io::FilContents contents;
        contents.meta = metaOf(chosen, from.primitives);
        contents.meta.level = from.level;
        contents.set = from.view;
        contents.indices = from.indices.values();
        return blobOf(context, orFail(filigree::io::encodeFil(contents, chosen.zstd)));
    });
}

filigree_error filigree_squares_serialise(const filigree_context* context, const filigree_squares* squares,
                                          const filigree_container_settings* settings, filigree_blob** out,
                                          filigree_error_info* error) {
    return make(out, error, [&] {
        const filigree_squares& from = required(squares, "squares");
        const ContainerSettings chosen = settingsOf(settings);
        const filigree::io::FilSquares contents{metaOf(chosen, from.primitives), from.reader->format(),
                                                from.indices.values(), from.places.values(),
                                                from.blocks.values()};
        return blobOf(context, orFail(filigree::io::encodeFilSquares(contents, chosen.zstd)));
    });
}

filigree_error filigree_grids_serialise(const filigree_context* context, const filigree_grids* grids,
                                        const filigree_container_settings* settings, filigree_blob** out,
                                        filigree_error_info* error) {
    return make(out, error, [&] {
        const filigree_grids& from = required(grids, "grids");
        const ContainerSettings chosen = settingsOf(settings);
        if (chosen.asset == filigree::io::FilAsset())
            return blobOf(context, filigree::io::encodeFilGrids(from.file, chosen.zstd));
        filigree::io::FilGrids named = from.file;
        named.asset = chosen.asset;
        return blobOf(context, filigree::io::encodeFilGrids(named, chosen.zstd));
    });
}
