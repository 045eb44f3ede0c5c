#include "filigree/bake/bake.h"

#include "capi/arguments.h"
#include "capi/call.h"
#include "capi/context.h"
#include "capi/image.h"
#include "capi/micromaps.h"
#include "capi/progress.h"
#include "capi/triangles.h"

namespace filigree::capi {
namespace {

constexpr filigree_bake_settings bakeDefaults = FILIGREE_BAKE_SETTINGS_INIT;

bake::Settings settingsOf(const filigree_bake_settings* given, size_t triangles) {
    const filigree_bake_settings from = taken(given, bakeDefaults, "settings");
    bake::Settings settings;
    settings.format = formatOf(from.states, "settings.states");
    const auto most = static_cast<int32_t>(micromap::maxLevel);
    within(from.level, FILIGREE_LEVEL_AUTO, most, "settings.level");
    if (from.level != FILIGREE_LEVEL_AUTO) settings.level = static_cast<unsigned>(from.level);
    settings.maxLevel = within(from.max_level, 0U, micromap::maxLevel, "settings.max_level");
    settings.rotate = flag(from.rotate, "settings.rotate");
    if (from.levels != nullptr) settings.levels = {from.levels, triangles};
    return settings;
}

Owned<filigree_micromaps> handleOf(const Memory& memory, const bake::Baked& baked) {
    auto maps = makeHandle<filigree_micromaps>(memory);
    maps->format = baked.set.format;
    maps->trees = Trees(memory, baked.set.trees);
    maps->indices = Array<int32_t>(memory, baked.set.indices);
    maps->levels = Array<uint8_t>(memory, baked.levels);
    maps->rotations = Array<uint8_t>(memory, baked.rotations);
    maps->statistics = baked.statistics;
    return maps;
}

}  // namespace
}  // namespace filigree::capi

using namespace filigree::capi;

filigree_error filigree_bake_settings_init(filigree_bake_settings* settings, size_t struct_size) {
    return initialise(settings, struct_size, bakeDefaults);
}

filigree_error filigree_bake(const filigree_context* context, const filigree_triangles* triangles,
                             const filigree_image* image, const filigree_alpha_test* test,
                             const filigree_bake_settings* settings, const filigree_progress* progress,
                             filigree_micromaps** out, filigree_error_info* error) {
    return make(out, error, [&] {
        CallerProgress told(progress);
        const Triangles given(triangles);
        const auto texture = textureOf(image);
        const auto alphaTest = testOf(test);
        const auto baked =
            orFail(filigree::bake::bake(given.all(), texture, alphaTest, settingsOf(settings, given.size()),
                                        executorOf(context), told.sink()));
        return handleOf(memoryOf(context), baked).release();
    });
}

void filigree_micromaps_destroy(filigree_micromaps* maps) {
    destroy(maps);
}
