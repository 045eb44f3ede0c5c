#include "bake/share.h"

namespace filigree::bake {

Shared Sharer::add(const micromap::QuadtreeView& tree, uint64_t hash) {
    if (micromap::isUniform(tree)) return {micromap::specialIndex(micromap::uniformState(tree)), 0};
    if (const auto index = trees_.find(tree, hash)) return {*index, 0};
    for (uint8_t r = 1; rotate_ && r < 3; ++r) {
        const micromap::VertexOrder order{r, static_cast<uint8_t>((r + 1) % 3),
                                          static_cast<uint8_t>((r + 2) % 3)};
        const micromap::Quadtree turned = micromap::permuted(tree, order);
        if (const auto index = trees_.find(turned.view(), micromap::hash(turned.view()))) return {*index, r};
    }
    return {trees_.append(tree, hash), 0};
}

}  // namespace filigree::bake
