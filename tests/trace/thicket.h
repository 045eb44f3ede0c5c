// A small scene with every way to have holes, and the film of it.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/scene/scene.h"
#include "filigree/trace/render.h"

#include "jobs/opacity_input.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace filigree::tests {

// Rings of uneven alpha, `size` texels a side; a fifth is 0 throughout and a fifth 1.
inline scene::Image rings(uint32_t width, uint32_t height, double turns) {
    std::vector<uint8_t> alpha(size_t{width} * height);
    scene::ColourImage colour{width, height, std::vector<uint8_t>(4 * alpha.size(), 255)};
    for (uint32_t k = 0; k < alpha.size(); ++k) {
        const double x = (k % width + 0.5) / width - 0.45;
        const double y = (k / width + 0.5) / height - 0.52;
        const double wave = 0.5 + 0.8 * std::cos(turns * std::hypot(x, y) + std::atan2(y, x));
        alpha[k] = static_cast<uint8_t>(std::lround(255 * std::clamp(wave, 0.0, 1.0)));
        colour.rgba[4 * size_t{k}] = static_cast<uint8_t>(40 + k % 200);
    }
    return {"rings", image::alphaImageFrom8Bit(width, height, alpha), colour};
}

// A card of two triangles on the plane z = `depth`, its texture coordinates in [low, high]^2.
inline scene::Primitive card(int material, float depth, float low, float high) {
    scene::Primitive primitive;
    primitive.material = material;
    primitive.positions = {{-1, -1, depth}, {1, -1, depth}, {1, 1, depth}, {-1, 1, depth + 0.2F}};
    primitive.uvs = {{low, low}, {high, low}, {high, high}, {low, high}};
    primitive.indices = {0, 1, 2, 0, 2, 3};
    return primitive;
}

// Cards before a floor: each wrap mode and filter, a factor, vertex alpha, BLEND, and turned, squeezed and
// mirrored instances.
inline scene::Scene thicket() {
    using image::Filter;
    using image::Wrap;
    scene::Scene scene;
    scene.images = {rings(32, 32, 30), rings(21, 40, 17)};
    const auto add = [&](int image, Wrap wrap, Filter filter, scene::AlphaMode mode) -> scene::Material& {
        scene::Material& material = scene.materials.emplace_back();
        material.image = image;
        material.wrapU = material.wrapV = wrap;
        material.filter = filter;
        material.alphaMode = mode;
        return material;
    };
    add(0, Wrap::repeat, Filter::linear, scene::AlphaMode::mask);
    add(1, Wrap::mirroredRepeat, Filter::linear, scene::AlphaMode::mask).cutoff = 0.3;
    add(1, Wrap::clampToEdge, Filter::nearest, scene::AlphaMode::mask);
    add(0, Wrap::mirroredRepeat, Filter::linear, scene::AlphaMode::blend);
    add(0, Wrap::clampToEdge, Filter::linear, scene::AlphaMode::mask).baseColourFactor = {1, 0.5F, 1, 0.8F};
    add(-1, Wrap::repeat, Filter::linear, scene::AlphaMode::opaque).baseColourFactor = {0.5F, 0.6F, 0.7F, 1};
    auto& cards = scene.meshes.emplace_back().primitives;
    cards = {card(0, 0, -0.6F, 1.9F), card(1, 0.3F, -1.2F, 1.4F), card(2, -0.3F, -0.1F, 1.1F),
             card(3, -0.6F, 0.1F, 2.3F), card(4, -0.9F, 0, 1)};
    cards[4].alphas = {1, 1, 0.4F, 0.7F};
    scene::Primitive floor = card(5, 0, 0, 1);
    floor.positions = {{-3, -1.2F, 3}, {3, -1.2F, 3}, {3, -1.2F, -3}, {-3, -1.2F, -3}};
    scene.meshes.push_back({"floor", {floor}});
    scene.instances = {{0, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
                       {0, {0.6F, 0, 0.8F, 0, 0, -0.7F, 0, 0, -0.8F, 0, 0.6F, 0, 1.9F, 0.1F, -1, 1}},
                       {0, {0.3F, 0.2F, 0, 0, -0.2F, 0.5F, 0, 0, 0, 0, 2, 0, -1.8F, -0.3F, 0.4F, 1}},
                       {1, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}};
    return scene;
}

inline trace::RenderSettings settingsFor(trace::Integrator integrator, uint32_t width, uint32_t height) {
    trace::RenderSettings settings;
    settings.width = width;
    settings.height = height;
    settings.integrator = integrator;
    return settings;
}

inline trace::Film filmOf(const trace::World& world, const trace::Opacity& opacity,
                          const trace::RenderSettings& settings, unsigned samples,
                          const Executor& executor = serialExecutor()) {
    trace::Film film(settings.width, settings.height);
    for (unsigned k = 0; k < samples; ++k)
        EXPECT_TRUE(addSample(world, opacity, settings, executor, silentProgress(), film));
    return film;
}

// The maps that every method but the bitmask reads, or the groups of textures that the bitmask does.
inline jobs::SceneMaps mapsFor(scene::Scene& scene, trace::Method method, unsigned states, unsigned level) {
    jobs::BakeParameters parameters;
    parameters.states = states;
    parameters.level = method == trace::Method::bitmask ? 0 : level;
    parameters.includeBlend = true;
    auto maps = jobs::bakeMaps(scene, parameters, serialExecutor(), silentProgress());
    EXPECT_TRUE(maps.ok());
    return std::move(*maps);
}

// A method with four states or two, and micromaps of `level` where it has levels.
inline Result<jobs::OpacityInput> inputFor(scene::Scene& scene, const trace::World& world,
                                           trace::Method method, unsigned states, unsigned level) {
    if (jobs::readsMaps(method)) {
        return jobs::makeOpacity(method, states, scene, mapsFor(scene, method, states, level), world,
                                 serialExecutor());
    }
    jobs::BakeParameters parameters;
    parameters.includeBlend = true;
    return jobs::makeSquareOpacity(method, states, scene, parameters, world, serialExecutor(),
                                   silentProgress());
}

inline constexpr std::array integrators{trace::Integrator::primary, trace::Integrator::shadow,
                                        trace::Integrator::ao, trace::Integrator::path};
inline constexpr std::array methodsWithStates{
    trace::Method::bitmask,     trace::Method::gruen,   trace::Method::micromap, trace::Method::tree,
    trace::Method::indexedTree, trace::Method::dag,     trace::Method::sdag,     trace::Method::vq2,
    trace::Method::vq4,         trace::Method::vq2Plus, trace::Method::vq4Plus};

}  // namespace filigree::tests
