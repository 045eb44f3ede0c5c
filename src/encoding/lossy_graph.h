// Pruning where equal subtrees are stored once.
#pragma once

#include "encoding/lossy_prune.h"

namespace filigree::encoding {

// A graph of all distinct subtrees of a set of maps.
class SubtreeGraph {
  public:
    // Nodes below stateCount are the leaves of each state, at any height.
    static constexpr uint32_t stateCount = 4;

    struct Node {
        std::array<uint32_t, 4> children{};  // each below the node's own number
        uint32_t height = 0;
        double uses = 0;  // how often it stands in the maps
        double area = 0;  // sum of weight times share of the map, over all uses
    };

    explicit SubtreeGraph(std::span<const WeightedMap> maps);

    [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }
    [[nodiscard]] std::span<const uint32_t> roots() const { return roots_; }  // [map_count]

  private:
    class Builder;

    std::vector<Node> nodes_;
    std::vector<uint32_t> roots_;
};

// As the tree pruner, but equal subtrees share the bits of their nodes and are pruned alike, so that they
// stay equal.
std::unique_ptr<Pruner> makeGraphPruner(std::span<const WeightedMap> maps, SubtreeGraph graph,
                                        micromap::Format format, const RateModel& model);

}  // namespace filigree::encoding
