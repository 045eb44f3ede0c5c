#include "jobs/blade.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace filigree::jobs {
namespace {

uint8_t byteOf(double value) {
    return static_cast<uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255));
}

// A texel seen from the blade: along the axis, across it, and how far outside the outline.
struct Place {
    double along = 0;     // 0 at the base, 1 at the tip
    double across = 0;    // shares of the length, positive to the left
    double distance = 0;  // texels, negative inside
};

class Frame {
  public:
    explicit Frame(const Blade& blade) : blade_(blade) {
        const double dx = blade.tip.x - blade.base.x;
        const double dy = blade.tip.y - blade.base.y;
        length_ = std::hypot(dx, dy);
        axis_ = {dx / length_, dy / length_};
    }

    [[nodiscard]] Place placeOf(double x, double y) const {
        const double px = (x - blade_.base.x) / length_;
        const double py = (y - blade_.base.y) / length_;
        Place place;
        place.along = px * axis_.x + py * axis_.y;
        const double t = std::clamp(place.along, 0.0, 1.0);
        place.across = px * axis_.y - py * axis_.x - 4 * blade_.bend * t * (1 - t);
        // The gap to the outline, foreshortened where the outline runs aslant.
        const double slope = (halfWidth(std::min(1.0, t + 0.01)) - halfWidth(std::max(0.0, t - 0.01))) / 0.02;
        const double side = (std::abs(place.across) - halfWidth(t)) * length_ / std::hypot(1.0, slope);
        const double end = std::max(-place.along, place.along - 1) * length_;
        place.distance = std::max(side, end);
        return place;
    }

    [[nodiscard]] double halfWidth(double t) const { return blade_.width * blade_.profile(t); }
    [[nodiscard]] double reach() const { return (blade_.width + std::abs(blade_.bend)) * length_ + 2; }

  private:
    const Blade& blade_;
    double length_ = 0;
    Point axis_;
};

// One half of a leaf lies in the light, and the veins are paler.
Rgb shade(const Blade& blade, const Place& place) {
    double light = place.across > 0 ? 1.08 : 0.9;
    light += 0.16 * (place.along - 0.5);
    double vein = 0;
    if (blade.ribs > 0) {
        const double rib = std::abs(place.across);
        const double phase = (place.along - 1.2 * rib) * blade.ribs;
        const double gap = std::abs(phase - std::round(phase)) / blade.ribs;
        vein = std::max(std::clamp(1 - rib / 0.012, 0.0, 1.0), 0.45 * std::clamp(1 - gap / 0.008, 0.0, 1.0));
    }
    Rgb out{};
    for (size_t c = 0; c < 3; ++c) {
        const double lit = blade.colour[c] * light;
        out[c] = std::clamp(lit + vein * 0.35 * (1 - lit), 0.0, 1.0);
    }
    return out;
}

struct Box {
    uint32_t x0, y0, x1, y1;
};

uint32_t clampedTexel(double value, uint32_t size) {
    return static_cast<uint32_t>(std::clamp(value, 0.0, static_cast<double>(size)));
}

Box boxOf(const Blade& b, double reach, const scene::ColourImage& image) {
    return {clampedTexel(std::floor(std::min(b.base.x, b.tip.x) - reach), image.width),
            clampedTexel(std::floor(std::min(b.base.y, b.tip.y) - reach), image.height),
            clampedTexel(std::ceil(std::max(b.base.x, b.tip.x) + reach), image.width),
            clampedTexel(std::ceil(std::max(b.base.y, b.tip.y) + reach), image.height)};
}

}  // namespace

double leafProfile(double t) {
    return std::pow(std::sin(std::numbers::pi * std::pow(t, 0.8)), 0.9);
}

double serratedProfile(double t) {
    const double teeth = 16 * t - std::floor(16 * t);
    return leafProfile(t) * (1 - 0.16 * teeth);
}

double leafletProfile(double t) {
    return std::sqrt(std::min(1.0, 8 * t)) * std::sqrt(std::max(0.0, 1 - t * t));
}

double grassProfile(double t) {
    return std::pow(1 - t, 0.75);
}

double petalProfile(double t) {
    return std::pow(std::sin(std::numbers::pi * std::pow(t, 1.6)), 0.7);
}

double discProfile(double t) {
    return std::sqrt(std::max(0.0, 1 - (2 * t - 1) * (2 * t - 1)));
}

double stemProfile(double t) {
    return 1 - 0.5 * t;
}

void paint(const Blade& blade, scene::ColourImage& image) {
    const Frame frame(blade);
    const Box box = boxOf(blade, frame.reach(), image);
    for (uint32_t y = box.y0; y < box.y1; ++y) {
        for (uint32_t x = box.x0; x < box.x1; ++x) {
            const Place place = frame.placeOf(x + 0.5, y + 0.5);
            const double coverage = std::clamp(0.5 - place.distance, 0.0, 1.0);
            if (coverage > 0) blendTexel(image, x, y, shade(blade, place), coverage);
        }
    }
}

scene::ColourImage clearImage(uint32_t width, uint32_t height, const Rgb& colour) {
    scene::ColourImage image{width, height, std::vector<uint8_t>(size_t{4} * width * height)};
    for (size_t i = 0; i < image.rgba.size(); i += 4) {
        for (size_t c = 0; c < 3; ++c) image.rgba[i + c] = byteOf(colour[c]);
    }
    return image;
}

void blendTexel(scene::ColourImage& image, uint32_t x, uint32_t y, const Rgb& colour, double coverage) {
    uint8_t* texel = &image.rgba[4 * (size_t{y} * image.width + x)];
    const double below = texel[3] / 255.0 * (1 - coverage);
    const double alpha = coverage + below;
    if (alpha <= 0) return;
    for (size_t c = 0; c < 3; ++c) {
        texel[c] = byteOf((colour[c] * coverage + texel[c] / 255.0 * below) / alpha);
    }
    texel[3] = byteOf(alpha);
}

}  // namespace filigree::jobs
