#include "filigree/trace/render.h"

#include "trace/camera.h"
#include "trace/cast.h"
#include "trace/world_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace filigree::trace {
namespace {

constexpr uint32_t trialHeight = 40;  // pixels of a picture that tries a camera
constexpr unsigned directions = 8;
constexpr unsigned onAnyGrid = ~0u;  // stands for an instance

Vec3 towards(unsigned direction, float elevation) {
    const float angle = 2 * std::numbers::pi_v<float> * (static_cast<float>(direction) + 0.3F) / directions;
    return {std::cos(angle) * std::cos(elevation), std::sin(elevation),
            std::sin(angle) * std::cos(elevation)};
}

// From within the box, `along` and `up` shares of it, along its longer side.
scene::Camera inside(const Box& box, float along, float up, const Vec3& direction) {
    const Vec3 size = minus(box.high, box.low);
    Vec3 eye = times(plus(box.low, box.high), 0.5F);
    const size_t axis = size[0] >= size[2] ? 0 : 2;
    eye[axis] = box.low[axis] + along * size[axis];
    eye[1] = box.low[1] + up * size[1];
    return lookAt(eye, plus(eye, direction), {0, 1, 0}, usualFov);
}

// What a camera sees.
struct Trial {
    double interest = 0;
    double testedShare = 0;  // of pixels whose surface has holes
};

// Many different things are of interest, those with holes above all; what stands in the eye is not.
Trial tryCamera(const World& world, const Opacity& opacity, const scene::Camera& camera, float aspect) {
    const auto width = static_cast<uint32_t>(std::clamp(trialHeight * aspect, 1.0F, 4.0F * trialHeight));
    const CameraRays rays(camera, width, trialHeight);
    Caster caster(world.data(), opacity.data(), {});
    const float near = 0.01F * world.bounds().diagonal();
    std::map<std::pair<unsigned, unsigned>, double> seen;  // pixels by instance and surface
    Trial trial;
    const double pixel = 1.0 / (width * trialHeight);
    for (uint32_t k = 0; k < width * trialHeight; ++k) {
        const Vec3 direction =
            rays.through(static_cast<float>(k % width) + 0.5F, static_cast<float>(k / width) + 0.5F);
        Ray ray{rays.origin(), direction, near, 0, RayKind::primary};
        if (caster.nearestHit(ray)) {
            trial.interest -= 4 * pixel;
            continue;
        }
        ray.length = std::numeric_limits<float>::infinity();
        const auto hit = caster.nearestHit(ray);
        if (!hit) continue;
        if (hit->onGrid()) {
            seen[{onAnyGrid, 0}] += pixel;
            continue;
        }
        const Surface& surface = world.data().surfaceOf(hit->surface);
        if (surface.kind != AlphaKind::opaque) trial.testedShare += pixel;
        seen[{hit->surface.instID[0], surface.number}] += pixel;
    }
    for (const auto& [what, share] : seen)
        trial.interest += std::sqrt(share) * (what.first != onAnyGrid && world.isTested(what.second) ? 3 : 1);
    return trial;
}

// Keeps the camera of most interest.
class Choice {
  public:
    Choice(const World& world, const Opacity& opacity, float aspect)
        : world_(world), opacity_(opacity), aspect_(aspect) {}

    void offer(const scene::Camera& camera) {
        const Trial trial = tryCamera(world_, opacity_, camera, aspect_);
        if (some_ && trial.interest <= best_.interest) return;
        some_ = true;
        best_ = trial;
        camera_ = camera;
    }
    [[nodiscard]] const Trial& best() const { return best_; }
    [[nodiscard]] const scene::Camera& camera() const { return camera_; }

  private:
    const World& world_;
    const Opacity& opacity_;
    float aspect_;
    bool some_ = false;
    Trial best_;
    scene::Camera camera_;
};

bool hasHoles(const World& world) {
    for (size_t k = 0; k < world.surfaceCount(); ++k) {
        if (world.isTested(k)) return true;
    }
    return false;
}

}  // namespace

scene::Camera overview(const World& world, float aspect) {
    const Box box = world.bounds();
    if (box.empty()) return lookAt({0, 0, 1}, {0, 0, 0}, {0, 1, 0}, usualFov);
    const auto opacity = Opacity::make(Method::texture, 4, world, {}, {});
    Choice whole(world, *opacity, aspect);
    for (const float elevation : {0.25F, 0.5F}) {
        for (unsigned k = 0; k < directions; ++k)
            whole.offer(cameraOutside(box, towards(k, elevation), aspect));
    }
    constexpr double enough = 0.01;  // of the picture
    if (!hasHoles(world) || whole.best().testedShare > enough) return whole.camera();
    Choice within(world, *opacity, aspect);
    for (const float up : {0.12F, 0.3F, 0.5F}) {
        for (const float along : {0.1F, 0.3F, 0.5F, 0.7F, 0.9F}) {
            for (unsigned k = 0; k < directions; ++k) within.offer(inside(box, along, up, towards(k, 0)));
        }
    }
    return within.best().testedShare > whole.best().testedShare ? within.camera() : whole.camera();
}

}  // namespace filigree::trace
