#include "filigree/core/target.h"

#include <array>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>
#include <hwy/targets.h>

namespace filigree {
namespace {

constexpr std::array<std::pair<std::string_view, int64_t>, 4> targets{{
    {"scalar", HWY_EMU128},
    {"sse4", HWY_SSE4},
    {"avx2", HWY_AVX2},
    {"avx3", HWY_AVX3},
}};

}  // namespace

Status forceTarget(std::string_view name) {
    hwy::SetSupportedTargetsForTest(0);
    if (name == "best") return {};
    for (const auto& [known, bit] : targets) {
        if (name != known) continue;
        if (bit != HWY_EMU128 && (hwy::SupportedTargets() & bit) == 0) {
            return Error{ErrorKind::unsupported, fmt::format("target {}: this processor lacks it", name)};
        }
        hwy::SetSupportedTargetsForTest(bit);
        return {};
    }
    return Error{ErrorKind::usage,
                 fmt::format("target \"{}\" is unknown; choose scalar, sse4, avx2, avx3 or best", name)};
}

Status forceTargetFromEnvironment() {
    const char* name = std::getenv("FILIGREE_TARGET");
    return name != nullptr && *name != '\0' ? forceTarget(name) : Status{};
}

std::string currentTarget() {
    const int64_t best = hwy::SupportedTargets();
    return hwy::TargetName(best & -best);
}

}  // namespace filigree
