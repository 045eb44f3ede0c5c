// Which parts of micromaps become one leaf when bits have a price.
#pragma once

#include "filigree/encoding/lossy.h"

#include <array>
#include <memory>

namespace filigree::encoding {

// What an encoding takes, as a sum over the nodes of quadtrees.
struct RateModel {
    // Of an inner node, by its height: the levels below it.
    std::array<double, micromap::maxLevel + 1> innerBits{};
    double leafBits = 0;  // of a leaf, but none of a map that is one: that is a special index
    // Of a map that is not uniform, beside its nodes, by its level.
    std::array<double, micromap::maxLevel + 1> mapBits{};
};

struct PrunedMaps {
    std::vector<micromap::Quadtree> maps;
    double cost = 0;  // as LossyPoint::cost
};

// Prunes the same maps at one price after another.
class Pruner {
  public:
    virtual ~Pruner() = default;

    // At `price` bits for a unit of cost, 0..infinity; at infinity only what costs nothing.
    [[nodiscard]] virtual PrunedMaps prune(double price, const Executor& executor) const = 0;
};

// Looks into `maps` from then on. `lossless` is their set, to which the model is fitted. With `format`
// 4-state parts become unknown, with 2-state one side.
std::unique_ptr<Pruner> makePruner(std::span<const WeightedMap> maps, const EncodedSet& lossless,
                                   micromap::Format format);

}  // namespace filigree::encoding
