#include "bake/field.h"

#include <algorithm>

namespace filigree::bake {
namespace {

std::vector<image::Filter> filtersOf(image::Filter filter) {
    if (filter == image::Filter::both) return {image::Filter::linear, image::Filter::nearest};
    return {filter};
}

}  // namespace

Field::Field(const std::vector<const image::AlphaTexture*>& chain, const image::AlphaTest& test,
             double vertexAlpha)
    : guard_(test.guard) {
    for (const image::AlphaTexture* level : chain) {
        for (const image::Filter filter : filtersOf(level->filter)) {
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

MipChain::MipChain(const image::AlphaTexture& texture, unsigned coarserLevels) : levels_{&texture} {
    const unsigned count = std::min(coarserLevels, image::coarserLevels(texture.image));
    for (unsigned level = 0; level < count; ++level) {
        const image::AlphaTexture& finer = *levels_.back();
        coarser_.push_back({image::halve(finer.image), texture.wrapU, texture.wrapV, texture.filter});
        levels_.push_back(&coarser_.back());
    }
}

}  // namespace filigree::bake
