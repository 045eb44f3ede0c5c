// Pictures of a world, sample by sample.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/core/vec3.h"
#include "filigree/scene/scene.h"
#include "filigree/trace/counters.h"
#include "filigree/trace/opacity.h"
#include "filigree/trace/world.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace filigree::trace {

// What a picture shows.
enum class Integrator : uint8_t {
    primary,  // base colour, lit from the camera
    shadow,   // base colour, sun with shadow rays, and a constant sky
    ao,       // ambient occlusion: cosine-weighted rays of limited length
    path,     // diffuse paths under sky and sun
};
// The names of the command line, and the way back.
FILIGREE_API std::string_view nameOf(Integrator integrator);
FILIGREE_API std::optional<Integrator> integratorNamed(std::string_view name);

// How a picture is rendered.
struct RenderSettings {
    uint32_t width = 960;   // pixels, 1..maxPictureSide
    uint32_t height = 540;  // pixels
    Integrator integrator = Integrator::ao;
    scene::Camera camera;
    uint32_t seed = 1;
    unsigned bounces = 3;  // of a path
    // Length of AO rays in world units; 0: a tenth of the diagonal of the world's bounds.
    float aoDistance = 0;
    // Shadow rays set unknown candidates aside in the hope of an opaque one, and test them only without
    // (Fenney and Ozkan 2023, section 6).
    bool defer = false;
    // Shadow and AO rays read 4-state maps as 2-state.
    bool twoStateShadows = false;
    // Fill RayCounts::bitsRead and Film::bitsRead, which looks everything up twice.
    bool countBitsRead = false;
};
// The largest width or height, in pixels.
inline constexpr uint32_t maxPictureSide = 16384;

// What has been rendered so far.
struct Film {
    uint32_t width = 0;
    uint32_t height = 0;
    unsigned samples = 0;              // of each pixel
    std::vector<Vec3> sums;            // [width * height], linear light, of all samples
    std::vector<uint32_t> alphaTests;  // [width * height], texture fetches of all samples
    std::vector<uint32_t> bitsRead;    // [width * height], by lookups
    Counters counters;
    uint64_t pixelsHit = 0;  // samples whose first ray met the scene

    Film(uint32_t w, uint32_t h)
        : width(w), height(h), sums(size_t{w} * h), alphaTests(size_t{w} * h), bitsRead(size_t{w} * h) {}
};

// ErrorKind::usage when a side is out of range.
FILIGREE_API Status checkSize(uint32_t width, uint32_t height);

// ErrorKind::usage when settings are out of range.
FILIGREE_API Status check(const RenderSettings& settings);

// World units: how far rays start off the surfaces of a world, and how far AO rays reach.
FILIGREE_API float rayEpsilon(const World& world);
FILIGREE_API float aoDistanceOf(const RenderSettings& settings, const World& world);

// Adds one more sample of every pixel to `film`; progress advances by pixels. The film depends on the world,
// the opacity's answers, the settings and how many samples it has had, not on the executor. False when
// cancelled; the film is no use then.
FILIGREE_API bool addSample(const World& world, const Opacity& opacity, const RenderSettings& settings,
                            const Executor& executor, ProgressSink& progress, Film& film);

// The mean as 8-bit sRGB, tone-mapped as 1 - exp(-x); dark pictures are brightened, up to twelve times.
FILIGREE_API scene::ColourImage developed(const Film& film);

// The mean times `exposure` as 8-bit sRGB, cut where it passes 1: colours keep their proportions.
FILIGREE_API scene::ColourImage exposed(const Film& film, float exposure);

// A sensible camera when a file has none, for a picture `aspect` times as wide as high: all of the world from
// outside, from where most is to be seen; from within where no surface with holes shows outside.
FILIGREE_API scene::Camera overview(const World& world, float aspect = 16.0F / 9);

// A camera at `eye` that looks at `target`; `fov` is vertical, in radians.
FILIGREE_API scene::Camera lookAt(const Vec3& eye, const Vec3& target, const Vec3& up, float fov);

}  // namespace filigree::trace
