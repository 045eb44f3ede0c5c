// New quadtrees from old ones: coarser levels and other vertex orders.

#include "filigree/micromap/quadtree.h"
#include "filigree/micromap/quadtree_writer.h"

#include <array>
#include <cassert>

namespace filigree::micromap {
namespace {

// A quadtree with its children at hand, in depth-first order.
class NodeTable {
  public:
    explicit NodeTable(const QuadtreeView& tree) : level_(tree.level) {
        BitReader reader(tree.words, tree.bits);
        read(reader, 0);
    }

    static constexpr size_t root = 0;
    [[nodiscard]] unsigned level() const { return level_; }
    [[nodiscard]] bool isInner(size_t node) const { return nodes_[node].child[0] != 0; }
    [[nodiscard]] size_t child(size_t node, unsigned k) const { return nodes_[node].child[k]; }
    [[nodiscard]] State state(size_t node) const { return nodes_[node].state; }

    // How many of the micro-triangles under `node`, which lies at `depth`, are on the opaque side.
    [[nodiscard]] uint64_t opaqueCount(size_t node, unsigned depth) const {
        if (!isInner(node)) return isOpaqueSide(state(node)) ? microTriangleCount(level_ - depth) : 0;
        uint64_t sum = 0;
        for (unsigned k = 0; k < 4; ++k) sum += opaqueCount(child(node, k), depth + 1);
        return sum;
    }

  private:
    struct Node {
        std::array<uint32_t, 4> child{};  // all 0 for a leaf
        State state = State::transparent;
    };

    uint32_t read(BitReader& reader, unsigned depth) {
        const auto node = static_cast<uint32_t>(nodes_.size());
        nodes_.emplace_back();
        if (depth < level_ && reader.takeBit()) {
            for (unsigned k = 0; k < 4; ++k) {
                const uint32_t child = read(reader, depth + 1);
                nodes_[node].child[k] = child;
            }
        } else {
            nodes_[node].state = static_cast<State>(reader.take(2));
        }
        return node;
    }

    unsigned level_;
    std::vector<Node> nodes_;
};

int copyCoarsened(const NodeTable& table, size_t node, unsigned depth, unsigned level, Format format,
                  BitWriter& to) {
    if (!table.isInner(node)) return appendLeaf(to, level - depth, static_cast<int>(table.state(node)));
    if (depth == level) {
        const bool opaque = 2 * table.opaqueCount(node, depth) >= microTriangleCount(table.level() - depth);
        return appendLeaf(to, 0,
                          static_cast<int>(format == Format::twoState ? knownOf(opaque) : unknownOf(opaque)));
    }
    return appendInner(to, level - depth, [&](unsigned k) {
        return copyCoarsened(table, table.child(node, k), depth + 1, level, format, to);
    });
}

// How the children of a triangle move when its vertices take another order: the new child k is the old child
// `from[k].child` with its own vertices reordered by `from[k].order`.
struct ChildMove {
    unsigned child = 0;
    VertexOrder order{};
};

// Points of a subdivided triangle (a, b, c): a, b, c = 0, 1, 2 and the midpoints ab, bc, ca = 3, 4, 5.
constexpr unsigned midpointLabel(unsigned p, unsigned q) {
    if (p + q == 1) return 3;
    return p + q == 3 ? 4 : 5;
}

constexpr ChildMove moveOf(const VertexOrder& order, unsigned child) {
    constexpr std::array<std::array<unsigned, 3>, 4> frames{{{0, 3, 5}, {5, 4, 3}, {3, 1, 4}, {4, 5, 2}}};
    const std::array<unsigned, 6> moved{order[0],
                                        order[1],
                                        order[2],
                                        midpointLabel(order[0], order[1]),
                                        midpointLabel(order[1], order[2]),
                                        midpointLabel(order[2], order[0])};
    for (unsigned old = 0; old < 4; ++old) {
        ChildMove move{old, {}};
        unsigned found = 0;
        for (unsigned k = 0; k < 3; ++k) {
            for (unsigned m = 0; m < 3; ++m) {
                if (frames[old][m] == moved[frames[child][k]]) {
                    move.order[k] = static_cast<uint8_t>(m);
                    ++found;
                }
            }
        }
        if (found == 3) return move;
    }
    return {};
}

int copyPermuted(const NodeTable& table, size_t node, unsigned height, const VertexOrder& order,
                 BitWriter& to) {
    if (!table.isInner(node)) return appendLeaf(to, height, static_cast<int>(table.state(node)));
    return appendInner(to, height, [&](unsigned k) {
        const ChildMove move = moveOf(order, k);
        return copyPermuted(table, table.child(node, move.child), height - 1, move.order, to);
    });
}

}  // namespace

Quadtree coarsened(const QuadtreeView& tree, unsigned level, Format format) {
    assert(level <= tree.level);
    BitWriter stream;
    copyCoarsened(NodeTable(tree), NodeTable::root, 0, level, format, stream);
    return {std::move(stream), level};
}

Quadtree permuted(const QuadtreeView& tree, const VertexOrder& order) {
    BitWriter stream;
    copyPermuted(NodeTable(tree), NodeTable::root, tree.level, order, stream);
    return {std::move(stream), tree.level};
}

}  // namespace filigree::micromap
