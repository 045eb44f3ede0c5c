#include "bvh/collapse.h"

namespace filigree::bvh {

Collapse::Collapse(std::span<const Branch> tree, double nodePrice) : tree_(tree), choices_(tree.size()) {
    // Leaves cost the same wherever they hang.
    for (size_t k = tree.size(); k-- > 0;) {
        if (tree[k].left != Branch::isLeaf) choose(tree[k], nodePrice, choices_[k]);
    }
}

// `places` children, at least 2, between the two sides.
Collapse::Share Collapse::bestShare(const Branch& branch, size_t places) const {
    const Choices& left = choices_[branch.left];
    const Choices& right = choices_[branch.right];
    Share best{left.cost[0] + right.cost[places - 2], 1};
    for (size_t k = 2; k < places; ++k) {
        const double cost = left.cost[k - 1] + right.cost[places - k - 1];
        if (cost < best.cost) best = {cost, static_cast<uint8_t>(k)};
    }
    return best;
}

void Collapse::choose(const Branch& branch, double nodePrice, Choices& choices) const {
    const Share inside = bestShare(branch, width);
    choices.inside = inside.left;
    choices.cost[0] = branch.bounds.area() + nodePrice + inside.cost;
    for (size_t places = 2; places <= width; ++places) {
        const Share share = bestShare(branch, places);
        const bool opens = share.cost < choices.cost[places - 2];
        choices.cost[places - 1] = opens ? share.cost : choices.cost[places - 2];
        choices.leftShare[places - 1] = opens ? share.left : uint8_t{0};
    }
}

Children Collapse::childrenOf(uint32_t branch) const {
    Children children;
    const Branch& at = tree_[branch];
    if (at.left == Branch::isLeaf) {
        children.branches[children.count++] = branch;
        return children;
    }
    const size_t left = choices_[branch].inside;
    gather(at.left, left, children);
    gather(at.right, width - left, children);
    return children;
}

void Collapse::gather(uint32_t branch, size_t places, Children& into) const {
    const Branch& at = tree_[branch];
    const Choices& choices = choices_[branch];
    while (places > 1 && choices.leftShare[places - 1] == 0) --places;
    if (places == 1 || at.left == Branch::isLeaf) {
        into.branches[into.count++] = branch;
        return;
    }
    const size_t left = choices.leftShare[places - 1];
    gather(at.left, left, into);
    gather(at.right, places - left, into);
}

}  // namespace filigree::bvh
