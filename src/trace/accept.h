// What becomes of a candidate hit once its state is known.
#pragma once

#include "filigree/micromap/state.h"

#include "trace/filter.h"
#include "trace/opacity_data.h"

#include <cstdint>

namespace filigree::trace {

// Of a surface that a method knows nothing of: every candidate is unknown.
inline constexpr uint32_t noIndices = ~0u;

// No state decided: aside with it, or the texture does.
inline bool acceptUnknown(RayContext& context, const Candidate& candidate) {
    ++context.counts->unknown;
    if (context.deferred != nullptr && context.deferred->push(candidate)) return false;
    return fetchAccepts(context, candidate);
}

inline bool acceptState(RayContext& context, const Opacity::Data& opacity, const Candidate& candidate,
                        micromap::State state) {
    if (micromap::isKnown(state) || opacity.states == 2 || context.twoState)
        return micromap::isOpaqueSide(state);
    return acceptUnknown(context, candidate);
}

}  // namespace filigree::trace
