// Every encoding on the squares of one texture.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/result.h"
#include "filigree/jobs/vq.h"

#include "jobs/vq_encoders.h"
#include "jobs/vq_maps.h"

#include <optional>
#include <vector>

namespace filigree::jobs {

// One map: what a picture shows of it.
struct VqMap {
    quadmap::Square source16;
    quadmap::Square source32;
    PerMeasure<std::optional<VqResult>> results;  // of encoders
    VqTotals totals;                              // of this map
};

// The combinations that the best encoders chose, one a map.
struct ChosenTransforms {
    std::vector<unsigned> vq2;
    std::vector<unsigned> vq4;
};

struct VqMeasured {
    VqTexture texture;
    ChosenTransforms transforms;
    VqMap first;  // of the maps
};

quadmap::Prefer preferOf(const VqOptions& options);

// ErrorKind::cancelled when `progress` says so; advances it by one for each map.
Result<VqMeasured> measure(const VqInput& input, const VqOptions& options, const Executor& executor,
                           ProgressSink& progress);

TransformUse transformUseOf(const std::vector<unsigned>& chosen);

}  // namespace filigree::jobs
