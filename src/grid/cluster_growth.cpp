#include "grid/cluster_growth.h"

#include "filigree/core/box.h"
#include "filigree/grid/cluster.h"

#include "grid/buckets.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace filigree::grid {
namespace {

constexpr uint32_t noTriangle = 0xffffffff;
// Entries of one list, so that no list is walked again and again; and free triangles to one side of another.
constexpr uint32_t mostLookedAt = 256;
constexpr size_t mostTried = 24;

// To 2e-4; the same on every machine, as std::log2 need not be. `x` is positive.
float roughLog2(float x) {
    const auto bits = std::bit_cast<uint32_t>(x);
    const auto exponent = static_cast<float>(static_cast<int32_t>(bits >> 23) - 127);
    const float f = std::bit_cast<float>((bits & 0x007fffff) | 0x3f800000) - 1;
    return exponent + f * (1.439909F + f * (-0.683446F + f * (0.329319F - f * 0.085783F)));
}

// The triangles of the part over vertices of its own.
struct PartMesh {
    std::vector<Vec3> positions;
    std::vector<std::array<uint32_t, 3>> triangles;

    explicit PartMesh(const ClusterInput& input) {
        std::vector<uint32_t> used;
        for (const uint32_t t : input.part)
            used.insert(used.end(), input.triangles[t].begin(), input.triangles[t].end());
        std::ranges::sort(used);
        used.erase(std::unique(used.begin(), used.end()), used.end());
        for (const uint32_t v : used) positions.push_back(input.positions[v]);
        const auto local = [&](uint32_t v) {
            return static_cast<uint32_t>(std::ranges::lower_bound(used, v) - used.begin());
        };
        for (const uint32_t t : input.part) {
            const auto& [a, b, c] = input.triangles[t];
            triangles.push_back({local(a), local(b), local(c)});
        }
    }
};

// The diagonal around as many triangles as a cluster takes, as they follow each other: the median.
float usualSize(const PartMesh& part) {
    std::vector<float> sizes;
    for (size_t first = 0; first < part.triangles.size(); first += maxClusterTriangles) {
        Box box;
        const auto here = std::span(part.triangles).subspan(first);
        for (const auto& triangle : here.first(std::min(here.size(), maxClusterTriangles))) {
            for (const uint32_t v : triangle) box.extend(part.positions[v]);
        }
        sizes.push_back(box.diagonal());
    }
    const auto middle = sizes.begin() + static_cast<ptrdiff_t>(sizes.size() / 2);
    std::ranges::nth_element(sizes, middle);
    return *middle;
}

class ClusterGrowth {
  public:
    ClusterGrowth(const PartMesh& part, float grain)
        : part_(part),
          finest_(1 / std::max(grain, std::numeric_limits<float>::min())),
          corners_(part.positions.size(), 3 * part.triangles.size(),
                   [&](size_t item) { return part.triangles[item / 3][item % 3]; }),
          taken_(part.triangles.size()),
          frontierMark_(part.triangles.size()),
          vertexMark_(part.positions.size()),
          usualSize_(std::max(usualSize(part), std::numeric_limits<float>::min())) {
        for (const auto& [a, b, c] : part.triangles) {
            const Vec3 sum = plus(plus(part.positions[a], part.positions[b]), part.positions[c]);
            middles_.push_back(times(sum, 1.0F / 3));
        }
    }

    std::vector<ClusterMembers> grow() {
        std::vector<ClusterMembers> clusters;
        for (uint32_t seed = nextSeed(); seed != noTriangle; seed = nextSeed()) {
            growFrom(seed);
            clusters.push_back(std::move(members_));
        }
        return clusters;
    }

  private:
    void growFrom(uint32_t seed) {
        ++epoch_;
        members_.clear();
        frontier_.clear();
        vertices_ = 0;
        box_ = {};
        sum_ = {};
        for (uint32_t next = seed; next != noTriangle; next = bestNext()) {
            add(next);
            if (members_.size() == maxClusterTriangles) return;
        }
    }

    uint32_t bestNext() {
        const uint32_t touching = leastBits();
        return touching != noTriangle ? touching : nearbyTriangle(members_.back());
    }

    void add(uint32_t triangle) {
        taken_[triangle] = true;
        members_.push_back(triangle);
        sum_ = plus(sum_, middles_[triangle]);
        for (const uint32_t v : part_.triangles[triangle]) {
            if (vertexMark_[v] == epoch_) continue;
            vertexMark_[v] = epoch_;
            ++vertices_;
            box_.extend(part_.positions[v]);
            extendFrontier(v);
        }
    }

    void extendFrontier(uint32_t vertex) {
        const auto here = corners_.bucket(vertex);
        for (const uint32_t item : here.first(std::min<size_t>(here.size(), mostLookedAt))) {
            const uint32_t t = item / 3;
            if (taken_[t] || frontierMark_[t] == epoch_) continue;
            frontierMark_[t] = epoch_;
            frontier_.push_back(t);
        }
    }

