// What the tests of filigree_lookup.h share.
#pragma once

#include "filigree/encoding/encoded_set.h"

#include "lookup/functions.h"

#include <array>

namespace filigree::tests {

inline std::array<const lookup_functions*, 3> lookupCompilers() {
    return {lookup_functions_c99(), lookup_functions_portable(), lookup_functions_cxx11()};
}

// What view_open() says of a set.
inline filigree_lookup_error openView(const lookup_functions& lookup, filigree_view& view,
                                      const encoding::EncodedView& set) {
    return lookup.view_open(&view, static_cast<unsigned>(set.encoding), static_cast<unsigned>(set.format),
                            set.mapCount, set.descriptors.data(), set.descriptors.size(), set.payload.data(),
                            set.payload.size());
}

}  // namespace filigree::tests
