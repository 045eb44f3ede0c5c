#include "jobs/device_picture.h"

#include <algorithm>
#include <utility>

namespace filigree::jobs {
namespace {

vulkan::Method deviceMethod(const OpacityInput& input, const SceneMaps& maps, const trace::World& world) {
    vulkan::Method method;
    method.takesAll = input.opacity->method() == trace::Method::none;
    method.states = input.opacity->states();
    if (readsMaps(input.opacity->method())) {
        method.set = viewOf(input.set);
        for (const trace::SurfaceMaps& surface : surfaceMaps(maps, world, input.opacity->method()))
            method.surfaces.push_back({surface.indices, {}, surface.texture});
    } else if (readsSquares(input.opacity->method())) {
        method.squares = *quadmap::SquareReader::open(input.squares.format, input.squares.blocks);
        for (const trace::SurfaceSquares& surface : surfaceSquares(input.squares, world))
            method.surfaces.push_back({surface.indices, surface.places, {}});
    }
    return method;
}

vulkan::PictureSettings deviceSettings(const trace::RenderSettings& settings, unsigned samples,
                                       const trace::World& world) {
    vulkan::PictureSettings to;
    to.width = settings.width;
    to.height = settings.height;
    to.samples = samples;
    to.integrator = static_cast<vulkan::Integrator>(settings.integrator);
    to.camera = settings.camera;
    to.seed = settings.seed;
    to.bounces = settings.bounces;
    to.epsilon = rayEpsilon(world);
    to.aoDistance = aoDistanceOf(settings, world);
    to.twoStateShadows = settings.twoStateShadows;
    return to;
}

trace::Film filmOf(vulkan::Picture picture, const trace::RenderSettings& settings, unsigned samples) {
    trace::Film film(settings.width, settings.height);
    film.samples = samples;
    film.sums = std::move(picture.sums);
    film.alphaTests = std::move(picture.fetches);
    film.pixelsHit = picture.pixelsHit;
    for (size_t k = 0; k < trace::rayKindCount; ++k) {
        trace::RayCounts& counts = film.counters.of[k];
        counts.rays = picture.counts[k].rays;
        counts.candidateHits = picture.counts[k].candidates;
        counts.lookups = picture.counts[k].lookups;
        counts.textureFetches = picture.counts[k].fetches;
    }
    return film;
}

}  // namespace

Result<DeviceScene> DeviceScene::open(const vulkan::DeviceOptions& options, std::string_view path,
                                      const scene::Scene& scene, const trace::World& world,
                                      const vulkan::RaySceneOptions& parts, const Executor& executor) {
    auto opened = vulkan::Device::open(options);
    if (!opened) return opened.error();
    auto device = std::make_unique<vulkan::Device>(std::move(*opened));
    const auto chosen = vulkan::chooseRayPath(device->facts(), path);
    if (!chosen) return chosen.error();
    auto placed = vulkan::RayScene::build(*device, scene, parts, executor);
    if (!placed) return placed.error();
    return DeviceScene(std::move(device), *chosen, std::move(*placed), world);
}

Result<vulkan::Painter> DeviceScene::prepare(const OpacityInput& input, const SceneMaps& maps,
                                             const DeviceChoice& choice) const {
    vulkan::Method method = deviceMethod(input, maps, world_);
    if (choice.hardware) {
        method.hardware = true;
        method.build = *choice.hardware;
    }
    return vulkan::Painter::make(*device_, scene_, method, choice.path.value_or(path_));
}

Result<trace::Film> DeviceScene::render(vulkan::Painter& painter, const trace::RenderSettings& settings,
                                        unsigned samples, ProgressSink& progress,
                                        double* deviceSeconds) const {
    if (settings.defer)
        return Error{ErrorKind::unsupported, "--defer: shaders defer no alpha tests; leave it out"};
    auto picture = painter.render(deviceSettings(settings, samples, world_), progress);
    if (!picture) return picture.error();
    if (deviceSeconds != nullptr) *deviceSeconds = picture->seconds;
    return filmOf(std::move(*picture), settings, samples);
}

Result<double> DeviceScene::frameSeconds(vulkan::Painter& painter, const trace::RenderSettings& settings,
                                         unsigned samples) const {
    vulkan::PictureSettings counting = deviceSettings(settings, samples, world_);
    counting.count = false;
    const auto picture = painter.render(counting, silentProgress());
    if (!picture) return picture.error();
    return picture->seconds;
}

}  // namespace filigree::jobs
