#include "bake/share.h"

namespace filigree::bake {

int32_t Sharer::add(const micromap::QuadtreeView& tree) {
    if (micromap::isUniform(tree)) return micromap::specialIndex(micromap::uniformState(tree));
    const uint64_t hash = micromap::hash(tree);
    const auto [first, last] = byHash_.equal_range(hash);
    for (auto candidate = first; candidate != last; ++candidate) {
        if (micromap::equal(list_[candidate->second], tree)) return static_cast<int32_t>(candidate->second);
    }
    const auto index = static_cast<uint32_t>(list_.size());
    byHash_.emplace(hash, index);
    list_.push(tree);
    return static_cast<int32_t>(index);
}

}  // namespace filigree::bake
