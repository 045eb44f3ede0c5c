#include "bvh/top_tree.h"

#include "bvh/bins.h"
#include "bvh/subtree.h"

#include <algorithm>
#include <numeric>

namespace filigree::bvh {
namespace {

constexpr size_t chunkSize = size_t{1} << 15;

// body(chunk, first, last) for all chunks of a range.
template <class Body>
void forChunks(const Range& range, const Executor& executor, const Body& body) {
    executor.parallelFor((range.count() + chunkSize - 1) / chunkSize, 1, [&](size_t from, size_t to) {
        for (size_t chunk = from; chunk < to; ++chunk) {
            const size_t first = range.begin + chunk * chunkSize;
            body(chunk, first, std::min(first + chunkSize, range.end));
        }
    });
}

// One T for each chunk, filled place by place, then joined in order.
template <class T, class Fill, class Join>
T reduceChunks(const Range& range, const Executor& executor, const Fill& fill, const Join& join) {
    std::vector<T> parts((range.count() + chunkSize - 1) / chunkSize);
    forChunks(range, executor, [&](size_t chunk, size_t first, size_t last) {
        for (size_t k = first; k < last; ++k) fill(parts[chunk], k);
    });
    for (size_t k = 1; k < parts.size(); ++k) join(parts[0], parts[k]);
    return std::move(parts[0]);
}

class TopTreeBuilder {
  public:
    TopTreeBuilder(std::span<const Box> boxes, size_t rangeLimit, const Executor& executor)
        : boxes_(boxes), rangeLimit_(rangeLimit), executor_(executor), scratch_(boxes.size()) {
        tree_.indices.resize(boxes.size());
        std::iota(tree_.indices.begin(), tree_.indices.end(), 0);
    }

    TopTree build() {
        tree_.branches.emplace_back();
        std::vector<Open> level{{0, {0, boxes_.size(), 0}, 0}};
        while (!level.empty()) {
            executor_.parallelFor(level.size(), 1, [&](size_t first, size_t last) {
                for (size_t k = first; k < last; ++k) visit(level[k]);
            });
            level = nextLevel(level);
        }
        return std::move(tree_);
    }

  private:
    struct Open {
        uint32_t branch = 0;
        Range range;
        size_t middle = 0;
    };
    struct Spread {
        Bounds boxes;
        Bounds centres;
    };

    [[nodiscard]] const Box& boxAt(size_t place) const { return boxes_[tree_.indices[place]]; }

    // Bounds of the branch; where it is split, its indices are parted.
    void visit(Open& open) {
        const auto spread = reduceChunks<Spread>(
            open.range, executor_,
            [&](Spread& part, size_t k) {
                part.boxes.extend(boxAt(k));
                part.centres.extend(centreOf(boxAt(k)));
            },
            [](Spread& sum, const Spread& part) {
                sum.boxes.extend(part.boxes);
                sum.centres.extend(part.centres);
            });
        tree_.branches[open.branch].bounds = spread.boxes;
        if (open.range.count() > rangeLimit_) open.middle = split(open.range, spread.centres);
    }

    size_t split(const Range& range, const Bounds& centres) {
        const BinLattice lattice(centres);
        const size_t half = range.begin + range.count() / 2;
        if (mustHalve(range.depth, range.count())) return half;
        const Bins bins = reduceChunks<Bins>(
            range, executor_, [&](Bins& part, size_t k) { part.add(lattice, boxAt(k)); },
            [](Bins& sum, const Bins& part) { sum.add(part); });
        const auto cut = bins.best(lattice);
        return cut ? part(range, lattice, *cut) : half;
    }

    // Moves what is left of the cut to the front, keeping orders.
    size_t part(const Range& range, const BinLattice& lattice, const Cut& cut) {
        const auto isLeft = [&](size_t k) { return lattice.isLeft(centreOf(boxAt(k)), cut); };
        std::vector<size_t> lefts((range.count() + chunkSize - 1) / chunkSize);
        forChunks(range, executor_, [&](size_t chunk, size_t first, size_t last) {
            for (size_t k = first; k < last; ++k) lefts[chunk] += isLeft(k) ? 1 : 0;
        });
        const size_t middle = std::accumulate(lefts.begin(), lefts.end(), range.begin);
        std::exclusive_scan(lefts.begin(), lefts.end(), lefts.begin(), range.begin);
        forChunks(range, executor_, [&](size_t chunk, size_t first, size_t last) {
            size_t left = lefts[chunk];
            size_t right = middle + (first - left);
            for (size_t k = first; k < last; ++k) {
                scratch_[isLeft(k) ? left++ : right++] = tree_.indices[k];
            }
        });
        forChunks(range, executor_, [&](size_t, size_t first, size_t last) {
            std::copy(scratch_.begin() + static_cast<std::ptrdiff_t>(first),
                      scratch_.begin() + static_cast<std::ptrdiff_t>(last),
                      tree_.indices.begin() + static_cast<std::ptrdiff_t>(first));
        });
        return middle;
    }

    std::vector<Open> nextLevel(const std::vector<Open>& level) {
        std::vector<Open> next;
        for (const Open& open : level) {
            if (open.middle == 0) {
                tree_.branches[open.branch].right = static_cast<uint32_t>(tree_.ranges.size());
                tree_.ranges.push_back(open.range);
                continue;
            }
            const auto left = static_cast<uint32_t>(tree_.branches.size());
            tree_.branches.resize(tree_.branches.size() + 2);
            tree_.branches[open.branch].left = left;
            tree_.branches[open.branch].right = left + 1;
            const unsigned depth = open.range.depth + 1;
            next.push_back({left, {open.range.begin, open.middle, depth}, 0});
            next.push_back({left + 1, {open.middle, open.range.end, depth}, 0});
        }
        return next;
    }

    std::span<const Box> boxes_;
    size_t rangeLimit_;
    const Executor& executor_;
    std::vector<uint32_t> scratch_;
    TopTree tree_;
};

}  // namespace

TopTree buildTopTree(std::span<const Box> boxes, size_t rangeLimit, const Executor& executor) {
    return TopTreeBuilder(boxes, rangeLimit, executor).build();
}

}  // namespace filigree::bvh
