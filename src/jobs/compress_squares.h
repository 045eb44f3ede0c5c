// compress for opacity squares.
#pragma once

#include "filigree/jobs/compress.h"
#include "filigree/quadmap/reader.h"

namespace filigree::jobs {

// As compress(), for an encoding of squares. Parameters of micromaps are refused.
Result<CompressSummary> compressSquares(const CompressOptions& options, quadmap::SquareFormat format,
                                        const Executor& executor, ProgressSink& progress);

}  // namespace filigree::jobs
