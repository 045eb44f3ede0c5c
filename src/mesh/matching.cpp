#include "mesh/matching.h"

// The library's lock would stay locked where an allocation throws. The graph never leaves its thread: no
// lock.
#define LEMON_BITS_LOCK_H
namespace lemon::bits {
struct Lock {
    void lock() {}
    void unlock() {}
};
}  // namespace lemon::bits

#define LEMON_ONLY_TEMPLATES
#include <lemon/matching.h>
#include <lemon/smart_graph.h>

namespace filigree::mesh {

std::vector<size_t> maximumWeightMatching(size_t nodes, const std::vector<WeightedEdge>& edges) {
    if (edges.empty()) return {};
    using Graph = lemon::SmartGraph;
    Graph graph;
    graph.reserveNode(static_cast<int>(nodes));
    graph.reserveEdge(static_cast<int>(edges.size()));
    for (size_t k = 0; k < nodes; ++k) graph.addNode();
    std::vector<Graph::Edge> handles;
    handles.reserve(edges.size());
    for (const WeightedEdge& edge : edges) {
        handles.push_back(graph.addEdge(Graph::nodeFromId(static_cast<int>(edge.a)),
                                        Graph::nodeFromId(static_cast<int>(edge.b))));
    }
    Graph::EdgeMap<int64_t> weights(graph);
    for (size_t k = 0; k < edges.size(); ++k) weights[handles[k]] = edges[k].weight;
    lemon::MaxWeightedMatching<Graph, Graph::EdgeMap<int64_t>> matching(graph, weights);
    matching.run();
    std::vector<size_t> chosen;
    for (size_t k = 0; k < edges.size(); ++k) {
        if (matching.matching(handles[k])) chosen.push_back(k);
    }
    return chosen;
}

}  // namespace filigree::mesh
