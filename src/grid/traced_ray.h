// A ray in the coordinates of the records, and its nearest hit so far.
#pragma once

#include "filigree/bvh/walk.h"
#include "filigree/grid/rays.h"

#include <array>
#include <cstdint>

namespace filigree::grid {

// Where a scene lies, for all rays.
struct TracedScene {
    explicit TracedScene(const EncodedGrids& grids);

    std::array<double, 3> origin{};  // world = origin + step * record
    std::array<double, 3> step{1, 1, 1};
    std::array<double, 3> perStep{1, 1, 1};
    std::array<double, 3> centre{};  // record coordinates
    double extent = 0;               // the longest side
    Vec3 largest{};                  // no coordinate is greater
};

// A triangle that was hit, in record coordinates.
struct TracedHit {
    uint32_t leaf = bvh::noLeaf;
    uint8_t block = 0;  // place in the tile: 4 row + column of the patch
    uint8_t quad = 0;   // place in the block, the same; of a cluster its triangle
    uint8_t half = 0;
    float u = 0;
    float v = 0;
    std::array<Vec3, 3> corners{};
};

// origin + t * direction, the largest component of the direction at least 1 and below 2.
struct TracedRay {
    // False for a ray that hits nothing, being nowhere or pointing nowhere.
    bool start(const TracedScene& scene, const Ray& ray);
    [[nodiscard]] bvh::Segment segment() const;
    [[nodiscard]] bool isHit() const { return hit.leaf != bvh::noLeaf; }
    [[nodiscard]] float worldT(const Ray& ray) const;

    Vec3 origin{};
    Vec3 direction{};
    float tMin = 0;
    float tMax = 0;  // of the nearest hit, once there is one
    TracedHit hit;

    // Coordinates in which the ray is the third axis: x - shearX * z, y - shearY * z (Woop, Benthin and Wald
    // 2013). axes: which one is x, y, z.
    std::array<unsigned, 3> axes{};
    float shearX = 0;
    float shearY = 0;
    float scaleZ = 0;

    // Planes of boxes: (low - boxLow) * reciprocal and (high - boxHigh) * reciprocal.
    Vec3 boxLow{};
    Vec3 boxHigh{};
    Vec3 reciprocal{};

  private:
    double scale_ = 1;  // record t = scale * world t - shift
    double shift_ = 0;

    void setShear();
    void setPlanes(const TracedScene& scene);
};

}  // namespace filigree::grid
