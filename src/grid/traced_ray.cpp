#include "grid/traced_ray.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace filigree::grid {
namespace {

Box rootBox(const bvh::Node& root) {
    Box box;
    for (size_t k = 0; k < bvh::width; ++k) {
        if (root.hasChild(k)) box.extend(root.childBox(k));
    }
    return box;
}

// Rays from further away start near the scene instead: in floats they would be too coarse.
constexpr double farExtents = 16;

}  // namespace

TracedScene::TracedScene(const EncodedGrids& grids) {
    if (grids.codec == Codec::lattice) {
        origin = grids.lattice.origin;
        step = grids.lattice.step;
    }
    for (size_t k = 0; k < 3; ++k) perStep[k] = 1 / step[k];
    largest = bvh::largestCoordinates(grids.nodes[0]);
    const Box box = rootBox(grids.nodes[0]);
    for (size_t k = 0; k < 3 && !box.empty(); ++k) {
        centre[k] = (double{box.low[k]} + box.high[k]) / 2;
        extent = std::max(extent, double{box.high[k]} - box.low[k]);
    }
}

bool TracedRay::start(const TracedScene& scene, const Ray& ray) {
    hit.leaf = bvh::noLeaf;
    std::array<double, 3> from{};
    std::array<double, 3> along{};
    double longest = 0;
    double distance = 0;
    for (size_t k = 0; k < 3; ++k) {
        from[k] = (ray.origin[k] - scene.origin[k]) * scene.perStep[k];
        along[k] = ray.direction[k] * scene.perStep[k];
        longest = std::max(longest, std::abs(along[k]));
        distance = std::max(distance, std::abs(from[k] - scene.centre[k]));
    }
    const bool isSomewhere = std::isfinite(from[0] + from[1] + from[2]) &&
                             std::isfinite(along[0] + along[1] + along[2]) && longest > 0;
    if (!isSomewhere || !(ray.tMin <= ray.tMax)) return false;
    // The power of two that is not greater; of what is too small for one, the least.
    const uint64_t exponent = std::bit_cast<uint64_t>(longest) & uint64_t{0x7ff} << 52;
    scale_ = std::bit_cast<double>(std::max(exponent, uint64_t{2} << 52));
    const double perScale = std::bit_cast<double>((uint64_t{2046} << 52) - std::bit_cast<uint64_t>(scale_));
    shift_ = 0;
    for (double& part : along) part *= perScale;
    if (distance > farExtents * scene.extent) {
        double dot = 0;
        double square = 0;
        for (size_t k = 0; k < 3; ++k) {
            dot += (scene.centre[k] - from[k]) * along[k];
            square += along[k] * along[k];
        }
        shift_ = dot / square;
        for (size_t k = 0; k < 3; ++k) from[k] += shift_ * along[k];
    }
    for (size_t k = 0; k < 3; ++k) {
        origin[k] = static_cast<float>(from[k]);
        direction[k] = static_cast<float>(along[k]);
        // What passes the scene far away even where it is nearest.
        if (shift_ != 0 && std::abs(from[k] - scene.centre[k]) > 2 * farExtents * scene.extent) return false;
    }
    tMin = static_cast<float>(ray.tMin * scale_ - shift_);
    tMax = static_cast<float>(ray.tMax * scale_ - shift_);
    setShear();
    setPlanes(scene);
    return true;
}

bvh::Segment TracedRay::segment() const {
    return {origin, direction, tMin, tMax};
}

float TracedRay::worldT(const Ray& ray) const {
    const auto t = static_cast<float>((tMax + shift_) / scale_);
    return std::clamp(t, ray.tMin, ray.tMax);
}

void TracedRay::setShear() {
    unsigned z = 0;
    for (unsigned k = 1; k < 3; ++k) {
        if (std::abs(direction[k]) > std::abs(direction[z])) z = k;
    }
    axes = {(z + 1) % 3, (z + 2) % 3, z};
    scaleZ = 1 / direction[z];
    shearX = direction[axes[0]] / direction[z];
    shearY = direction[axes[1]] / direction[z];
}

// As the walk through the hierarchy does it; lattice coordinates are exact, so it errs by less.
void TracedRay::setPlanes(const TracedScene& scene) {
    constexpr float steepest = 0x1p60F;
    for (size_t k = 0; k < 3; ++k) {
        const bool isFlat = std::abs(direction[k]) < 1 / steepest;
        reciprocal[k] = isFlat ? std::copysign(steepest, direction[k]) : 1 / direction[k];
        const float slack = bvh::walkSlack * (scene.largest[k] + std::abs(origin[k]));
        boxLow[k] = origin[k] + slack;
        boxHigh[k] = origin[k] - slack;
    }
}

}  // namespace filigree::grid
