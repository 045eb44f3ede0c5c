#include "filigree/trace/render.h"

#include "trace/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace filigree::trace {
namespace {

constexpr std::array<std::string_view, 4> integratorNames{"primary", "shadow", "ao", "path"};

// Brightens dark pictures, those of halls that the sun does not reach.
float exposure(const Film& film) {
    constexpr double wanted = 0.35;  // mean of all channels
    double sum = 0;
    for (const Vec3& light : film.sums) sum += double{light[0]} + light[1] + light[2];
    const double mean = sum / (3.0 * film.samples * static_cast<double>(film.sums.size()));
    return mean > 0 ? static_cast<float>(std::clamp(wanted / mean, 1.0, 12.0)) : 1;
}

// Each channel of a sum as `tone` of it, which is cut at 1.
template <class Tone>
scene::ColourImage pictureOf(const Film& film, const Tone& tone) {
    scene::ColourImage image{film.width, film.height, {}};
    image.rgba.reserve(4 * film.sums.size());
    for (const Vec3& sum : film.sums) {
        for (const float channel : sum) image.rgba.push_back(srgbOf(tone(channel)));
        image.rgba.push_back(255);
    }
    return image;
}

}  // namespace

std::string_view nameOf(Integrator integrator) {
    return integratorNames[static_cast<size_t>(integrator)];
}

std::optional<Integrator> integratorNamed(std::string_view name) {
    const auto found = std::ranges::find(integratorNames, name);
    if (found == integratorNames.end()) return std::nullopt;
    return static_cast<Integrator>(found - integratorNames.begin());
}

Status checkSize(uint32_t width, uint32_t height) {
    for (const uint32_t side : {width, height}) {
        if (side >= 1 && side <= maxPictureSide) continue;
        return Error{ErrorKind::usage, fmt::format("a picture of {} x {} pixels: give sides from 1 to {}",
                                                   width, height, maxPictureSide)};
    }
    return {};
}

Status check(const RenderSettings& settings) {
    if (auto checked = checkSize(settings.width, settings.height); !checked) return checked;
    const auto& m = settings.camera.transform;
    const float fov = settings.camera.verticalFov;
    const bool good =
        std::ranges::all_of(m, [](float x) { return std::isfinite(x); }) && fov > 0 && fov < 3.14F;
    if (!good)
        return Error{ErrorKind::usage,
                     "the camera is not finite, or its angle not between 0 and 180 degrees"};
    return {};
}

scene::ColourImage developed(const Film& film) {
    const float scale = film.samples > 0 ? exposure(film) / static_cast<float>(film.samples) : 0;
    return pictureOf(film, [scale](float sum) { return 1 - std::exp(-sum * scale); });
}

scene::ColourImage exposed(const Film& film, float exposure) {
    const float scale = film.samples > 0 ? exposure / static_cast<float>(film.samples) : 0;
    return pictureOf(film, [scale](float sum) { return sum * scale; });
}

}  // namespace filigree::trace
