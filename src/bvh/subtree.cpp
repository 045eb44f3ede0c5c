#include "bvh/subtree.h"

#include "filigree/bvh/build.h"

#include "bvh/binary_tree.h"
#include "bvh/emit.h"

#include <bit>

namespace filigree::bvh {
namespace {

static_assert(maxBranchDepth < maxDepth);

// What a node's memory is worth in visits, as a share of the mean area of its leaves: found by trying.
constexpr double memoryShare = 1;

class Emitter {
  public:
    Emitter(std::span<const Branch> tree, Subtree& out)
        : tree_(tree), collapse_(tree, nodePriceOf(tree)), out_(out) {
        out_.nodes.emplace_back();
        emit(0, 0);
    }

  private:
    void emit(uint32_t branch, size_t at) {
        const NodeParts parts = partsOf(tree_, collapse_.childrenOf(branch),
                                        [](const Branch& child) { return child.left == Branch::isLeaf; });
        Node node = parts.node;
        node.firstChild = static_cast<uint32_t>(out_.nodes.size());
        node.firstLeaf = static_cast<uint32_t>(out_.order.size());
        out_.order.insert(out_.order.end(), parts.leaves().begin(), parts.leaves().end());
        out_.nodes.resize(out_.nodes.size() + parts.inner().size());
        out_.nodes[at] = node;
        for (size_t k = 0; k < parts.inner().size(); ++k) emit(parts.inner()[k], node.firstChild + k);
    }

    std::span<const Branch> tree_;
    Collapse collapse_;
    Subtree& out_;
};

}  // namespace

bool mustHalve(unsigned depth, size_t count) {
    return depth + static_cast<unsigned>(std::bit_width(count - 1)) >= maxBranchDepth;
}

double nodePriceOf(std::span<const Branch> tree) {
    double sum = 0;
    size_t leaves = 0;
    for (const Branch& branch : tree) {
        if (branch.left != Branch::isLeaf) continue;
        sum += branch.bounds.area();
        ++leaves;
    }
    return memoryShare * width * sum / static_cast<double>(leaves);
}

Subtree buildSubtree(std::span<const Box> boxes, std::span<const uint32_t> indices, unsigned depth) {
    std::vector<Item> items;
    items.reserve(indices.size());
    for (const uint32_t index : indices) items.push_back({boxes[index], index});
    const std::vector<Branch> tree = buildBinaryTree(items, depth);
    Subtree out;
    Emitter(tree, out);
    return out;
}

}  // namespace filigree::bvh
