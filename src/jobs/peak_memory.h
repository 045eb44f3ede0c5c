// How much memory the process has held.
#pragma once

#include <cstdint>

namespace filigree::jobs {

// The most bytes of this process that were resident at once so far; 0 where the system does not say.
uint64_t peakMemory();

}  // namespace filigree::jobs
