#include "encoding/sdag_sparse.h"

namespace filigree::encoding::sdag {
namespace {

using micromap::Format;

// A quadtree with children by digit. Entries are uniform or nodes, which are `inner_`.
class DigitTree {
  public:
    DigitTree(const micromap::QuadtreeView& map, Format format)
        : reader_(map.words, map.bits), stateMask_(format == Format::twoState ? 1 : 3) {
        root_ = read(map.level, false);
        for (unsigned h = map.level; h < rootHeight(map.level); ++h) root_ = join({root_, 0, 0, 0});
    }

    [[nodiscard]] Entry root() const { return root_; }
    [[nodiscard]] Entry grandchild(Entry entry, unsigned upper, unsigned lower) const {
        return child(child(entry, upper), lower);
    }

  private:
    [[nodiscard]] Entry child(Entry entry, unsigned digit) const {
        return isUniform(entry) ? entry : inner_[indexOf(entry)][digit];
    }

    Entry read(unsigned height, bool odd) {
        if (height == 0 || !reader_.takeBit()) return static_cast<Entry>(reader_.take(2)) & stateMask_;
        std::array<Entry, 4> children{};
        for (unsigned k = 0; k < 4; ++k) {
            children[micromap::digitOfChild(k, odd)] = read(height - 1, odd != (k % 2 == 1));
        }
        return join(children);
    }

    Entry join(const std::array<Entry, 4>& children) {
        const bool alike = isUniform(children[0]) && children[1] == children[0] &&
                           children[2] == children[0] && children[3] == children[0];
        if (alike) return children[0];
        inner_.push_back(children);
        return nodeEntry(inner_.size() - 1);
    }

    BitReader reader_;
    Entry stateMask_;
    Entry root_ = 0;
    std::vector<std::array<Entry, 4>> inner_;
};

class Builder {
  public:
    Builder(const DigitTree& tree, SparseMap& to) : tree_(tree), to_(to) {}

    Entry part(Entry entry, unsigned height) {
        if (isUniform(entry)) return entry;
        if (height == leafHeight) {
            Leaf leaf;
            forGrandchildren(entry, [&](unsigned k, Entry e) { leaf.patterns[k] = pattern(e); });
            to_.leaves.push_back(leaf);
            return leafEntry(to_.leaves.size() - 1);
        }
        std::array<Entry, 16> node{};
        forGrandchildren(entry, [&](unsigned k, Entry e) { node[k] = part(e, height - 2); });
        to_.nodes.push_back(node);
        return nodeEntry(to_.nodes.size() - 1);
    }

  private:
    template <class Body>
    void forGrandchildren(Entry entry, Body body) {
        for (unsigned upper = 0; upper < 4; ++upper) {
            for (unsigned lower = 0; lower < 4; ++lower) {
                body(grandchild(upper, lower), tree_.grandchild(entry, upper, lower));
            }
        }
    }

    Pattern pattern(Entry entry) {
        if (isUniform(entry)) return uniformPattern(entry);
        Pattern states = 0;
        forGrandchildren(entry, [&](unsigned k, Entry state) { states |= state << (2 * k); });
        return states;
    }

    const DigitTree& tree_;
    SparseMap& to_;
};

}  // namespace

SparseMap sparseMap(const micromap::QuadtreeView& map, Format format) {
    const DigitTree tree(map, format);
    SparseMap sparse;
    sparse.height = rootHeight(map.level);
    sparse.root = Builder(tree, sparse).part(tree.root(), sparse.height);
    return sparse;
}

void turn(SparseMap& map, unsigned symmetry) {
    if (symmetry == 0) return;
    for (auto& leaf : map.leaves) leaf = turned(leaf, symmetry);
    for (auto& node : map.nodes) {
        const auto old = node;
        for (unsigned k = 0; k < 16; ++k) node[turnedGrandchild(k, symmetry)] = old[k];
    }
}

}  // namespace filigree::encoding::sdag
