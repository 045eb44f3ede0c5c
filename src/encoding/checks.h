// Checks that several encodings share.
#pragma once

#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"

#include "filigree_lookup.h"

#include <cassert>
#include <cstdint>

#include <fmt/format.h>

namespace filigree::encoding {

template <class... Arguments>
Error formatError(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    return {ErrorKind::format, fmt::format(text, std::forward<Arguments>(arguments)...)};
}

// The view that lookups go through, of a set that has been checked.
template <class View, class Open>
View openedAs(Open open, const EncodedView& set) {
    View view;
    [[maybe_unused]] const auto error =
        open(&view, static_cast<unsigned>(set.format), set.mapCount, set.descriptors.data(),
             set.descriptors.size(), set.payload.data(), set.payload.size());
    assert(error == FILIGREE_LOOKUP_OK);
    return view;
}

// The descriptors are `bytesPerMap` bytes for each map.
inline Status checkDescriptorBytes(const EncodedView& set, uint64_t bytesPerMap) {
    const uint64_t expected = bytesPerMap * set.mapCount;
    if (set.descriptors.size() == expected) return {};
    return formatError("descriptors: {} bytes, expected {} for {} maps", set.descriptors.size(), expected,
                       set.mapCount);
}

// 32-bit byte offsets reach all of a payload.
inline Status checkOffsetsReach(Encoding encoding, uint64_t payloadBytes) {
    if (payloadBytes <= UINT32_MAX) return {};
    return Error{ErrorKind::limit,
                 fmt::format("{}: the micromaps take {} bytes, its offsets reach {}: choose "
                             "a lower level or another encoding",
                             nameOf(encoding), payloadBytes, UINT32_MAX)};
}

}  // namespace filigree::encoding
