#include "filigree/grid/error.h"

#include "grid/shared_places.h"

#include <algorithm>
#include <cmath>

namespace filigree::grid {
namespace {

double distanceOf(const Vec3& a, const Vec3& b) {
    return std::hypot(double{a[0]} - double{b[0]}, double{a[1]} - double{b[1]}, double{a[2]} - double{b[2]});
}

const Vec3& decodedAt(const DecodedGrids& decoded, const MeshPlace& place) {
    return place.isLoose ? decoded.looseTriangles[place.index / 3][place.index % 3]
                         : decoded.vertices[place.index];
}

}  // namespace

Cracks cracksOf(const GridMesh& mesh, const DecodedGrids& decoded) {
    Cracks cracks;
    forEachShared(mesh, [&](std::span<const MeshPlace> places) {
        double widest = 0;
        // From the first: at least half the largest distance of any two.
        for (const MeshPlace& place : places)
            widest = std::max(widest, distanceOf(decodedAt(decoded, places[0]), decodedAt(decoded, place)));
        ++cracks.shared;
        if (widest > 0) ++cracks.cracked;
        cracks.widest = std::max(cracks.widest, widest);
    });
    return cracks;
}

}  // namespace filigree::grid
