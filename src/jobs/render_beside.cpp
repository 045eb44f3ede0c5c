#include "jobs/render_beside.h"

#include "jobs/stopwatch.h"

#include <utility>

namespace filigree::jobs {

using trace::Method;

Result<const SceneMaps*> BesideRenderer::baked(std::optional<SceneMaps>& into,
                                               const BakeParameters& parameters) {
    if (!into) {
        auto maps = bakeMaps(scene_, parameters, executor_, progress_);
        if (!maps) return maps.error();
        into.emplace(std::move(*maps));
    }
    return &*into;
}

Result<const SceneMaps*> BesideRenderer::mapsFor(Method method) {
    BakeParameters parameters = parameters_;
    if (method == Method::bitmask) {
        parameters.level = 0;
        return baked(textureMaps_, parameters);
    }
    if (method == Method::gruen && parameters.states == 2) {
        parameters.states = 4;
        return baked(sideMaps_, parameters);
    }
    return maps_ != nullptr ? Result<const SceneMaps*>(maps_) : baked(levelMaps_, parameters);
}

Result<OpacityInput> BesideRenderer::prepare(Method method) {
    if (readsSquares(method))
        return makeSquareOpacity(method, parameters_.states, scene_, parameters_, world_, executor_,
                                 progress_);
    if (!readsMaps(method)) return makeOpacity(method, parameters_.states, scene_, {}, world_, executor_);
    const auto maps = mapsFor(method);
    if (!maps) return maps.error();
    return makeOpacity(method, parameters_.states, scene_, **maps, world_, executor_);
}

Result<MethodFilm> BesideRenderer::render(Method method) {
    const auto input = prepare(method);
    if (!input) return input.error();
    MethodFilm made{std::string(nameOf(method)), std::nullopt, 0, input->opacity->bytes(),
                    trace::Film(settings_.width, settings_.height)};
    if (hasStates(method)) made.states = parameters_.states;
    progress_.begin(nameOf(method), uint64_t{samples_} * made.film.sums.size(), "pixels");
    const Stopwatch watch;
    for (unsigned k = 0; k < samples_; ++k) {
        if (!addSample(world_, *input->opacity, settings_, executor_, progress_, made.film))
            return Error{ErrorKind::cancelled, "stopped while rendering"};
    }
    made.seconds = watch.seconds();
    progress_.end();
    return made;
}

}  // namespace filigree::jobs
