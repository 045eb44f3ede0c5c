#include "encoding/sdag_graph.h"

#include "encoding/hash_table.h"

#include <algorithm>

#include <xxhash.h>

namespace filigree::encoding::sdag {
namespace {

// The leaves of all wanted maps, one map after another, and which of them are equal.
class MergedLeaves {
  public:
    MergedLeaves(std::span<const SparseMap> maps, const std::vector<bool>& wanted, const Executor& executor)
        : begins_(maps.size()) {
        for (size_t k = 0; k < maps.size(); ++k) {
            begins_[k] = all_.size();
            if (!wanted[k]) continue;
            for (const Leaf& leaf : maps[k].leaves) all_.push_back(&leaf);
        }
        hashes_.resize(all_.size());
        numbers_.resize(all_.size());
        executor.parallelFor(all_.size(), 4096, [&](size_t begin, size_t end) {
            for (size_t k = begin; k < end; ++k) hashes_[k] = hash(*all_[k]);
        });
        executor.parallelFor(shards, 1, [&](size_t begin, size_t end) {
            for (size_t shard = begin; shard < end; ++shard) findFirsts(shard);
        });
        numberInOrder();
    }

    [[nodiscard]] uint32_t number(size_t map, uint32_t leaf) const { return numbers_[begins_[map] + leaf]; }
    [[nodiscard]] std::vector<Leaf> take() && { return std::move(distinct_); }

  private:
    // Leaves are shared out by hash, so that threads need no lock and find the same.
    static constexpr size_t shards = 16;

    void findFirsts(size_t shard) {
        HashTable table;
        for (size_t k = 0; k < all_.size(); ++k) {
            if (hashes_[k] >> 60 != shard) continue;
            numbers_[k] = table.findOrAdd(hashes_[k], static_cast<uint32_t>(k),
                                          [&](uint32_t other) { return *all_[other] == *all_[k]; });
        }
    }

    // From "the first leaf equal to this one" to numbers without gaps.
    void numberInOrder() {
        for (size_t k = 0; k < all_.size(); ++k) {
            if (numbers_[k] == k) {
                numbers_[k] = static_cast<uint32_t>(distinct_.size());
                distinct_.push_back(*all_[k]);
            } else {
                numbers_[k] = numbers_[numbers_[k]];
            }
        }
    }

    std::vector<const Leaf*> all_;
    std::vector<size_t> begins_;
    std::vector<uint64_t> hashes_;
    std::vector<uint32_t> numbers_;
    std::vector<Leaf> distinct_;
};

// A layer that finds what it already holds.
class LayerBuilder {
  public:
    uint32_t add(uint16_t mixed, uint16_t opaque, std::span<const uint32_t> children) {
        const Node node{mixed, opaque, addGroup(children)};
        const uint64_t key = mixed | (uint64_t{opaque} << 16) | (uint64_t{node.group} << 32);
        const auto next = static_cast<uint32_t>(layer_.nodes.size());
        const uint32_t found = nodes_.findOrAdd(XXH3_64bits(&key, sizeof(key)), next,
                                                [&](uint32_t k) { return layer_.nodes[k] == node; });
        if (found == next) layer_.nodes.push_back(node);
        return found;
    }

    [[nodiscard]] Layer take() && { return std::move(layer_); }

  private:
    uint32_t addGroup(std::span<const uint32_t> children) {
        const auto next = static_cast<uint32_t>(layer_.groupEnds.size());
        const uint32_t found =
            groups_.findOrAdd(XXH3_64bits(children.data(), children.size_bytes()), next,
                              [&](uint32_t k) { return std::ranges::equal(layer_.group(k), children); });
        if (found == next) {
            layer_.children.insert(layer_.children.end(), children.begin(), children.end());
            layer_.groupEnds.push_back(static_cast<uint32_t>(layer_.children.size()));
        }
        return found;
    }

    Layer layer_;
    HashTable nodes_;
    HashTable groups_;
};

class Merger {
  public:
    explicit Merger(std::vector<Leaf>& leaves) : leaves_(leaves) {}

    // The number of a part: a leaf at height 4, else a node.
    template <class NumberOfLeaf>
    uint32_t part(const SparseMap& map, Entry entry, unsigned height, const NumberOfLeaf& numberOfLeaf) {
        if (isUniform(entry)) return uniformPart(entry, height);
        if (isLeaf(entry)) return numberOfLeaf(indexOf(entry));
        return node(map.nodes[indexOf(entry)], height,
                    [&](Entry child) { return part(map, child, height - 2, numberOfLeaf); });
    }

    void takeLayers(std::array<Layer, nodeHeights>& to) && {
        for (unsigned slot = 0; slot < nodeHeights; ++slot) to[slot] = std::move(layers_[slot]).take();
    }

  private:
    template <class NumberOf>
    uint32_t node(const std::array<Entry, 16>& entries, unsigned height, const NumberOf& numberOf) {
        unsigned mixed = 0;
        unsigned opaque = 0;
        std::array<uint32_t, 16> children{};
        size_t count = 0;
        for (unsigned k = 0; k < 16; ++k) {
            if (entries[k] > 1) {
                mixed |= 1u << k;
                children[count++] = numberOf(entries[k]);
            } else {
                opaque |= entries[k] << k;
            }
        }
        return layers_[heightSlot(height)].add(static_cast<uint16_t>(mixed), static_cast<uint16_t>(opaque),
                                               std::span(children).first(count));
    }

    // Parts of unknown throughout are nodes and leaves like others, made when first met; so are whole maps of
    // one state.
    uint32_t uniformPart(Entry state, unsigned height) {
        if (height > leafHeight) {
            std::array<Entry, 16> entries{};
            entries.fill(state);
            return node(entries, height, [&](Entry e) { return uniformPart(e, height - 2); });
        }
        uint32_t& known = uniformLeaves_[state];
        if (known == HashTable::none) {
            known = static_cast<uint32_t>(leaves_.size());
            leaves_.emplace_back().patterns.fill(uniformPattern(state));
        }
        return known;
    }

    std::vector<Leaf>& leaves_;
    std::array<LayerBuilder, nodeHeights> layers_;
    std::array<uint32_t, 4> uniformLeaves_{HashTable::none, HashTable::none, HashTable::none,
                                           HashTable::none};
};

}  // namespace

Graph mergeMaps(std::span<const SparseMap> maps, const std::vector<bool>& wanted, const Executor& executor) {
    MergedLeaves merged(maps, wanted, executor);
    Graph graph;
    graph.roots.resize(maps.size());
    const auto numbers = [&](size_t map) {
        return [&merged, map](uint32_t leaf) { return merged.number(map, leaf); };
    };
    graph.leaves = std::move(merged).take();
    Merger merger(graph.leaves);
    for (size_t k = 0; k < maps.size(); ++k) {
        if (!wanted[k]) continue;
        graph.roots[k] = {maps[k].height, merger.part(maps[k], maps[k].root, maps[k].height, numbers(k))};
    }
    std::move(merger).takeLayers(graph.layers);
    return graph;
}

}  // namespace filigree::encoding::sdag
