#include "jobs/camera_choice.h"

#include "filigree/trace/render.h"

#include <numbers>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

Result<scene::Camera> ownCamera(const OwnCamera& own) {
    if (own.eye == own.target) return Error{ErrorKind::usage, "--camera: eye and target are the same point"};
    return trace::lookAt(own.eye, own.target, own.up, own.fov * std::numbers::pi_v<float> / 180);
}

}  // namespace

Result<scene::Camera> cameraFor(const CameraChoice& choice, const scene::Scene& scene,
                                const trace::World& world, float aspect) {
    if (const auto* own = std::get_if<OwnCamera>(&choice)) return ownCamera(*own);
    if (const auto* number = std::get_if<unsigned>(&choice)) {
        if (*number < scene.cameras.size()) return scene.cameras[*number];
        return Error{ErrorKind::usage, fmt::format("--camera {}: the scene has {} cameras, counted from 0",
                                                   *number, scene.cameras.size())};
    }
    return scene.cameras.empty() ? trace::overview(world, aspect) : scene.cameras[0];
}

}  // namespace filigree::jobs
