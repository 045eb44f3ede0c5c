// Levels under a byte budget: where a micromap's bytes save the most any-hit calls.
#pragma once

#include "filigree/core/api.h"
#include "filigree/micromap/set.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::bake {

// One micromap at its finest level, and how much its quality matters.
struct BudgetMap {
    micromap::QuadtreeView tree;
    double weight = 0;  // world area of the triangles that use it, instances counted, >= 0
};

// The level chosen for each micromap, at most its own. Level 0 of a 4-state map that is not uniform means
// none: all unknown, a special index, no bytes; so does level 0 of a 2-state map, where the greater side
// stands for all.
struct BudgetChoice {
    std::vector<uint8_t> levels;  // [map_count]
    uint64_t bytes = 0;           // of data and 8-byte records, at most the budget
    // Expected any-hit calls of rays that hit uniformly by area: the sum of weight times unknown share.
    // 2-state: weight times misclassified share, against the finest level.
    double cost = 0;
    // No choice within the budget costs less than this: the cost of the relaxed problem, in which a micromap
    // may be at two levels in part.
    double bound = 0;
};

// Picks levels so that data and records take at most `budgetBytes`, at about the least cost: the
// multiple-choice knapsack, taken greedily along each micromap's convex hull of bytes and cost (Sinha and
// Zoltners 1979). Not the optimum, but never further from it than one micromap's step, and `bound` says how
// far.
FILIGREE_API BudgetChoice chooseLevels(std::span<const BudgetMap> maps, micromap::Format format,
                                       uint64_t budgetBytes);

// What a micromap costs at each level 0..tree.level, as a share of its area: unknown (4-state) or on the
// wrong side (2-state).
FILIGREE_API std::vector<double> costByLevel(const micromap::QuadtreeView& tree, micromap::Format format);

// `set` with each tree at its chosen level (micromap::coarsened), shared again.
FILIGREE_API micromap::TreeSet coarsenedTo(const micromap::TreeSet& set, std::span<const uint8_t> levels);

}  // namespace filigree::bake
