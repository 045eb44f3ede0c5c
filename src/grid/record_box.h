// The box around one record.
#pragma once

#include "filigree/core/box.h"

#include "grid/record_spans.h"

#include <cstddef>

namespace filigree::grid {

// Of record `k`, which is sound.
Box boxOfRecord(const EncodedGrids& grids, const RecordSpans& spans, size_t k);

}  // namespace filigree::grid
