#include "encoding/lossy_prune.h"

#include "encoding/lossy_graph.h"
#include "encoding/lossy_orient.h"
#include "encoding/lossy_tree.h"

#include <algorithm>

namespace filigree::encoding {
namespace {

constexpr double recordBits = 64;  // a descriptor of flat, gruen and the trees
constexpr double paddingBits = 7;  // of the two strings of a tree, half a byte each

RateModel flatModel(micromap::Format format) {
    RateModel model;
    for (unsigned level = 0; level <= micromap::maxLevel; ++level)
        model.mapBits[level] = recordBits + 8 * static_cast<double>(micromap::flatBytes(level, format));
    return model;
}

// One bit of structure a node, a state a leaf, and with a directory 16 bits for every 64th leaf.
RateModel treeModel(micromap::Format format, bool indexed) {
    RateModel model;
    model.innerBits.fill(1);
    model.leafBits = 1 + micromap::bitsPerState(format) + (indexed ? 16.0 / 64 : 0);
    model.mapBits.fill(recordBits + paddingBits);
    return model;
}

// Both encodings store two levels of a quadtree in one node, from height 4 up, and what is below in a leaf of
// height 4. A map whose own height is not among these has a node to itself.
constexpr unsigned leafHeight = 4;
// Inner nodes that are only a part of a stored one count so much of it: what is simpler there is shared more
// often and has shorter codes. 1/50 to 1/16 did best on scenes.
constexpr double insideShare = 1.0 / 32;
constexpr bool isStoredHeight(unsigned height) {
    return height >= leafHeight && height % 2 == 0;
}

double evenly(size_t bytes, uint64_t count) {
    return count > 0 ? 8.0 * static_cast<double>(bytes) / static_cast<double>(count) : 0;
}

// The payload evenly over the nodes that are stored, the descriptors evenly over the maps.
RateModel mergedModel(std::span<const WeightedMap> maps, const SubtreeGraph& graph,
                      const EncodedSet& lossless) {
    const auto nodes = graph.nodes().subspan(SubtreeGraph::stateCount);
    const auto stored = std::ranges::count_if(
        nodes, [](const SubtreeGraph::Node& node) { return isStoredHeight(node.height); });
    const auto oddRoots =
        std::ranges::count_if(maps, [](const WeightedMap& map) { return !isStoredHeight(map.tree.level); });
    RateModel model;
    const double nodeBits = evenly(lossless.payload.size(), static_cast<uint64_t>(stored + oddRoots));
    const double descriptorBits = evenly(lossless.descriptors.size(), lossless.mapCount);
    for (unsigned height = 0; height <= micromap::maxLevel; ++height) {
        const bool isStored = isStoredHeight(height);
        model.innerBits[height] = isStored ? nodeBits : nodeBits * insideShare;
        model.mapBits[height] = descriptorBits + (isStored ? 0 : nodeBits);
    }
    return model;
}

std::unique_ptr<Pruner> makeMergedPruner(std::span<const WeightedMap> maps, const EncodedSet& lossless,
                                         micromap::Format format) {
    SubtreeGraph graph(maps);
    const RateModel model = mergedModel(maps, graph, lossless);
    return makeGraphPruner(maps, std::move(graph), format, model);
}

}  // namespace

std::unique_ptr<Pruner> makePruner(std::span<const WeightedMap> maps, const EncodedSet& lossless,
                                   micromap::Format format) {
    switch (lossless.encoding) {
        case Encoding::tree:
        case Encoding::indexedTree:
            return makeTreePruner(maps, format,
                                  treeModel(lossless.format, lossless.encoding == Encoding::indexedTree));
        case Encoding::dag:
            return makeMergedPruner(maps, lossless, format);
        case Encoding::sdag:
            return makeOrientedPruner(maps, [&](std::span<const WeightedMap> oriented) {
                return makeMergedPruner(oriented, lossless, format);
            });
        default:
            return makeTreePruner(maps, format, flatModel(lossless.format));
    }
}

}  // namespace filigree::encoding
