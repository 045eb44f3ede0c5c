#include "filigree/bvh/build.h"

#include <bit>
#include <cmath>

#include <fmt/format.h>

namespace filigree::bvh {
namespace {

Error errorAt(size_t node, const std::string& what) {
    return {ErrorKind::format, fmt::format("node {}: {}", node, what)};
}

// Fields that stand for themselves.
Status checkFields(const Node& node, size_t at) {
    for (size_t bit = 0; bit < 3; ++bit) {
        if (node.slotAxis(bit) > 2) return errorAt(at, "slots along axis 3; expected 0, 1 or 2");
    }
    if (node.slotAxes > 63 || node.zeros != decltype(node.zeros){})
        return errorAt(at, "bits behind the axes of the slots; expected zeros");
    if ((node.leafMask & node.innerMask) != 0) {
        return errorAt(at, "a child is both a node and a leaf; expected one of them");
    }
    for (size_t axis = 0; axis < 3; ++axis) {
        if (!std::isfinite(node.origin[axis])) return errorAt(at, "the origin is not finite");
        if (node.exponent[axis] < minExponent) {
            return errorAt(
                at, fmt::format("exponent {}; expected at least {}", node.exponent[axis], minExponent));
        }
    }
    return {};
}

class HierarchyCheck {
  public:
    HierarchyCheck(std::span<const Node> nodes, uint64_t leafCount)
        : nodes_(nodes), depths_(nodes.size()), isLeafSeen_(leafCount) {}

    Status run() {
        depths_[0] = 1;
        for (size_t k = 0; k < nodes_.size(); ++k) {
            if (Status fields = checkFields(nodes_[k], k); !fields) return fields;
            if (depths_[k] == 0) return errorAt(k, "no node above it; expected one");
            if (Status children = followChildren(k); !children) return children;
            if (Status leaves = followLeaves(k); !leaves) return leaves;
        }
        if (leavesSeen_ == isLeafSeen_.size()) return {};
        return Error{ErrorKind::format, fmt::format("the nodes hold {} leaves; expected all {}", leavesSeen_,
                                                    isLeafSeen_.size())};
    }

  private:
    Status followChildren(size_t at) {
        const Node& node = nodes_[at];
        const auto count = static_cast<uint64_t>(std::popcount(node.innerMask));
        if (count == 0) return {};
        if (node.firstChild <= at || node.firstChild + count > nodes_.size()) {
            return errorAt(at,
                           fmt::format("children {} to {}; expected them between {} and {}", node.firstChild,
                                       node.firstChild + count - 1, at + 1, nodes_.size() - 1));
        }
        if (depths_[at] == maxDepth) {
            return errorAt(at, fmt::format("the way here is longer than {} nodes", maxDepth));
        }
        for (uint64_t child = node.firstChild; child < node.firstChild + count; ++child) {
            if (depths_[child] != 0) return errorAt(at, fmt::format("node {} has two parents", child));
            depths_[child] = static_cast<uint8_t>(depths_[at] + 1);
        }
        return {};
    }

    Status followLeaves(size_t at) {
        const Node& node = nodes_[at];
        const auto count = static_cast<uint64_t>(std::popcount(node.leafMask));
        if (count == 0) return {};
        if (node.firstLeaf + count > isLeafSeen_.size()) {
            return errorAt(at, fmt::format("leaves {} to {} of {}", node.firstLeaf,
                                           node.firstLeaf + count - 1, isLeafSeen_.size()));
        }
        for (uint64_t leaf = node.firstLeaf; leaf < node.firstLeaf + count; ++leaf) {
            if (isLeafSeen_[leaf]) return errorAt(at, fmt::format("leaf {} stands in two nodes", leaf));
            isLeafSeen_[leaf] = true;
        }
        leavesSeen_ += count;
        return {};
    }

    std::span<const Node> nodes_;
    std::vector<uint8_t> depths_;  // nodes on the way from the root, itself included; 0: not reached yet
    std::vector<bool> isLeafSeen_;
    uint64_t leavesSeen_ = 0;
};

}  // namespace

Status check(std::span<const Node> nodes, uint64_t leafCount) {
    if (nodes.empty()) return Error{ErrorKind::format, "no nodes; expected at least the root"};
    // A false count must not cost memory.
    if (leafCount > nodes.size() * width) {
        return Error{ErrorKind::format, fmt::format("{} leaves under {} nodes, which hold at most {}",
                                                    leafCount, nodes.size(), nodes.size() * width)};
    }
    return HierarchyCheck(nodes, leafCount).run();
}

}  // namespace filigree::bvh