    // About the bits of all offsets if `triangle` came in.
    [[nodiscard]] float bitsWith(uint32_t triangle) const {
        Box box = box_;
        uint32_t vertices = vertices_;
        for (const uint32_t v : part_.triangles[triangle]) {
            if (vertexMark_[v] == epoch_) continue;
            box.extend(part_.positions[v]);
            ++vertices;
        }
        return static_cast<float>(vertices) * widthOf(box);
    }
    [[nodiscard]] float widthOf(const Box& box) const {
        const Vec3 across = times(minus(box.high, box.low), finest_);
        return 3 * roughLog2(across[0] + across[1] + across[2] + 1);
    }

    uint32_t leastBits() {
        constexpr float roundness = 100;  // bits: short borders share more vertices
        std::erase_if(frontier_, [&](uint32_t t) { return taken_[t]; });
        uint32_t best = noTriangle;
        float least = std::numeric_limits<float>::infinity();
        for (const uint32_t t : frontier_) {
            const float bits = bitsWith(t) + roundness * distance(t);
            if (bits < least || (bits == least && t < best)) {
                least = bits;
                best = t;
            }
        }
        return best;
    }

    // Of the triangle's middle from that of the cluster, as a share of the usual size.
    [[nodiscard]] float distance(uint32_t triangle) const {
        const Vec3 off = minus(middles_[triangle], times(sum_, 1 / static_cast<float>(members_.size())));
        return std::sqrt(dot(off, off)) / usualSize_;
    }

    // Of the triangles next in order to `from` the one that costs least, if it costs little enough.
    uint32_t nearbyTriangle(uint32_t from) {
        constexpr float recordBits = 300;  // of a leaf; nearly full ones gain little
        const float room = static_cast<float>(maxClusterTriangles - members_.size()) / maxClusterTriangles;
        uint32_t best = noTriangle;
        float least =
            static_cast<float>(vertices_ + 3) * widthOf(box_) + recordBits * room * room * room * room;
        size_t tried = 0;
        const auto lookAt = [&](uint32_t t) {
            if (taken_[t]) return;
            ++tried;
            if (isTooFar(t) || bitsWith(t) >= least) return;
            least = bitsWith(t);
            best = t;
        };
        const auto count = static_cast<uint32_t>(taken_.size());
        const uint32_t last = std::min<uint32_t>(count - 1, from + mostLookedAt);
        const uint32_t first = from > mostLookedAt ? from - mostLookedAt : 0;
        for (uint32_t t = from + 1; t <= last && tried < mostTried; ++t) lookAt(t);
        tried = 0;
        for (uint32_t t = from; t-- > first && tried < mostTried;) lookAt(t);
        return best;
    }

    // Rays pay for large boxes.
    [[nodiscard]] bool isTooFar(uint32_t triangle) const {
        Box box = box_;
        for (const uint32_t v : part_.triangles[triangle]) box.extend(part_.positions[v]);
        return box.diagonal() > 1.5F * std::max(usualSize_, box_.diagonal());
    }

    // At the border of the cluster before, where the fewest free triangles are left around it; otherwise the
    // first that is free.
    uint32_t nextSeed() {
        uint32_t best = noTriangle;
        size_t least = std::numeric_limits<size_t>::max();
        for (const uint32_t t : frontier_) {
            if (taken_[t]) continue;
            const size_t around = freeAround(t);
            if (around < least || (around == least && t < best)) {
                least = around;
                best = t;
            }
        }
        if (best != noTriangle) return best;
        while (cursor_ < taken_.size() && taken_[cursor_]) ++cursor_;
        return cursor_ < taken_.size() ? cursor_ : noTriangle;
    }

    [[nodiscard]] size_t freeAround(uint32_t triangle) {
        size_t count = 0;
        for (const uint32_t v : part_.triangles[triangle]) {
            const auto here = corners_.bucket(v);
            for (const uint32_t item : here.first(std::min<size_t>(here.size(), mostLookedAt)))
                count += taken_[item / 3] ? 0 : 1;
        }
        return count;
    }

    const PartMesh& part_;
    float finest_;
    Buckets corners_;  // of each vertex
    std::vector<Vec3> middles_;
    std::vector<bool> taken_;
    std::vector<uint32_t> frontierMark_;  // the last cluster that had it there
    std::vector<uint32_t> vertexMark_;    // the last cluster that holds it
    uint32_t epoch_ = 0;
    uint32_t cursor_ = 0;
    float usualSize_;
    ClusterMembers members_;
    std::vector<uint32_t> frontier_;
    uint32_t vertices_ = 0;
    Box box_;
    Vec3 sum_{};  // of the members' middles
};

}  // namespace

std::vector<ClusterMembers> growClusters(const ClusterInput& input) {
    const PartMesh part(input);
    std::vector<ClusterMembers> clusters = ClusterGrowth(part, input.grain).grow();
    for (ClusterMembers& members : clusters) {
        for (uint32_t& t : members) t = input.part[t];
    }
    return clusters;
}

}  // namespace filigree::grid
