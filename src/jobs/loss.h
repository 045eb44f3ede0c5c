// Encodes a scene's micromaps with a loss that the user allows.
#pragma once

#include "filigree/encoding/encode.h"
#include "filigree/jobs/loss.h"
#include "filigree/scene/scene.h"

#include "jobs/scene_maps.h"

#include <string>
#include <vector>

namespace filigree::jobs {

// How a scene's maps are to be encoded.
struct LossyTarget {
    encoding::Encoding encoding;
    micromap::Format format;
    encoding::EncodeOptions options;
};

// ErrorKind::usage, naming the option, when options are out of range, contradict each other or the encoding.
Status check(const LossOptions& options, encoding::Encoding encoding);

// Prunes `maps` (encoding::encodeLossy); they are what the set holds from then on. `options` ask for it.
// ErrorKind::usage when they are not for maps of this format.
Result<encoding::EncodedSet> encodeWithLoss(const scene::Scene& scene, SceneMaps& maps,
                                            const LossyTarget& target, const LossOptions& options,
                                            const Executor& executor, ProgressSink& progress,
                                            LossySummary& summary);

struct OneBitSet {
    encoding::EncodedSet set;
    std::vector<uint8_t> pairs;
};

// Turns 4-state `maps` to pairs of states; they are what the set and its pairs mean from then on.
// ErrorKind::usage when they are 2-state.
Result<OneBitSet> encodeOneBit(const scene::Scene& scene, SceneMaps& maps, const LossyTarget& target,
                               const Executor& executor, OneBitSummary& summary);

}  // namespace filigree::jobs
