#include "bake/field.h"

#include "filigree/image/mip_chain.h"

#include <algorithm>

namespace filigree::bake {

Field::Field(const std::vector<const image::AlphaTexture*>& chain, const image::AlphaTest& test,
             double vertexAlpha)
    : guard_(test.guard) {
    for (const image::AlphaTexture* level : chain) {
        for (const image::Filter filter : image::filtersOf(level->filter)) {
            for (const image::Threshold& threshold :
                 image::thresholdsOf(test, vertexAlpha, level->image.steps)) {
                layers_.push_back({image::Outline(*level, filter, threshold)});
            }
        }
    }
    const image::Threshold side = image::sideThreshold(test, vertexAlpha, chain.front()->image.steps);
    const image::Outline& first = layers_.front().outline;
    if (!(side == first.threshold())) {
        sideOutline_ = std::make_unique<image::Outline>(*chain.front(), first.filter(), side);
    }
}

bool Field::empty() const {
    return std::ranges::all_of(layers_, [](const Layer& layer) { return layer.outline.empty(); });
}

}  // namespace filigree::bake
