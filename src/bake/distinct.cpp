#include "bake/distinct.h"

#include <bit>
#include <cstring>
#include <unordered_map>

#include <xxhash.h>

namespace filigree::bake {
namespace {

// A triangle's bits and level.
struct Key {
    std::array<uint32_t, 10> words{};
    bool operator==(const Key&) const = default;
};

Key keyOf(const mesh::UvTriangle& triangle, uint8_t level) {
    Key key;
    for (size_t k = 0; k < 3; ++k) {
        key.words[3 * k] = std::bit_cast<uint32_t>(triangle.uv[k].u);
        key.words[3 * k + 1] = std::bit_cast<uint32_t>(triangle.uv[k].v);
        key.words[3 * k + 2] = std::bit_cast<uint32_t>(triangle.alpha[k]);
    }
    key.words[9] = level;
    return key;
}

struct KeyHash {
    size_t operator()(const Key& key) const { return XXH3_64bits(key.words.data(), sizeof(key.words)); }
};

}  // namespace

DistinctTriangles findDistinct(std::span<const mesh::UvTriangle> triangles, std::span<const uint8_t> levels) {
    DistinctTriangles distinct;
    distinct.number.reserve(triangles.size());
    std::unordered_map<Key, uint32_t, KeyHash> seen;
    seen.reserve(triangles.size());
    for (size_t t = 0; t < triangles.size(); ++t) {
        const auto next = static_cast<uint32_t>(distinct.representative.size());
        const auto [entry, fresh] = seen.try_emplace(keyOf(triangles[t], levels[t]), next);
        if (fresh) distinct.representative.push_back(static_cast<uint32_t>(t));
        distinct.number.push_back(entry->second);
    }
    return distinct;
}

}  // namespace filigree::bake
