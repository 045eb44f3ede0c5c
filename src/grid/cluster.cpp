#include "filigree/grid/cluster.h"

#include "filigree/core/box.h"

#include "grid/cluster_growth.h"
#include "grid/weld.h"

#include <algorithm>
#include <limits>

namespace filigree::grid {
namespace {

// Parts are clustered by themselves, several at a time; their size must not depend on the executor.
constexpr size_t partTriangles = size_t{1} << 16;

// Bit b of each coordinate goes to bit 3 b and the two above it.
uint64_t spreadBits(uint64_t value) {
    value = (value | value << 32) & 0x001f00000000ffff;
    value = (value | value << 16) & 0x001f0000ff0000ff;
    value = (value | value << 8) & 0x100f00f00f00f00f;
    value = (value | value << 4) & 0x10c30c30c30c30c3;
    return (value | value << 2) & 0x1249249249249249;
}

class LooseClustering {
  public:
    explicit LooseClustering(GridMesh& mesh) : mesh_(mesh), triangles_(mesh.looseTriangles) {
        const std::vector<uint32_t> firsts = weld({mesh.looseVertices, {}, {}});
        for (std::array<uint32_t, 3>& triangle : triangles_) {
            for (uint32_t& vertex : triangle) vertex = firsts[vertex];
        }
        for (const Vec3& position : mesh.looseVertices) box_.extend(position);
    }

    std::vector<uint32_t> run(const Executor& executor) {
        const std::vector<uint32_t> inSpace = orderInSpace();
        const size_t parts = (inSpace.size() + partTriangles - 1) / partTriangles;
        std::vector<std::vector<ClusterMembers>> clusters(parts);
        executor.parallelFor(parts, 1, [&](size_t begin, size_t end) {
            for (size_t p = begin; p < end; ++p) {
                const auto part = std::span(inSpace).subspan(p * partTriangles);
                clusters[p] = growClusters({mesh_.looseVertices, triangles_,
                                            part.first(std::min(part.size(), partTriangles)),
                                            box_.diagonal() * 0x1p-17F});
            }
        });
        return reorder(clusters);
    }

  private:
    // By the place of the middles on a curve that keeps neighbours together (Morton 1966).
    std::vector<uint32_t> orderInSpace() const {
        std::vector<std::pair<uint64_t, uint32_t>> keyed;
        keyed.reserve(triangles_.size());
        for (uint32_t t = 0; t < triangles_.size(); ++t) keyed.emplace_back(placeOnCurve(triangles_[t]), t);
        std::ranges::sort(keyed);
        std::vector<uint32_t> order;
        order.reserve(keyed.size());
        for (const auto& [key, t] : keyed) order.push_back(t);
        return order;
    }

    uint64_t placeOnCurve(const std::array<uint32_t, 3>& triangle) const {
        constexpr double cells = 1 << 21;
        double most = std::numeric_limits<float>::min();
        for (size_t axis = 0; axis < 3; ++axis)
            most = std::max(most, double{box_.high[axis]} - double{box_.low[axis]});
        uint64_t key = 0;
        for (size_t axis = 0; axis < 3; ++axis) {
            double middle = 0;
            for (const uint32_t v : triangle) middle += double{mesh_.looseVertices[v][axis]} / 3;
            const double cell = (middle - box_.low[axis]) / most * cells;
            key |= spreadBits(static_cast<uint64_t>(std::clamp(cell, 0.0, cells - 1))) << axis;
        }
        return key;
    }

    std::vector<uint32_t> reorder(std::vector<std::vector<ClusterMembers>>& parts) {
        std::vector<uint32_t> begins{0};
        std::vector<std::array<uint32_t, 3>> ordered;
        std::vector<uint32_t> sources;
        std::vector<uint8_t> turns;
        for (std::vector<ClusterMembers>& clusters : parts) {
            for (ClusterMembers& members : clusters) {
                orderCluster(triangles_, members, turns);
                for (size_t m = 0; m < members.size(); ++m) {
                    std::array<uint32_t, 3> triangle = mesh_.looseTriangles[members[m]];
                    std::rotate(triangle.begin(), triangle.begin() + turns[m], triangle.end());
                    ordered.push_back(triangle);
                    if (!mesh_.looseSources.empty()) sources.push_back(mesh_.looseSources[members[m]]);
                }
                begins.push_back(static_cast<uint32_t>(ordered.size()));
            }
        }
        mesh_.looseTriangles = std::move(ordered);
        mesh_.looseSources = std::move(sources);
        return begins;
    }

    GridMesh& mesh_;
    std::vector<std::array<uint32_t, 3>> triangles_;  // over welded vertices
    Box box_;
};

}  // namespace

std::vector<uint32_t> clusterLoose(GridMesh& mesh, const Executor& executor) {
    if (mesh.looseTriangles.empty()) return {0};
    return LooseClustering(mesh).run(executor);
}

}  // namespace filigree::grid
