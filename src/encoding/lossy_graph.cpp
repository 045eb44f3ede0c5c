#include "encoding/lossy_graph.h"

#include "filigree/micromap/quadtree_writer.h"

#include "encoding/hash_table.h"
#include "encoding/lossy_choice.h"

#include <xxhash.h>

namespace filigree::encoding {

using micromap::State;

class SubtreeGraph::Builder {
  public:
    explicit Builder(std::vector<Node>& nodes) : nodes_(nodes) { nodes_.resize(stateCount); }

    uint32_t add(const micromap::QuadtreeView& tree) {
        BitReader reader(tree.words, tree.bits);
        return add(reader, tree.level);
    }

  private:
    uint32_t add(BitReader& reader, uint32_t height) {
        if (height == 0 || !reader.takeBit()) return static_cast<uint32_t>(reader.take(2));
        Node node;
        node.height = height;
        for (uint32_t& child : node.children) child = add(reader, height - 1);
        const uint64_t hash = XXH3_64bits_withSeed(node.children.data(), sizeof node.children, height);
        const auto number = static_cast<uint32_t>(nodes_.size());
        const uint32_t found = known_.findOrAdd(hash, number, [&](uint32_t other) {
            return nodes_[other].height == height && nodes_[other].children == node.children;
        });
        if (found == number) nodes_.push_back(node);
        return found;
    }

    std::vector<Node>& nodes_;
    HashTable known_;
};

SubtreeGraph::SubtreeGraph(std::span<const WeightedMap> maps) {
    Builder builder(nodes_);
    for (const WeightedMap& map : maps) {
        const uint32_t root = builder.add(map.tree);
        roots_.push_back(root);
        nodes_[root].uses += 1;
        nodes_[root].area += map.weight;
    }
    for (size_t n = nodes_.size(); n-- > stateCount;) {
        for (const uint32_t child : nodes_[n].children) {
            nodes_[child].uses += nodes_[n].uses;
            nodes_[child].area += nodes_[n].area / 4;
        }
    }
}

namespace {

class GraphPruner : public Pruner {
  public:
    GraphPruner(std::span<const WeightedMap> maps, SubtreeGraph graph, micromap::Format format,
                const RateModel& model)
        : maps_(maps), graph_(std::move(graph)), format_(format), model_(model) {}

    [[nodiscard]] PrunedMaps prune(double price, const Executor& executor) const override {
        const std::vector<Kept> choices = chooseAll(price);
        PrunedMaps result;
        result.maps.resize(maps_.size());
        std::vector<uint64_t> lost(maps_.size());
        executor.parallelFor(maps_.size(), 16, [&](size_t begin, size_t end) {
            for (size_t m = begin; m < end; ++m) {
                BitWriter out;
                lost[m] = writeMap(m, choices, price, out);
                result.maps[m] = {std::move(out), maps_[m].tree.level};
            }
        });
        for (size_t m = 0; m < maps_.size(); ++m) result.cost += costOf(maps_[m], lost[m]);
        return result;
    }

  private:
    [[nodiscard]] std::vector<Kept> chooseAll(double price) const {
        const auto nodes = graph_.nodes();
        std::vector<Kept> choices(nodes.size());
        for (int state = 0; state < static_cast<int>(SubtreeGraph::stateCount); ++state)
            choices[static_cast<size_t>(state)].leaf = state;
        for (size_t n = SubtreeGraph::stateCount; n < nodes.size(); ++n)
            choices[n] = choose(nodes[n], choices, price);
        return choices;
    }

    [[nodiscard]] Kept childOf(const SubtreeGraph::Node& node, unsigned k,
                               const std::vector<Kept>& choices) const {
        const uint32_t child = node.children[k];
        if (child >= SubtreeGraph::stateCount) return choices[child];
        return keptLeaf(static_cast<State>(child), node.height - 1, model_.leafBits);
    }

    [[nodiscard]] Kept choose(const SubtreeGraph::Node& node, const std::vector<Kept>& choices,
                              double price) const {
        Kept kept;
        kept.bits = model_.innerBits[node.height] / node.uses;
        std::array<int, 4> leaves{};
        for (unsigned k = 0; k < 4; ++k) {
            const Kept child = childOf(node, k, choices);
            leaves[k] = child.leaf;
            kept.add(child);
        }
        if (leaves[0] >= 0 && leaves[1] == leaves[0] && leaves[2] == leaves[0] && leaves[3] == leaves[0]) {
            kept.leaf = leaves[0];
            kept.bits = model_.leafBits;
            return kept;
        }
        const Kept leaf = asLeaf(kept, node.height, model_.leafBits, format_);
        return pays(leaf, kept, priceOf(node.area / node.uses, node.height, price)) ? leaf : kept;
    }

    // Bits a micro-triangle of a part of `area`.
    static double priceOf(double area, unsigned height, double price) {
        return area > 0 ? price * area / static_cast<double>(micromap::microTriangleCount(height)) : 0;
    }

    // Gives how many micro-triangles are lost.
    uint64_t writeMap(size_t map, const std::vector<Kept>& choices, double price, BitWriter& out) const {
        const unsigned level = maps_[map].tree.level;
        const uint32_t root = graph_.roots()[map];
        Kept kept = choices[root];
        kept.bits += model_.mapBits[level];
        const Kept leaf = kept.leaf >= 0 ? kept : asLeaf(kept, level, 0, format_);
        if (kept.leaf >= 0 || pays(leaf, kept, priceOf(maps_[map].weight, level, price))) {
            micromap::appendLeaf(out, level, leaf.leaf);
            return leaf.lost;
        }
        write(root, level, choices, out);
        return kept.lost;
    }

    void write(uint32_t node, unsigned height, const std::vector<Kept>& choices, BitWriter& out) const {
        if (const int leaf = choices[node].leaf; leaf >= 0) {
            micromap::appendLeaf(out, height, leaf);
            return;
        }
        out.append(1, 1);
        for (const uint32_t child : graph_.nodes()[node].children) write(child, height - 1, choices, out);
    }

    std::span<const WeightedMap> maps_;
    SubtreeGraph graph_;
    micromap::Format format_;
    RateModel model_;
};

}  // namespace

std::unique_ptr<Pruner> makeGraphPruner(std::span<const WeightedMap> maps, SubtreeGraph graph,
                                        micromap::Format format, const RateModel& model) {
    return std::make_unique<GraphPruner>(maps, std::move(graph), format, model);
}

}  // namespace filigree::encoding
