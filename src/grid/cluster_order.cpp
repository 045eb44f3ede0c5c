#include "filigree/grid/cluster.h"

#include "grid/cluster_growth.h"

#include <algorithm>
#include <utility>

namespace filigree::grid {
namespace {

constexpr uint16_t noHalfEdge = 0xffff;

// Half-edge 3 m + k of member m runs from its vertex k to the next.
struct ClusterEdge {
    std::pair<uint32_t, uint32_t> ends;  // the lower vertex first
    bool backwards = false;
    uint16_t halfEdge = 0;
    auto operator<=>(const ClusterEdge&) const = default;
};

std::vector<ClusterEdge> sortedEdges(std::span<const std::array<uint32_t, 3>> triangles,
                                     const ClusterMembers& members) {
    std::vector<ClusterEdge> edges;
    for (size_t m = 0; m < members.size(); ++m) {
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t from = triangles[members[m]][k];
            const uint32_t to = triangles[members[m]][(k + 1) % 3];
            edges.push_back({std::minmax({from, to}), from > to, static_cast<uint16_t>(3 * m + k)});
        }
    }
    std::ranges::sort(edges);
    return edges;
}

// Joins each half-edge with one of the opposite direction, as far as there are any.
std::vector<uint16_t> clusterTwins(std::span<const std::array<uint32_t, 3>> triangles,
                                   const ClusterMembers& members) {
    const std::vector<ClusterEdge> edges = sortedEdges(triangles, members);
    std::vector<uint16_t> twins(3 * members.size(), noHalfEdge);
    for (size_t first = 0; first < edges.size();) {
        size_t turn = first;  // the first that runs backwards
        while (turn < edges.size() && edges[turn].ends == edges[first].ends && !edges[turn].backwards) ++turn;
        size_t last = turn;
        while (last < edges.size() && edges[last].ends == edges[first].ends) ++last;
        for (size_t k = 0; first + k < turn && turn + k < last; ++k) {
            twins[edges[first + k].halfEdge] = edges[turn + k].halfEdge;
            twins[edges[turn + k].halfEdge] = edges[first + k].halfEdge;
        }
        first = last;
    }
    return twins;
}

constexpr uint16_t turnedEdge(uint16_t halfEdge, unsigned by) {
    return static_cast<uint16_t>(halfEdge / 3 * 3 + (halfEdge + by) % 3);
}

// Visits the members depth first over twins, right before left, each by the half-edge it is come in by.
class ClusterWalk {
  public:
    explicit ClusterWalk(std::span<const uint16_t> twins) : twins_(twins), visited_(twins.size() / 3) {}

    std::vector<uint16_t> walk() {
        for (uint16_t e = 0; e < twins_.size(); ++e) {
            if (twins_[e] == noHalfEdge) walkFrom(e);
        }
        for (uint16_t e = 0; e < twins_.size(); e = static_cast<uint16_t>(e + 3)) walkFrom(e);
        return std::move(order_);
    }

  private:
    void walkFrom(uint16_t root) {
        open_ = {root};
        while (!open_.empty()) {
            const uint16_t entry = open_.back();
            open_.pop_back();
            if (entry == noHalfEdge || visited_[entry / 3]) continue;
            visited_[entry / 3] = true;
            order_.push_back(entry);
            open_.push_back(twins_[turnedEdge(entry, 2)]);
            open_.push_back(twins_[turnedEdge(entry, 1)]);
        }
    }

    std::span<const uint16_t> twins_;
    std::vector<bool> visited_;
    std::vector<uint16_t> open_;
    std::vector<uint16_t> order_;
};

}  // namespace

void orderCluster(std::span<const std::array<uint32_t, 3>> triangles, ClusterMembers& members,
                  std::vector<uint8_t>& turns) {
    const std::vector<uint16_t> order = ClusterWalk(clusterTwins(triangles, members)).walk();
    const ClusterMembers before = members;
    turns.clear();
    for (size_t m = 0; m < order.size(); ++m) {
        members[m] = before[order[m] / 3];
        turns.push_back(static_cast<uint8_t>(order[m] % 3));
    }
}

}  // namespace filigree::grid
