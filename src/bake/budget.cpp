#include "filigree/bake/budget.h"

#include "bake/share.h"

#include <algorithm>
#include <cassert>
#include <queue>

namespace filigree::bake {
namespace {

// A level a micromap may take, and what it means.
struct Option {
    uint8_t level = 0;
    uint64_t bytes = 0;
    double cost = 0;
};

// From one option of a micromap to a better one: what it saves for each byte.
struct Step {
    size_t map = 0;
    size_t option = 0;  // the one it leads to
    double worth = 0;

    // The most worthwhile first; the order of the micromaps decides among equals.
    bool operator<(const Step& other) const {
        return worth != other.worth ? worth < other.worth : map > other.map;
    }
};

double worthOf(const Option& from, const Option& to) {
    return (from.cost - to.cost) / static_cast<double>(to.bytes - from.bytes);
}

// The options on the lower convex hull of bytes and cost, by rising bytes: each step saves less a byte than
// the last.
std::vector<Option> hullOf(const BudgetMap& map, micromap::Format format) {
    const std::vector<double> shares = costByLevel(map.tree, format);
    std::vector<Option> hull{{0, 0, shares[0] * map.weight}};
    for (unsigned level = 1; level < shares.size(); ++level) {
        const Option next{static_cast<uint8_t>(level),
                          micromap::flatBytes(level, format) + micromap::recordBytes,
                          shares[level] * map.weight};
        if (next.cost >= hull.back().cost) continue;
        while (hull.size() > 1 && worthOf(hull[hull.size() - 2], hull.back()) <= worthOf(hull.back(), next)) {
            hull.pop_back();
        }
        hull.push_back(next);
    }
    return hull;
}

// The share of a micromap on the lesser side of each node of a level, by a walk over its leaves.
class Misclassified {
  public:
    explicit Misclassified(const micromap::QuadtreeView& tree)
        : reader_(tree.words, tree.bits), level_(tree.level), shares_(tree.level + 1, 0.0) {
        visit(0, 1);
    }
    std::vector<double> take() && { return std::move(shares_); }

  private:
    // Returns the opaque share of a node at `depth` that covers `area` of the whole.
    double visit(unsigned depth, double area) {
        if (depth == level_ || !reader_.takeBit()) {
            return micromap::isOpaqueSide(static_cast<micromap::State>(reader_.take(2))) ? 1 : 0;
        }
        double opaque = 0;
        for (unsigned k = 0; k < 4; ++k) opaque += visit(depth + 1, area / 4) / 4;
        shares_[depth] += std::min(opaque, 1 - opaque) * area;
        return opaque;
    }

    BitReader reader_;
    unsigned level_;
    std::vector<double> shares_;
};

}  // namespace

std::vector<double> costByLevel(const micromap::QuadtreeView& tree, micromap::Format format) {
    if (format == micromap::Format::twoState) return Misclassified(tree).take();
    std::vector<double> unknown(tree.level + 1, 1.0);
    micromap::forEachLeaf(tree, [&](uint64_t, unsigned depth, micromap::State state) {
        if (!micromap::isKnown(state)) return;
        const double area = 1.0 / static_cast<double>(micromap::microTriangleCount(depth));
        for (unsigned level = depth; level <= tree.level; ++level) unknown[level] -= area;
    });
    return unknown;
}

BudgetChoice chooseLevels(std::span<const BudgetMap> maps, micromap::Format format, uint64_t budgetBytes) {
    BudgetChoice choice;
    choice.levels.assign(maps.size(), 0);
    std::vector<std::vector<Option>> options(maps.size());
    std::priority_queue<Step> steps;
    const auto offer = [&](size_t map, size_t option) {
        if (option < options[map].size()) {
            steps.push({map, option, worthOf(options[map][option - 1], options[map][option])});
        }
    };
    for (size_t m = 0; m < maps.size(); ++m) {
        options[m] = hullOf(maps[m], format);
        choice.cost += options[m].front().cost;
        offer(m, 1);
    }
    bool bounded = false;
    while (!steps.empty()) {
        const Step step = steps.top();
        steps.pop();
        const Option& from = options[step.map][step.option - 1];
        const Option& to = options[step.map][step.option];
        const uint64_t more = to.bytes - from.bytes;
        if (choice.bytes + more > budgetBytes) {
            // The first step that does not fit would fit in part: that is the relaxed optimum.
            if (!bounded)
                choice.bound = choice.cost - step.worth * static_cast<double>(budgetBytes - choice.bytes);
            bounded = true;
            continue;
        }
        choice.bytes += more;
        choice.cost += to.cost - from.cost;
        choice.levels[step.map] = to.level;
        offer(step.map, step.option + 1);
    }
    if (!bounded) choice.bound = choice.cost;
    return choice;
}

micromap::TreeSet coarsenedTo(const micromap::TreeSet& set, std::span<const uint8_t> levels) {
    assert(levels.size() == set.trees.size());
    micromap::TreeSet result;
    result.format = set.format;
    Sharer sharer(false);
    std::vector<int32_t> index(set.trees.size());
    for (size_t k = 0; k < index.size(); ++k) {
        const micromap::Quadtree tree = micromap::coarsened(set.trees[k], levels[k], set.format);
        index[k] = sharer.add(tree.view(), micromap::hash(tree.view())).index;
    }
    result.trees = std::move(sharer).take();
    result.indices = set.indices;
    for (int32_t& i : result.indices) {
        if (i >= 0) i = index[static_cast<size_t>(i)];
    }
    return result;
}

}  // namespace filigree::bake
