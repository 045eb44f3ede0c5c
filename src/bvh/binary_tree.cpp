#include "bvh/binary_tree.h"

#include "bvh/bins.h"
#include "bvh/subtree.h"

#include <algorithm>
#include <cassert>
#include <tuple>

namespace filigree::bvh {
namespace {

// Up to here every place between two boxes is tried, not only those between bins.
constexpr size_t sweepLimit = 48;

void sortAlong(std::span<Item> items, size_t axis) {
    const auto before = [axis](const Item& a, const Item& b) {
        return std::tuple(centreOf(a.box)[axis], a.index) < std::tuple(centreOf(b.box)[axis], b.index);
    };
    std::sort(items.begin(), items.end(), before);
}

struct Sweep {
    size_t axis = 0;
    size_t left = 0;
    double cost = 0;
};

void sweepSorted(std::span<const Item> items, size_t axis, Sweep& best) {
    std::array<double, sweepLimit> right;  // cost of the items from k on
    Bounds bounds;
    for (size_t k = items.size(); k-- > 1;) {
        bounds.extend(items[k].box);
        right[k] = bounds.area() * priceOf(items.size() - k);
    }
    bounds = {};
    for (size_t k = 1; k < items.size(); ++k) {
        bounds.extend(items[k - 1].box);
        const double cost = bounds.area() * priceOf(k) + right[k];
        if (best.left == 0 || cost < best.cost) best = {axis, k, cost};
    }
}

// How many go left; the items are sorted so.
size_t splitBySweep(std::span<Item> items) {
    Sweep best;
    for (size_t axis = 0; axis < 3; ++axis) {
        sortAlong(items, axis);
        sweepSorted(items, axis, best);
    }
    if (best.axis != 2) sortAlong(items, best.axis);
    return best.left;
}

size_t splitInHalves(std::span<Item> items) {
    Bounds centres;
    for (const Item& item : items) centres.extend(centreOf(item.box));
    size_t widest = 0;
    for (size_t k = 1; k < 3; ++k) {
        if (centres.high[k] - centres.low[k] > centres.high[widest] - centres.low[widest]) widest = k;
    }
    sortAlong(items, widest);
    return items.size() / 2;
}

size_t splitByBins(std::span<Item> items) {
    Bounds centres;
    for (const Item& item : items) centres.extend(centreOf(item.box));
    const BinLattice lattice(centres);
    Bins bins;
    for (const Item& item : items) bins.add(lattice, item.box);
    const auto cut = bins.best(lattice);
    if (!cut) return splitInHalves(items);
    const auto isLeft = [&](const Item& item) { return lattice.isLeft(centreOf(item.box), *cut); };
    const auto middle = std::stable_partition(items.begin(), items.end(), isLeft);
    return static_cast<size_t>(middle - items.begin());
}

size_t split(std::span<Item> items, unsigned depth) {
    if (mustHalve(depth, items.size())) return splitInHalves(items);
    return items.size() <= sweepLimit ? splitBySweep(items) : splitByBins(items);
}

class BinaryTreeBuilder {
  public:
    uint32_t add(std::span<Item> items, unsigned depth) {
        const auto at = static_cast<uint32_t>(tree_.size());
        tree_.emplace_back();
        for (const Item& item : items) tree_[at].bounds.extend(item.box);
        if (items.size() == 1) {
            tree_[at].right = items[0].index;
            return at;
        }
        const size_t left = split(items, depth);
        assert(left > 0 && left < items.size());
        const uint32_t leftBranch = add(items.first(left), depth + 1);
        const uint32_t rightBranch = add(items.subspan(left), depth + 1);
        tree_[at].left = leftBranch;
        tree_[at].right = rightBranch;
        return at;
    }
    std::vector<Branch> take() { return std::move(tree_); }

  private:
    std::vector<Branch> tree_;
};

}  // namespace

std::vector<Branch> buildBinaryTree(std::span<Item> items, unsigned depth) {
    BinaryTreeBuilder builder;
    builder.add(items, depth);
    return builder.take();
}

}  // namespace filigree::bvh
