#include "filigree/image/mip_chain.h"

#include <algorithm>

namespace filigree::image {

MipChain::MipChain(const AlphaTexture& texture, unsigned coarser) : levels_{&texture} {
    const unsigned count = std::min(coarser, coarserLevels(texture.image));
    for (unsigned level = 0; level < count; ++level) {
        const AlphaTexture& finer = *levels_.back();
        coarser_.push_back({halve(finer.image), texture.wrapU, texture.wrapV, texture.filter});
        levels_.push_back(&coarser_.back());
    }
}

std::vector<Filter> filtersOf(Filter filter) {
    if (filter == Filter::both) return {Filter::linear, Filter::nearest};
    return {filter};
}

}  // namespace filigree::image
