// Batches in parts that stay in the first cache between their check and their work.
#pragma once

#include <algorithm>
#include <cstddef>

namespace filigree::capi {

inline constexpr size_t partSize = 1024;

// Calls some(first, count) for the parts of a batch in turn.
template <class Some>
void inParts(size_t count, Some&& some) {
    for (size_t first = 0; first < count; first += partSize) some(first, std::min(partSize, count - first));
}

}  // namespace filigree::capi
