#include "bake/share.h"

namespace filigree::bake {

Shared Sharer::add(const micromap::QuadtreeView& tree, uint64_t hash) {
    if (micromap::isUniform(tree)) return {micromap::specialIndex(micromap::uniformState(tree)), 0};
    if (const std::optional<int32_t> index = find(tree, hash)) return {*index, 0};
    for (uint8_t r = 1; rotate_ && r < 3; ++r) {
        const micromap::VertexOrder order{r, static_cast<uint8_t>((r + 1) % 3),
                                          static_cast<uint8_t>((r + 2) % 3)};
        const micromap::Quadtree turned = micromap::permuted(tree, order);
        if (const auto index = find(turned.view(), micromap::hash(turned.view()))) return {*index, r};
    }
    const auto index = static_cast<int32_t>(list_.size());
    byHash_.emplace(hash, index);
    list_.push(tree);
    return {index, 0};
}

std::optional<int32_t> Sharer::find(const micromap::QuadtreeView& tree, uint64_t hash) const {
    const auto [first, last] = byHash_.equal_range(hash);
    for (auto candidate = first; candidate != last; ++candidate) {
        if (micromap::equal(list_[static_cast<size_t>(candidate->second)], tree)) return candidate->second;
    }
    return std::nullopt;
}

}  // namespace filigree::bake
