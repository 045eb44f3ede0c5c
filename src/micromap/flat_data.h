// Data of flat micromaps, whoever owns the memory.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/micromap/set.h"

#include <cstdint>
#include <span>

namespace filigree::micromap {

// ErrorKind::limit above 4 GiB - 1, the reach of the 32-bit offsets.
Status checkDataBytes(uint64_t bytes);

// Writes the micromaps of `set` to the places of `records`, which recordsOf() gives; they lie inside `to`.
Status writeData(const TreeSet& set, std::span<const Record> records, std::span<uint8_t> to,
                 const Executor& executor, ProgressSink& progress);

}  // namespace filigree::micromap
