#include "filigree/bvh/build.h"

#include "filigree/core/stage.h"

#include "bvh/emit.h"
#include "bvh/subtree.h"
#include "bvh/top_tree.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace filigree::bvh {
namespace {

// Enough subtrees for any number of threads, each large enough that its root need not be full. No size
// depends on the executor.
size_t rangeLimitOf(size_t count) {
    return std::clamp<size_t>(count / 64, 1024, 65536);
}

// Where a subtree stands in the whole.
struct Place {
    size_t root = 0;
    size_t others = 0;  // all its nodes but the root
    size_t leaves = 0;
};

// Puts the top and the subtrees in one list, each child group in one piece, depth first.
class Assembly {
  public:
    Assembly(const TopTree& top, std::vector<Subtree>& subtrees)
        : top_(top), subtrees_(subtrees), collapse_(top.branches, nodePriceOf(top.branches)) {}

    Bvh assemble(const Executor& executor) {
        places_.resize(subtrees_.size());
        out_.nodes.emplace_back();
        leafCount_ = 0;
        place(0, 0);
        out_.order.resize(leafCount_);
        executor.parallelFor(subtrees_.size(), 1, [&](size_t first, size_t last) {
            for (size_t k = first; k < last; ++k) copySubtree(k);
        });
        for (const auto& [leaf, box] : singles_) out_.order[leaf] = box;
        return std::move(out_);
    }

  private:
    [[nodiscard]] bool isSubtree(const Branch& branch) const {
        return branch.left == Branch::isLeaf && top_.ranges[branch.right].count() > 1;
    }

    void place(uint32_t branch, size_t at) {
        if (isSubtree(top_.branches[branch])) {
            placeSubtree(top_.branches[branch].right, at);
            return;
        }
        const Children children = collapse_.childrenOf(branch);
        const NodeParts parts = partsOf(top_.branches, children, [&](const Branch& child) {
            return child.left == Branch::isLeaf && !isSubtree(child);
        });
        Node node = parts.node;
        node.firstChild = static_cast<uint32_t>(out_.nodes.size());
        node.firstLeaf = static_cast<uint32_t>(leafCount_);
        for (const uint32_t leaf : parts.leaves()) {
            singles_.push_back({leafCount_++, top_.indices[top_.ranges[leaf].begin]});
        }
        out_.nodes.resize(out_.nodes.size() + parts.inner().size());
        out_.nodes[at] = node;
        for (size_t k = 0; k < parts.inner().size(); ++k) place(parts.inner()[k], node.firstChild + k);
    }

    void placeSubtree(size_t range, size_t at) {
        places_[range] = {at, out_.nodes.size(), leafCount_};
        out_.nodes.resize(out_.nodes.size() + subtrees_[range].nodes.size() - 1);
        leafCount_ += subtrees_[range].order.size();
    }

    void copySubtree(size_t range) {
        Subtree& subtree = subtrees_[range];
        const Place& to = places_[range];
        for (size_t k = 0; k < subtree.nodes.size(); ++k) {
            Node node = subtree.nodes[k];
            node.firstChild += static_cast<uint32_t>(to.others - 1);
            node.firstLeaf += static_cast<uint32_t>(to.leaves);
            out_.nodes[k == 0 ? to.root : to.others + k - 1] = node;
        }
        std::copy(subtree.order.begin(), subtree.order.end(),
                  out_.order.begin() + static_cast<std::ptrdiff_t>(to.leaves));
        subtree = {};
    }

    struct Single {
        size_t leaf;
        uint32_t box;
    };

    const TopTree& top_;
    std::vector<Subtree>& subtrees_;
    Collapse collapse_;
    std::vector<Place> places_;
    std::vector<Single> singles_;
    size_t leafCount_ = 0;
    Bvh out_;
};

}  // namespace

namespace {

constexpr size_t mostBoxes = size_t{1} << 31;

bool isUsable(const Box& box) {
    const auto fits = [](float c) { return std::fabs(c) < 0x1p127F; };
    return !box.empty() && std::ranges::all_of(box.low, fits) && std::ranges::all_of(box.high, fits);
}

Status checkBoxes(std::span<const Box> boxes) {
    if (boxes.empty() || boxes.size() > mostBoxes)
        return Error{ErrorKind::usage, fmt::format("{} boxes, expected 1 to {}", boxes.size(), mostBoxes)};
    for (size_t k = 0; k < boxes.size(); ++k) {
        if (!isUsable(boxes[k])) return Error{ErrorKind::usage, fmt::format("box {} is empty or too far", k)};
    }
    return {};
}

Result<Bvh> buildStage(std::span<const Box> boxes, const Executor& executor, ProgressSink& progress) {
    const Stage stage(executor, progress, "hierarchy", boxes.size(), "boxes");
    const TopTree top = buildTopTree(boxes, rangeLimitOf(boxes.size()), executor);
    std::vector<Subtree> subtrees(top.ranges.size());
    stage.parallelFor(subtrees.size(), 1, [&](size_t first, size_t last) {
        for (size_t k = first; k < last; ++k) {
            const Range& range = top.ranges[k];
            stage.advance(range.count());
            if (range.count() == 1) continue;
            subtrees[k] =
                buildSubtree(boxes, std::span(top.indices).subspan(range.begin, range.count()), range.depth);
        }
    });
    if (const Status status = stage.status(); !status) return status.error();
    return Assembly(top, subtrees).assemble(executor);
}

}  // namespace

Bvh build(std::span<const Box> boxes, const Executor& executor) {
    assert(!boxes.empty() && boxes.size() <= mostBoxes);
    return std::move(*buildStage(boxes, executor, silentProgress()));
}

Result<Bvh> build(std::span<const Box> boxes, const Executor& executor, ProgressSink& progress) {
    if (const Status status = checkBoxes(boxes); !status) return status.error();
    return buildStage(boxes, executor, progress);
}

}  // namespace filigree::bvh
