#include "jobs/vq_maps.h"

#include "filigree/bake/bake.h"
#include "filigree/io/gltf.h"
#include "filigree/io/image_file.h"
#include "filigree/micromap/quadtree.h"

#include "jobs/alpha_source.h"
#include "jobs/scene_pairs.h"

#include <algorithm>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

using quadmap::Crop;
using quadmap::HalfTriangle;

HalfTriangle cropHalf(const image::AlphaImage& image, uint32_t x0, uint32_t y0, uint32_t x1, uint32_t y1) {
    const auto uv = [&](uint32_t x, uint32_t y) {
        return mesh::Uv{static_cast<float>(double(x) / image.width),
                        static_cast<float>(double(y) / image.height)};
    };
    HalfTriangle half;
    half.uv = {uv(x0, y0), uv(x1, y0), uv(x0, y1)};
    return half;
}

// A crop as the two triangles of its square.
SquarePair pairOf(const image::AlphaImage& image, const Crop& c) {
    return {cropHalf(image, c.x0, c.y0, c.x1, c.y1), cropHalf(image, c.x1, c.y1, c.x0, c.y0)};
}

// Of `pairs` so many, evenly spread.
std::vector<SquarePair> spread(std::vector<SquarePair> pairs, size_t most) {
    if (most == 0 || pairs.size() <= most) return pairs;
    std::vector<SquarePair> kept;
    for (size_t k = 0; k < most; ++k) kept.push_back(pairs[k * pairs.size() / most]);
    return kept;
}

Crop wholeOf(const image::AlphaImage& image) {
    return {0, 0, image.width, image.height};
}

VqInput inputOf(const scene::Scene& scene, const PairGroup& group, const VqOptions& options) {
    VqInput input;
    input.name = nameOf(scene, group.source);
    input.texture = textureOf(scene, group.source);
    input.test = testFor(group.source, input.texture);
    input.crop = wholeOf(input.texture.image);
    input.pairs = spread(distinctPairs(group).pairs, options.mapsPerTexture);
    input.pairCount = 0;
    for (const PairedPrimitive& primitive : group.primitives) {
        for (const mesh::TrianglePair& pair : primitive.pairs)
            ++(pair.second ? input.pairCount : input.singles);
    }
    return input;
}

double knownShare(const micromap::TreeSet& set, size_t triangle) {
    const int32_t index = set.indices[triangle];
    if (index < 0) return micromap::isKnown(micromap::stateOfSpecialIndex(index)) ? 1 : 0;
    const auto states = micromap::countStates(set.trees[static_cast<size_t>(index)]);
    return static_cast<double>(states.of[0] + states.of[1]) / static_cast<double>(states.total());
}

}  // namespace

Result<VqInput> readVqTexture(const std::filesystem::path& path, const VqOptions& options) {
    auto image = io::readAlphaImage(path);
    if (!image) return image.error();
    const auto crop = quadmap::visibleCrop(*image);
    if (!crop)
        return Error{ErrorKind::format,
                     "every alpha is 0, which leaves no map to make; expected a texel above 0"}
            .within(path.string());
    VqInput input;
    input.name = path.filename().string();
    input.texture.image = std::move(*image);
    input.texture.wrapU = input.texture.wrapV = image::Wrap::clampToEdge;
    input.test.cutoff = options.cutoff.value_or(0.5);
    input.test.guard = options.guard;
    input.crop = *crop;
    return input;
}

Result<std::vector<VqInput>> readVqScene(const std::filesystem::path& path, const VqOptions& options,
                                         std::vector<std::string>& notes) {
    const auto document = io::GltfDocument::load(path);
    if (!document) return document.error();
    io::ReadOptions reading;
    reading.micromaps = false;
    const auto scene = io::readScene(*document, reading);
    if (!scene) return scene.error();
    notes.insert(notes.end(), scene->notes.begin(), scene->notes.end());
    std::vector<VqInput> inputs;
    BakeParameters parameters;
    parameters.cutoff = options.cutoff;
    parameters.guard = options.guard;
    for (const PairGroup& group : pairGroups(*scene, parameters))
        inputs.push_back(inputOf(*scene, group, options));
    if (inputs.empty()) notes.push_back(path.filename().string() + ": no masked triangles");
    return inputs;
}

quadmap::Square squareOf(const VqInput& input, const quadmap::SquareMaker& maker, size_t k, unsigned side) {
    if (input.pairs.empty()) return maker.ofCrop(input.crop, side);
    const SquarePair& pair = input.pairs[k];
    return pair.second ? maker.ofPair(pair.first, *pair.second, side) : maker.ofSingle(pair.first, side);
}

Result<std::vector<double>> maskSavings(const VqInput& input, const Executor& executor) {
    const std::vector<SquarePair> pairs =
        input.pairs.empty() ? std::vector{pairOf(input.texture.image, input.crop)} : input.pairs;
    std::vector<mesh::UvTriangle> triangles;
    for (const SquarePair& pair : pairs) {
        triangles.push_back(pair.first);
        if (pair.second) triangles.push_back(*pair.second);
    }
    bake::Settings settings;
    settings.level = 3;
    const auto baked = bake::bake(triangles, input.texture, input.test, settings, executor, silentProgress());
    if (!baked) return baked.error().within(input.name);
    std::vector<double> savings;
    size_t next = 0;
    for (const SquarePair& pair : pairs) {
        double known = knownShare(baked->set, next++);
        if (pair.second) known = (known + knownShare(baked->set, next++)) / 2;
        savings.push_back(known);
    }
    return savings;
}

}  // namespace filigree::jobs
