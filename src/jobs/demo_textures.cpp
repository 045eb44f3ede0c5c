#include "jobs/demo_textures.h"

#include "jobs/blade.h"
#include "jobs/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace filigree::jobs {
namespace {

// How one tree grows its leaves.
struct Species {
    double (*profile)(double);
    double width;   // of a leaf, share of its length
    double length;  // texels
    double angle;   // between leaf and twig, radians
    int pairs;
    int fingers;  // blades a leaf, spread like a hand
    Rgb colour;
};

constexpr std::array<Species, 4> species = {{
    {serratedProfile, 0.27, 195, 0.95, 5, 1, {0.27, 0.50, 0.16}},
    {leafProfile, 0.11, 235, 0.7, 7, 1, {0.42, 0.58, 0.27}},
    {serratedProfile, 0.17, 150, 1.05, 3, 5, {0.74, 0.34, 0.12}},
    {leafProfile, 0.38, 142, 1.05, 5, 1, {0.62, 0.60, 0.16}},
}};

Rgb varied(const Rgb& colour, Random& random) {
    const double light = random.uniform(0.85, 1.15);
    return {colour[0] * light * random.uniform(0.94, 1.06), colour[1] * light, colour[2] * light};
}

Point step(Point from, double angle, double length) {
    return {from.x + length * std::sin(angle), from.y - length * std::cos(angle)};
}

// A leaf at `base` that points `angle` to the right of up, on a short stalk.
void paintLeaf(const Species& s, Point base, double angle, double length, Random& random,
               scene::ColourImage& image) {
    const Rgb colour = varied(s.colour, random);
    const Point stalk = step(base, angle, 0.12 * length);
    paint({base, stalk, 0, 0.16, stemProfile, {0.36, 0.27, 0.14}, 0}, image);
    const int side = s.fingers / 2;
    // The outer fingers first, so that the middle one lies on top.
    for (int reach = side; reach >= 0; --reach) {
        for (const int sign : {-1, 1}) {
            const double shorter = 1 - 0.17 * reach;
            const double turned = angle + sign * reach * 0.62;
            paint({stalk, step(stalk, turned, length * shorter), random.uniform(-0.05, 0.05), s.width,
                   s.profile, colour, 7},
                  image);
            if (reach == 0) break;
        }
    }
}

// A twig from the bottom to the top of the square of `size` texels at (left, top).
void paintTwig(const Species& s, Point corner, double size, Random& random, scene::ColourImage& image) {
    const Point root{corner.x + 0.5 * size, corner.y + 0.985 * size};
    const double length = 0.93 * size - s.length;
    const Point top = step(root, 0, length);
    paint({root, top, 0, 0.011, stemProfile, {0.33, 0.24, 0.13}, 0}, image);
    for (int i = 0; i < s.pairs; ++i) {
        const double t = (i + 0.9) / (s.pairs + 0.5);
        const double leaf = s.length * (1 - 0.25 * t);
        for (const int sign : {-1, 1}) {
            const Point base = step(root, 0, length * (t + 0.03 * sign));
            paintLeaf(s, base, sign * (s.angle * (1.1 - 0.3 * t) + random.uniform(-0.12, 0.12)), leaf, random,
                      image);
        }
    }
    paintLeaf(s, top, random.uniform(-0.1, 0.1), s.length * 0.85, random, image);
}

// A leaf of a frond, itself set with leaflets.
void paintPinna(Point base, double angle, double length, Random& random, scene::ColourImage& image) {
    const Rgb stem{0.35, 0.42, 0.16};
    const Point tip = step(base, angle, length);
    const int leaflets = std::max(3, static_cast<int>(length / 9.5));
    for (int i = 0; i < leaflets; ++i) {
        const double t = (i + 0.6) / (leaflets + 0.2);
        const double size = 0.085 * length * (1 - 0.7 * t) + 4;
        for (const int sign : {-1, 1}) {
            const Point at{base.x + t * (tip.x - base.x), base.y + t * (tip.y - base.y)};
            paint({at, step(at, angle + sign * 1.15, size), 0, 0.26, leafletProfile,
                   varied({0.30, 0.52, 0.17}, random), 0},
                  image);
        }
    }
    paint({base, tip, 0, 0.011, stemProfile, stem, 0}, image);
}

// The chain-link wire nearest to a point of the tile, in shares of the tile.
double wireDistance(double diagonal) {
    return std::abs(diagonal - std::round(diagonal)) / std::numbers::sqrt2;
}

// Wires bow over and under each other.
double bow(double along) {
    return 0.022 * std::sin(4 * std::numbers::pi * along);
}

// Zinc wire, round in the light.
Rgb wireColour(double distance, double halfWidth) {
    const double across = std::min(1.0, distance / halfWidth);
    const double light = 0.38 + 0.42 * std::sqrt(1 - across * across);
    return {light * 0.97, light, light * 1.03};
}

}  // namespace

