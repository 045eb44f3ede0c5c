// Maximum weight matching in any graph. C++17, as the library behind it needs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace filigree::mesh {

struct WeightedEdge {
    uint32_t a = 0;
    uint32_t b = 0;
    int64_t weight = 0;  // > 0; times the number of nodes below 2^60
};

// The edges, by their place in `edges`, of a matching of `nodes` nodes of the greatest weight, rising.
std::vector<size_t> maximumWeightMatching(size_t nodes, const std::vector<WeightedEdge>& edges);

}  // namespace filigree::mesh
