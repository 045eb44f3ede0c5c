#include "bake/field.h"

#include <algorithm>

namespace filigree::bake {
namespace {

std::vector<image::Filter> filtersOf(image::Filter filter) {
    if (filter == image::Filter::both) return {image::Filter::linear, image::Filter::nearest};
    return {filter};
}

}  // namespace

Field::Field(const std::vector<image::AlphaTexture>& chain, const image::AlphaTest& test, double vertexAlpha)
    : guard_(test.guard) {
    for (const image::AlphaTexture& level : chain) {
        for (const image::Filter filter : filtersOf(level.filter)) {
            for (const image::Threshold& threshold :
                 image::thresholdsOf(test, vertexAlpha, level.image.steps)) {
                layers_.push_back({&level, image::Outline(level, filter, threshold)});
            }
        }
    }
    const image::Threshold side = image::sideThreshold(test, vertexAlpha, chain.front().image.steps);
    const image::Outline& first = layers_.front().outline;
    if (!(side == first.threshold())) {
        sideOutline_ = std::make_unique<image::Outline>(chain.front(), first.filter(), side);
    }
}

bool Field::empty() const {
    return std::ranges::all_of(layers_, [](const Layer& layer) { return layer.outline.empty(); });
}

std::vector<image::AlphaTexture> mipChain(const image::AlphaTexture& texture, unsigned mips) {
    std::vector<image::AlphaTexture> chain{texture};
    const unsigned levels = std::min(mips, image::coarserLevels(texture.image));
    chain.reserve(levels + 1);
    for (unsigned level = 0; level < levels; ++level) {
        image::AlphaTexture coarser = chain.back();
        coarser.image = image::halve(chain.back().image);
        chain.push_back(std::move(coarser));
    }
    return chain;
}

}  // namespace filigree::bake
