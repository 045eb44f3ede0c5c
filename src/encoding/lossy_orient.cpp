#include "encoding/lossy_orient.h"

#include <algorithm>

namespace filigree::encoding {
namespace {

using micromap::Quadtree;
using micromap::VertexOrder;

constexpr std::array<VertexOrder, 6> orders{
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};

VertexOrder inverse(const VertexOrder& order) {
    VertexOrder back{};
    for (uint8_t k = 0; k < 3; ++k) back[order[k]] = k;
    return back;
}

bool isLess(const Quadtree& a, const Quadtree& b) {
    return std::ranges::lexicographical_compare(a.view().words, b.view().words);
}

class OrientedPruner : public Pruner {
  public:
    OrientedPruner(std::span<const WeightedMap> maps, const MakePruner& make) {
        for (const WeightedMap& map : maps) orient(map.tree);
        for (size_t m = 0; m < maps.size(); ++m) maps_.push_back({trees_[m].view(), maps[m].weight});
        pruner_ = make(maps_);
    }

    [[nodiscard]] PrunedMaps prune(double price, const Executor& executor) const override {
        PrunedMaps pruned = pruner_->prune(price, executor);
        executor.parallelFor(pruned.maps.size(), 16, [&](size_t begin, size_t end) {
            for (size_t m = begin; m < end; ++m)
                pruned.maps[m] = micromap::permuted(pruned.maps[m].view(), back_[m]);
        });
        return pruned;
    }

  private:
    void orient(const micromap::QuadtreeView& map) {
        Quadtree least = micromap::permuted(map, orders[0]);
        VertexOrder back = orders[0];
        for (size_t k = 1; k < orders.size(); ++k) {
            Quadtree turned = micromap::permuted(map, orders[k]);
            if (!isLess(turned, least)) continue;
            least = std::move(turned);
            back = inverse(orders[k]);
        }
        trees_.push_back(std::move(least));
        back_.push_back(back);
    }

    std::vector<Quadtree> trees_;
    std::vector<VertexOrder> back_;  // from the orientation of trees_ to the map's own
    std::vector<WeightedMap> maps_;
    std::unique_ptr<Pruner> pruner_;
};

}  // namespace

std::unique_ptr<Pruner> makeOrientedPruner(std::span<const WeightedMap> maps, const MakePruner& make) {
    return std::make_unique<OrientedPruner>(maps, make);
}

}  // namespace filigree::encoding
