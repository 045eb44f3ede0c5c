// Writes canonical quadtree streams from the top down.
#pragma once

#include "filigree/micromap/quadtree.h"

#include <algorithm>
#include <array>

namespace filigree::micromap {

// Keeps one byte a node until finish(), so that four siblings that turn out alike can be taken back.
class QuadtreeBuilder {
  public:
    explicit QuadtreeBuilder(unsigned level) : level_(level) {}

    // A node at `depth` whose children are made by child(0..3), each by a call of inner() or leaf(). Returns
    // the state when the node ends up as one leaf, else -1.
    template <class Child>
    int inner(unsigned depth, Child&& child) {
        std::array<int, 4> states{};
        const size_t mark = nodes_.size();
        nodes_.push_back(kInner);
        for (unsigned k = 0; k < 4; ++k) states[k] = child(k);
        if (states[0] < 0 || std::ranges::count(states, states[0]) != 4) return -1;
        nodes_.resize(mark);
        return leaf(depth, static_cast<State>(states[0]));
    }

    int leaf(unsigned depth, State state) {
        nodes_.push_back(static_cast<uint8_t>(static_cast<uint8_t>(state) | (depth < level_ ? kAbove : 0)));
        return static_cast<int>(state);
    }

    [[nodiscard]] Quadtree finish() const {
        BitWriter stream;
        for (const uint8_t node : nodes_) {
            if (node == kInner) {
                stream.append(1, 1);
            } else if ((node & kAbove) != 0) {
                stream.append(uint64_t{node & 3u} << 1, 3);
            } else {
                stream.append(node, 2);
            }
        }
        return {std::move(stream), level_};
    }

  private:
    static constexpr uint8_t kInner = 0xff;
    static constexpr uint8_t kAbove = 4;  // a leaf above the finest level
    unsigned level_;
    std::vector<uint8_t> nodes_;
};

}  // namespace filigree::micromap
