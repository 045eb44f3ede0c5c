#include "filigree/encoding/one_bit.h"
#include "filigree/micromap/distinct_trees.h"

#include "jobs/loss.h"
#include "jobs/map_weights.h"

namespace filigree::jobs {
namespace {

using encoding::StatePair;
using micromap::Format;

// Distinct maps in pairs of states, and where each old map went.
struct Paired {
    micromap::QuadtreeList maps;
    std::vector<StatePair> pairs;  // [map_count] of `maps`
    std::vector<int32_t> indices;
};

// Equal maps have equal pairs: only uniform ones could lack a state of theirs.
Paired toPairs(const micromap::QuadtreeList& maps) {
    Paired result;
    micromap::DistinctTrees distinct;
    for (size_t k = 0; k < maps.size(); ++k) {
        const StatePair pair = encoding::bestPair(maps[k]);
        const int32_t place = distinct.add(encoding::inPair(maps[k], pair).view());
        if (place == static_cast<int32_t>(result.pairs.size())) result.pairs.push_back(pair);
        result.indices.push_back(place);
    }
    result.maps = std::move(distinct).take();
    return result;
}

double knownShare(const MapWeights& weights, const micromap::QuadtreeList& maps) {
    return weights.total > 0 ? 1 - weights.unknown(maps) / weights.total : 1;
}

uint64_t bytesOf(const encoding::EncodedSet& set) {
    return set.descriptors.size() + set.payload.size();
}

// Bytes of the maps in `format`, equal ones once.
Result<uint64_t> bytesIn(Format format, const SceneMaps& maps, const LossyTarget& target,
                         const Executor& executor) {
    micromap::DistinctTrees distinct;
    for (size_t k = 0; k < maps.maps.size(); ++k) {
        if (format == Format::fourState) {
            distinct.add(maps.maps[k]);
        } else {
            distinct.add(encoding::fromPair(maps.maps[k], StatePair::transparentOpaque).view());
        }
    }
    SceneMaps own;
    own.maps = std::move(distinct).take();
    const auto set = encoding::encode(target.encoding, own.views(), format, target.options, executor);
    if (!set) return set.error();
    return bytesOf(*set);
}

}  // namespace

Result<OneBitSet> encodeOneBit(const scene::Scene& scene, SceneMaps& maps, const LossyTarget& target,
                               const Executor& executor, OneBitSummary& summary) {
    if (maps.format != Format::fourState)
        return Error{ErrorKind::usage, "--one-bit: takes 4-state micromaps, these are 2-state"};
    for (const Format format : {Format::twoState, Format::fourState}) {
        const auto bytes = bytesIn(format, maps, target, executor);
        if (!bytes) return bytes.error();
        (format == Format::twoState ? summary.twoStateBytes : summary.fourStateBytes) = *bytes;
    }
    summary.fourStateKnownShare = knownShare(weightsOf(scene, maps), maps.maps);

    Paired paired = toPairs(maps.maps);
    replaceMaps(maps, std::move(paired.maps), paired.indices);
    auto set = encoding::encode(target.encoding, maps.views(), Format::twoState, target.options, executor);
    if (!set) return set.error();
    OneBitSet result{std::move(*set), encoding::packPairs(paired.pairs)};
    for (const StatePair pair : paired.pairs) ++summary.maps[static_cast<size_t>(pair)];
    summary.pairBytes = result.pairs.size();
    summary.bytes = bytesOf(result.set) + summary.pairBytes;
    summary.knownShare = knownShare(weightsOf(scene, maps), maps.maps);
    return result;
}

}  // namespace filigree::jobs
