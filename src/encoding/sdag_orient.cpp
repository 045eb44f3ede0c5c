#include "encoding/sdag_orient.h"

#include "encoding/hash_table.h"

#include <algorithm>
#include <array>

namespace filigree::encoding::sdag {
namespace {

using micromap::symmetryCount;

// Hashes of one thing turned in all six ways.
using Hashes = std::array<uint64_t, symmetryCount>;

uint64_t mixed(uint64_t hash, uint64_t value) {
    hash = (hash ^ value) * 0x9fb21c651e98df25u;
    return hash ^ (hash >> 29);
}

// A map's leaves that vote, and all of the map.
struct MapHashes {
    std::vector<Hashes> leaves;
    Hashes root{};
};

// Leaves are many: one in four votes, the same ones in every map and whichever way they are turned.
bool votes(const Hashes& leaf) {
    return (*std::ranges::min_element(leaf) & 3) == 0;
}

class MapHasher {
  public:
    explicit MapHasher(const SparseMap& map) {
        leaves_.reserve(map.leaves.size());
        for (const Leaf& leaf : map.leaves) leaves_.push_back(hashesOf(leaf));
        nodes_.reserve(map.nodes.size());
        for (const auto& node : map.nodes) nodes_.push_back(hashesOf(node));
        root_ = hashesOf(map.root);
        for (uint64_t& hash : root_) hash = mixed(hash, map.height);
    }

    MapHashes result() && {
        std::erase_if(leaves_, [](const Hashes& leaf) { return !votes(leaf); });
        return {std::move(leaves_), root_};
    }

  private:
    static Hashes hashesOf(const Leaf& leaf) {
        Hashes hashes;
        for (unsigned s = 0; s < symmetryCount; ++s) hashes[s] = hash(turned(leaf, s));
        return hashes;
    }

    [[nodiscard]] Hashes hashesOf(Entry entry) const {
        if (!isUniform(entry)) return (isLeaf(entry) ? leaves_ : nodes_)[indexOf(entry)];
        Hashes hashes;
        hashes.fill(entry + 1);
        return hashes;
    }

    [[nodiscard]] Hashes hashesOf(const std::array<Entry, 16>& node) const {
        Hashes hashes{};
        for (unsigned s = 0; s < symmetryCount; ++s) {
            std::array<uint64_t, 16> children{};
            for (unsigned k = 0; k < 16; ++k) children[turnedGrandchild(k, s)] = hashesOf(node[k])[s];
            for (const uint64_t child : children) hashes[s] = mixed(hashes[s], child);
        }
        return hashes;
    }

    std::vector<Hashes> leaves_;
    std::vector<Hashes> nodes_;
    Hashes root_{};
};

// What earlier maps hold, as they are turned.
class Earlier {
  public:
    // The best symmetry for a map, which is taken in with it.
    unsigned choose(const MapHashes& map) {
        const unsigned symmetry = best(map);
        addOnce(roots_, map.root[symmetry]);
        for (const Hashes& leaf : map.leaves) addOnce(leaves_, leaf[symmetry]);
        return symmetry;
    }

  private:
    static bool has(const HashTable& table, uint64_t hash) {
        return table.find(hash, [](uint32_t) { return true; }) != HashTable::none;
    }
    static void addOnce(HashTable& table, uint64_t hash) {
        if (!has(table, hash)) table.add(hash, 0);
    }

    [[nodiscard]] unsigned best(const MapHashes& map) const {
        for (unsigned s = 0; s < symmetryCount; ++s) {
            if (has(roots_, map.root[s])) return s;
        }
        std::array<size_t, symmetryCount> shared{};
        for (const Hashes& leaf : map.leaves) {
            for (unsigned s = 0; s < symmetryCount; ++s) shared[s] += has(leaves_, leaf[s]) ? 1 : 0;
        }
        return static_cast<unsigned>(std::ranges::max_element(shared) - shared.begin());
    }

    HashTable roots_;
    HashTable leaves_;
};

// Maps hashed at a time, whatever the threads.
constexpr size_t batch = 64;

}  // namespace

std::vector<uint8_t> orient(std::span<SparseMap> maps, const Stage& stage) {
    std::vector<uint8_t> symmetries(maps.size());
    Earlier earlier;
    std::array<MapHashes, batch> hashes;
    for (size_t first = 0; first < maps.size() && !stage.cancelled(); first += batch) {
        const size_t count = std::min(batch, maps.size() - first);
        stage.parallelFor(count, 1, [&](size_t begin, size_t end) {
            for (size_t k = begin; k < end; ++k) hashes[k] = MapHasher(maps[first + k]).result();
        });
        for (size_t k = 0; k < count; ++k) {
            symmetries[first + k] = static_cast<uint8_t>(earlier.choose(hashes[k]));
        }
        stage.advance(count);
    }
    stage.parallelFor(maps.size(), 16, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k) turn(maps[k], symmetries[k]);
    });
    return symmetries;
}

}  // namespace filigree::encoding::sdag
