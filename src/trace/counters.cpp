#include "filigree/trace/counters.h"

namespace filigree::trace {

std::string_view nameOf(RayKind kind) {
    constexpr std::array<std::string_view, rayKindCount> names{"primary", "shadow", "ao", "bounce"};
    return names[static_cast<size_t>(kind)];
}

}  // namespace filigree::trace
