// The brush that paints the demo's plants: one leaf, needle, petal or stem at a time.
#pragma once

#include "filigree/scene/scene.h"

#include <array>
#include <cstdint>

namespace filigree::jobs {

using Rgb = std::array<double, 3>;  // sRGB, each in [0, 1]

struct Point {
    double x = 0;
    double y = 0;
};

// A flat shape about an axis from `base` to `tip`, in texels.
struct Blade {
    Point base;
    Point tip;
    double bend = 0;   // how far the axis bows to its left at the middle, as a share of its length
    double width = 0;  // half-width at the widest place, as a share of the length
    // Half-width at t in [0, 1] from base to tip, as a share of `width`.
    double (*profile)(double t) = nullptr;
    Rgb colour{};
    double ribs = 0;  // how many pairs of side veins; 0 for none
};

// Half-widths of common shapes.
double leafProfile(double t);      // pointed at both ends
double serratedProfile(double t);  // the same with a toothed edge
double leafletProfile(double t);   // broad at the base, round at the tip
double grassProfile(double t);     // narrowing all along
double petalProfile(double t);     // broadest near the tip
double discProfile(double t);      // round
double stemProfile(double t);      // nearly even

// Paints `blade` over `image`, its edge smooth to the texel.
void paint(const Blade& blade, scene::ColourImage& image);

// A wholly transparent image whose hidden colour is `colour`, so that filtering draws no dark fringe.
scene::ColourImage clearImage(uint32_t width, uint32_t height, const Rgb& colour);

// Blends one texel's colour in with `coverage` in [0, 1].
void blendTexel(scene::ColourImage& image, uint32_t x, uint32_t y, const Rgb& colour, double coverage);

}  // namespace filigree::jobs
