#include "filigree/mesh/pairing.h"

#include "mesh/matching.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <map>

namespace filigree::mesh {
namespace {

using Position = std::array<float, 3>;

// One side of a triangle: that opposite its vertex `apex`. Sides of one edge have equal `low` and `high`.
struct Side {
    Position low{};
    Position high{};
    uint32_t triangle = 0;
    uint8_t apex = 0;
    bool rising = false;  // runs from `low` to `high`
};

// Two triangles that meet in an edge, and how well they go together.
struct Meeting {
    Side first;
    Side second;
    int fit = 0;  // 0..255
    bool continuous = false;
};

constexpr size_t mostNeighbours = 8;

class Box {
  public:
    void add(const Position& p) {
        for (size_t k = 0; k < 3; ++k) {
            low_[k] = std::min<double>(low_[k], p[k]);
            high_[k] = std::max<double>(high_[k], p[k]);
        }
    }
    [[nodiscard]] double halfArea() const {
        const double x = high_[0] - low_[0];
        const double y = high_[1] - low_[1];
        const double z = high_[2] - low_[2];
        return x * y + y * z + z * x;
    }

  private:
    std::array<double, 3> low_{1e300, 1e300, 1e300};
    std::array<double, 3> high_{-1e300, -1e300, -1e300};
};

class Pairer {
  public:
    explicit Pairer(const PairingInput& input) : input_(input) {}

    std::vector<TrianglePair> run() {
        gatherSides();
        meet();
        std::vector<std::optional<TrianglePair>> of(triangles());
        std::vector<bool> isSecond(triangles());
        for (const size_t k : maximumWeightMatching(triangles(), weighted())) {
            const Meeting& m = meetings_[k];
            of[m.first.triangle] = TrianglePair{ordered(m.first, m.first), ordered(m.second, m.first)};
            isSecond[m.second.triangle] = true;
        }
        std::vector<TrianglePair> pairs;
        for (uint32_t t = 0; t < triangles(); ++t) {
            if (!isSecond[t]) pairs.push_back(of[t].value_or(TrianglePair{{t, {0, 1, 2}}, {}}));
        }
        return pairs;
    }

  private:
    [[nodiscard]] size_t triangles() const { return input_.indices.size() / 3; }
    [[nodiscard]] uint32_t vertex(uint32_t triangle, unsigned corner) const {
        return input_.indices[3 * size_t{triangle} + corner % 3];
    }
    [[nodiscard]] const Position& position(uint32_t triangle, unsigned corner) const {
        return input_.positions[vertex(triangle, corner)];
    }

    void gatherSides() {
        for (uint32_t t = 0; t < triangles(); ++t) {
            for (uint8_t apex = 0; apex < 3; ++apex) addSide(t, apex);
        }
        std::ranges::sort(sides_, [](const Side& a, const Side& b) {
            return std::tie(a.low, a.high, a.triangle, a.apex) < std::tie(b.low, b.high, b.triangle, b.apex);
        });
    }

    void addSide(uint32_t triangle, uint8_t apex) {
        Position from = position(triangle, apex + 1u);
        Position to = position(triangle, apex + 2u);
        const auto isFinite = [](float v) { return std::isfinite(v); };
        if (!std::ranges::all_of(from, isFinite) || !std::ranges::all_of(to, isFinite) || from == to) return;
        const bool rising = from < to;
        if (!rising) std::swap(from, to);
        sides_.push_back({from, to, triangle, apex, rising});
    }

    // Lists the pairs of sides that lie on one edge, by triangle.
    void meet() {
        for (size_t k = 0; k < sides_.size(); ++k) {
            for (size_t n = k + 1; n < sides_.size() && n <= k + mostNeighbours; ++n) {
                if (sides_[n].low != sides_[k].low || sides_[n].high != sides_[k].high) break;
                if (sides_[n].triangle != sides_[k].triangle)
                    meetings_.push_back(meeting(sides_[k], sides_[n]));
            }
        }
        keepBest();
    }

    // Two triangles may meet in more than one edge.
    void keepBest() {
        const auto triangles = [](const Meeting& m) {
            return std::pair(m.first.triangle, m.second.triangle);
        };
        std::ranges::sort(meetings_, [&](const Meeting& a, const Meeting& b) {
            if (triangles(a) != triangles(b)) return triangles(a) < triangles(b);
            if (a.continuous != b.continuous) return a.continuous;
            return std::pair(a.first.apex, a.second.apex) < std::pair(b.first.apex, b.second.apex);
        });
        const auto same = [&](const Meeting& a, const Meeting& b) { return triangles(a) == triangles(b); };
        meetings_.erase(std::unique(meetings_.begin(), meetings_.end(), same), meetings_.end());
    }

    [[nodiscard]] Meeting meeting(const Side& a, const Side& b) const {
        return {a, b, fit(a.triangle, b.triangle), isContinuous(a, b)};
    }

    [[nodiscard]] bool isContinuous(const Side& a, const Side& b) const {
        if (input_.uvs.empty()) return true;
        const auto uv = [&](const Side& side, bool high) {
            return input_.uvs[vertex(side.triangle, side.apex + (high == side.rising ? 2u : 1u))];
        };
        return uv(a, false) == uv(b, false) && uv(a, true) == uv(b, true);
    }

    // The boxes of the two triangles against the box around both.
    [[nodiscard]] int fit(uint32_t a, uint32_t b) const {
        Box boxes[3];
        for (unsigned k = 0; k < 3; ++k) {
            boxes[0].add(position(a, k));
            boxes[1].add(position(b, k));
            boxes[2].add(position(a, k));
            boxes[2].add(position(b, k));
        }
        const double share = (boxes[0].halfArea() + boxes[1].halfArea()) / (2 * boxes[2].halfArea());
        return std::isfinite(share) ? static_cast<int>(255 * std::min(share, 1.0)) : 255;
    }

    // One more pair outweighs all continuity, one more continuous pair all boxes.
    [[nodiscard]] std::vector<WeightedEdge> weighted() const {
        const auto mostPairs = static_cast<int64_t>(triangles() / 2);
        const int64_t continuous = 255 * mostPairs + 1;
        const int64_t pair = (continuous + 255) * mostPairs + 1;
        std::vector<WeightedEdge> edges;
        edges.reserve(meetings_.size());
        for (const Meeting& m : meetings_) {
            edges.push_back(
                {m.first.triangle, m.second.triangle, pair + (m.continuous ? continuous : 0) + m.fit});
        }
        return edges;
    }

    // `side`'s triangle in the order in which its edge runs as `leader`'s does, backwards for the second.
    static PairedTriangle ordered(const Side& side, const Side& leader) {
        const auto next = static_cast<uint8_t>((side.apex + 1) % 3);
        const auto last = static_cast<uint8_t>((side.apex + 2) % 3);
        const bool isLeader = side.triangle == leader.triangle;
        const bool turned = !isLeader && side.rising == leader.rising;
        return {side.triangle, {side.apex, turned ? last : next, turned ? next : last}};
    }

    PairingInput input_;
    std::vector<Side> sides_;
    std::vector<Meeting> meetings_;
};

}  // namespace

std::vector<TrianglePair> pairTriangles(const PairingInput& input) {
    assert(input.indices.size() % 3 == 0);
    assert(input.uvs.empty() || input.uvs.size() == input.positions.size());
    return Pairer(input).run();
}

}  // namespace filigree::mesh
