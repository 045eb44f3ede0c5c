#include "filigree/encoding/encode.h"

#include "filigree/encoding/lossy.h"

#include "capi/arguments.h"
#include "capi/call.h"
#include "capi/context.h"
#include "capi/image.h"
#include "capi/micromaps.h"
#include "capi/primitives.h"
#include "capi/progress.h"
#include "capi/set.h"

#include <cmath>
#include <vector>

namespace filigree::capi {
namespace {

using encoding::Encoding;

constexpr filigree_encode_settings encodeDefaults = FILIGREE_ENCODE_SETTINGS_INIT;

struct EncodeSettings {
    Encoding encoding = Encoding::sdag;
    micromap::Format format = micromap::Format::fourState;
    encoding::EncodeOptions options;
    encoding::LossyGoal goal;
    std::span<const float> weights;

    [[nodiscard]] bool isLossy() const { return goal.maxBytes || goal.maxCost; }
};

EncodeSettings settingsOf(const filigree_encode_settings* given, const filigree_micromaps& maps) {
    const filigree_encode_settings from = taken(given, encodeDefaults, "settings");
    EncodeSettings settings;
    settings.encoding = enumerator(from.encoding, Encoding::sdag, "settings.encoding");
    settings.format = from.states == 0 ? maps.format : formatOf(from.states, "settings.states");
    settings.options.aggregates = flag(from.aggregates, "settings.aggregates");
    settings.options.maybeOpaque = flag(from.maybe_opaque, "settings.maybe_opaque");
    if (from.max_bytes > 0) settings.goal.maxBytes = from.max_bytes;
    if (std::isnan(from.max_cost)) fail(FILIGREE_ERROR_ARGUMENT, "settings.max_cost: is not a number");
    if (from.max_cost >= 0) settings.goal.maxCost = from.max_cost;
    if (settings.goal.maxBytes && settings.goal.maxCost)
        fail(FILIGREE_ERROR_ARGUMENT, "settings.max_bytes, settings.max_cost: both are given");
    if (from.weights != nullptr) settings.weights = {from.weights, maps.indices.size()};
    for (const float weight : settings.weights) within(weight, 0.0F, 1e30F, "settings.weights");
    return settings;
}

std::vector<encoding::WeightedMap> weightedMaps(const filigree_micromaps& maps,
                                                const EncodeSettings& settings) {
    std::vector<encoding::WeightedMap> weighted;
    for (size_t k = 0; k < maps.trees.size(); ++k) weighted.push_back({maps.trees[k], 0});
    for (size_t t = 0; t < maps.indices.size(); ++t) {
        if (maps.indices[t] < 0) continue;
        weighted[static_cast<size_t>(maps.indices[t])].weight +=
            settings.weights.empty() ? 1.0 : double{settings.weights[t]};
    }
    return weighted;
}

// A set with the indices of `maps`.
Owned<filigree_set> setOf(const Memory& memory, const encoding::EncodedView& blocks,
                          const filigree_micromaps& maps) {
    auto set = ownedSet(memory, blocks);
    set->indices = Array<int32_t>(memory, maps.indices.values());
    set->primitives = onePrimitive(memory, maps.indices.size());
    return set;
}

Owned<filigree_set> encodeLossless(const Memory& memory, const filigree_micromaps& maps,
                                   const EncodeSettings& settings, const Executor& executor,
                                   ProgressSink& progress) {
    const auto encoded = orFail(encoding::encode(settings.encoding, maps.trees.views(), settings.format,
                                                 settings.options, executor, progress));
    return setOf(memory, encoding::viewOf(encoded), maps);
}

Owned<filigree_set> encodeLossy(const Memory& memory, const filigree_micromaps& maps,
                                const EncodeSettings& settings, const Executor& executor,
                                ProgressSink& progress) {
    const auto lossy =
        orFail(encoding::encodeLossy(settings.encoding, weightedMaps(maps, settings), settings.format,
                                     settings.options, settings.goal, executor, progress));
    auto set = setOf(memory, encoding::viewOf(lossy.set), maps);
    for (int32_t& index : set->indices.values()) {
        if (index >= 0) index = lossy.indices[static_cast<size_t>(index)];
    }
    return set;
}

}  // namespace
}  // namespace filigree::capi

using namespace filigree::capi;

filigree_error filigree_encode_settings_init(filigree_encode_settings* settings, size_t struct_size) {
    return initialise(settings, struct_size, encodeDefaults);
}

filigree_error filigree_encode(const filigree_context* context, const filigree_micromaps* maps,
                               const filigree_encode_settings* settings, const filigree_progress* progress,
                               filigree_set** out, filigree_error_info* error) {
    return make(out, error, [&] {
        CallerProgress told(progress);
        const filigree_micromaps& from = required(maps, "maps");
        const EncodeSettings chosen = settingsOf(settings, from);
        const Memory memory = memoryOf(context);
        auto set = chosen.isLossy() ? encodeLossy(memory, from, chosen, executorOf(context), told.sink())
                                    : encodeLossless(memory, from, chosen, executorOf(context), told.sink());
        return set.release();
    });
}

filigree_error filigree_encode_bitmask(const filigree_context* context, const filigree_image* image,
                                       const filigree_alpha_test* test, uint32_t states,
                                       const filigree_progress* progress, filigree_set** out,
                                       filigree_error_info* error) {
    return make(out, error, [&] {
        CallerProgress told(progress);
        const auto format = formatOf(states, "states");
        const auto texture = textureOf(image);
        const filigree::encoding::BitmaskSource source{&texture, testOf(test)};
        const auto encoded = orFail(
            filigree::encoding::encodeBitmasks({&source, 1}, format, executorOf(context), told.sink()));
        return ownedSet(memoryOf(context), filigree::encoding::viewOf(encoded)).release();
    });
}