scene::ColourImage leavesTexture() {
    scene::ColourImage image = clearImage(1024, 1024, {0.36, 0.45, 0.17});
    Random random(11);
    for (size_t i = 0; i < species.size(); ++i) {
        const Point corner{512.0 * static_cast<double>(i % 2), 512.0 * static_cast<double>(i / 2)};
        paintTwig(species[i], corner, 512, random, image);
    }
    return image;
}

scene::ColourImage fernTexture() {
    scene::ColourImage image = clearImage(512, 1024, {0.30, 0.50, 0.17});
    Random random(23);
    const Point root{256, 1020};
    const double length = 985;
    constexpr int pairs = 23;
    for (int i = 0; i < pairs; ++i) {
        const double t = 0.16 + 0.82 * i / pairs;
        // Longest a third of the way up.
        const double size = 225 * std::min(std::pow(1.5 * (1 - t), 0.9), 0.5 + 2.1 * (t - 0.12));
        for (const int sign : {-1, 1}) {
            const Point base = step(root, 0, length * (t + 0.006 * sign));
            paintPinna(base, sign * (1.35 - 0.45 * t), size + 6, random, image);
        }
    }
    paint({root, step(root, 0, length), 0, 0.006, stemProfile, {0.38, 0.40, 0.15}, 0}, image);
    return image;
}

scene::ColourImage grassTexture() {
    scene::ColourImage image = clearImage(512, 256, {0.33, 0.48, 0.16});
    Random random(37);
    for (int i = 0; i < 60; ++i) {
        const double lean = random.uniform(-0.55, 0.55);
        const double height = random.uniform(110, 235) * std::cos(lean);
        const Point base{256 + random.uniform(-190, 190), 262};
        const Rgb colour = varied({0.36, 0.52, 0.15}, random);
        paint({base, step(base, lean, height), 0.25 * lean, random.uniform(0.022, 0.04), grassProfile, colour,
               0},
              image);
    }
    return image;
}

scene::ColourImage blossomTexture() {
    scene::ColourImage image = clearImage(128, 128, {0.93, 0.80, 0.86});
    Random random(41);
    for (int i = 0; i < 6; ++i) {
        const Point centre{64, 64};
        const double angle = i * std::numbers::pi / 3;
        paint({step(centre, angle, 6), step(centre, angle, 60), 0, 0.33, petalProfile,
               varied({0.90, 0.66, 0.78}, random), 0},
              image);
    }
    paint({{53, 64}, {75, 64}, 0, 0.5, discProfile, {0.93, 0.75, 0.2}, 0}, image);
    return image;
}

scene::ColourImage fenceTexture() {
    constexpr uint32_t size = 256;
    constexpr double halfWidth = 0.05;
    scene::ColourImage image = clearImage(size, size, {0.55, 0.56, 0.57});
    for (uint32_t y = 0; y < size; ++y) {
        for (uint32_t x = 0; x < size; ++x) {
            const double u = (x + 0.5) / size;
            const double v = (y + 0.5) / size;
            const double rising = wireDistance(u + v + bow(u - v));
            const double falling = wireDistance(u - v + bow(u + v));
            // The wires weave: at the tile's middle one is on top, at its corners the other.
            const bool middle = std::abs(u - 0.5) + std::abs(v - 0.5) < 0.5;
            for (const double wire : {middle ? falling : rising, middle ? rising : falling}) {
                const double coverage = std::clamp(0.5 + (halfWidth - wire) * size, 0.0, 1.0);
                blendTexel(image, x, y, wireColour(wire, halfWidth), coverage);
            }
        }
    }
    return image;
}

}  // namespace filigree::jobs
