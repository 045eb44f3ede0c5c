#include "encoding/lossy_tree.h"

#include "filigree/micromap/quadtree_writer.h"

#include "encoding/lossy_choice.h"

namespace filigree::encoding {
namespace {

using micromap::State;

// Prunes one map while it is read, from the finest nodes up.
class MapPruning {
  public:
    MapPruning(const WeightedMap& map, micromap::Format format, const RateModel& model, double price)
        : reader_(map.tree.words, map.tree.bits),
          level_(map.tree.level),
          format_(format),
          model_(model),
          price_(map.weight > 0
                     ? price * map.weight / static_cast<double>(micromap::microTriangleCount(map.tree.level))
                     : 0) {}

    Kept run() { return visit(level_); }
    micromap::Quadtree take() && { return {std::move(out_), level_}; }

  private:
    Kept visit(unsigned height) {
        if (height == 0 || !reader_.takeBit()) {
            const auto state = static_cast<State>(reader_.take(2));
            micromap::appendLeaf(out_, height, static_cast<int>(state));
            return keptLeaf(state, height, leafBits(height));
        }
        const size_t start = out_.size();
        out_.append(1, 1);
        Kept kept;
        kept.bits = model_.innerBits[height] + (height == level_ ? model_.mapBits[level_] : 0);
        std::array<int, 4> leaves{};
        for (int& leaf : leaves) {
            const Kept child = visit(height - 1);
            leaf = child.leaf;
            kept.add(child);
        }
        kept.leaf = micromap::endInner(out_, start, height, leaves);
        if (kept.leaf >= 0) {
            kept.bits = leafBits(height);
            return kept;
        }
        const Kept leaf = asLeaf(kept, height, leafBits(height), format_);
        if (!pays(leaf, kept, price_)) return kept;
        out_.truncate(start);
        micromap::appendLeaf(out_, height, leaf.leaf);
        return leaf;
    }

    [[nodiscard]] double leafBits(unsigned height) const { return height == level_ ? 0 : model_.leafBits; }

    BitReader reader_;
    BitWriter out_;
    unsigned level_;
    micromap::Format format_;
    const RateModel& model_;
    double price_;  // bits a micro-triangle
};

class TreePruner : public Pruner {
  public:
    TreePruner(std::span<const WeightedMap> maps, micromap::Format format, const RateModel& model)
        : maps_(maps), format_(format), model_(model) {}

    [[nodiscard]] PrunedMaps prune(double price, const Executor& executor) const override {
        PrunedMaps result;
        result.maps.resize(maps_.size());
        std::vector<uint64_t> lost(maps_.size());
        executor.parallelFor(maps_.size(), 16, [&](size_t begin, size_t end) {
            for (size_t m = begin; m < end; ++m) {
                MapPruning pruning(maps_[m], format_, model_, price);
                lost[m] = pruning.run().lost;
                result.maps[m] = std::move(pruning).take();
            }
        });
        for (size_t m = 0; m < maps_.size(); ++m) result.cost += costOf(maps_[m], lost[m]);
        return result;
    }

  private:
    std::span<const WeightedMap> maps_;
    micromap::Format format_;
    RateModel model_;
};

}  // namespace

std::unique_ptr<Pruner> makeTreePruner(std::span<const WeightedMap> maps, micromap::Format format,
                                       const RateModel& model) {
    return std::make_unique<TreePruner>(maps, format, model);
}

}  // namespace filigree::encoding
