#include "capi/trees.h"

#include <algorithm>

namespace filigree::capi {

Trees::Trees(const Memory& memory, const micromap::QuadtreeList& trees) : places_(memory, trees.size()) {
    size_t words = 0;
    for (size_t k = 0; k < trees.size(); ++k) {
        const micromap::QuadtreeView tree = trees[k];
        places_[k] = {words, static_cast<uint32_t>(tree.bits), tree.level};
        words += tree.words.size();
    }
    words_ = Array<uint64_t>(memory, words);
    for (size_t k = 0; k < trees.size(); ++k)
        std::ranges::copy(trees[k].words, words_.values().subspan(places_[k].word).begin());
}

std::vector<micromap::QuadtreeView> Trees::views() const {
    std::vector<micromap::QuadtreeView> views(size());
    for (size_t k = 0; k < size(); ++k) views[k] = (*this)[k];
    return views;
}

}  // namespace filigree::capi
