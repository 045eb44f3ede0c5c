// An encoding whose lookups are timed.
#pragma once

#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/micromap/state.h"

#include "jobs/lookup_queries.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

namespace filigree::jobs {

enum class LookupMode : uint8_t { dependent, independent, batch };
inline constexpr std::array lookupModes{LookupMode::dependent, LookupMode::independent, LookupMode::batch};

constexpr std::string_view nameOf(LookupMode mode) {
    constexpr std::array<std::string_view, 3> names{"dependent", "independent", "batch"};
    return names[static_cast<size_t>(mode)];
}

// How many of `count` points a mode looks up. Dependent lookups have two points to choose from each time.
constexpr size_t lookupsOf(LookupMode mode, size_t count) {
    return mode == LookupMode::dependent ? count / 2 : count;
}

// Which point follows in dependent lookups, after `state` was found by lookup `k`.
constexpr size_t nextPoint(size_t k, micromap::State state) {
    return 2 * (k + 1) + (static_cast<size_t>(state) & 1);
}

class LookupMethod {
  public:
    virtual ~LookupMethod() = default;
    [[nodiscard]] virtual encoding::Encoding encoding() const = 0;

    // Looks up among the first states.size() points and gives the seconds of CPU time; lookup k finds
    // states[k].
    virtual double run(LookupMode mode, std::span<micromap::State> states) const = 0;

    // Whether `found` is what this encoding may hold at point `query` of which the map says `exact`.
    [[nodiscard]] virtual bool agrees(size_t query, micromap::State exact, micromap::State found) const = 0;
};

// Opens a set for lookups at `queries`, which must outlive the method.
Result<std::unique_ptr<LookupMethod>> lookupMethod(encoding::EncodedSet set, const LookupQueries& queries);

}  // namespace filigree::jobs
