// The handle of distinct micromaps.
#pragma once

#include "filigree/bake/bake.h"
#include "filigree/micromap/set.h"

#include "capi/failure.h"
#include "capi/memory.h"
#include "capi/trees.h"
#include "filigree.h"

#include <cstdint>
#include <string_view>

struct filigree_micromaps {
    filigree::capi::Memory memory;
    filigree::micromap::Format format = filigree::micromap::Format::fourState;
    filigree::capi::Trees trees;
    filigree::capi::Array<int32_t> indices;    // [triangle_count]
    filigree::capi::Array<uint8_t> levels;     // [triangle_count], or empty
    filigree::capi::Array<uint8_t> rotations;  // the same
    filigree::bake::Statistics statistics;
};

namespace filigree::capi {

inline micromap::Format formatOf(uint32_t states, std::string_view name) {
    if (states == 2) return micromap::Format::twoState;
    if (states != 4) fail(FILIGREE_ERROR_ARGUMENT, "{}: is {}, expected 2 or 4", name, states);
    return micromap::Format::fourState;
}
inline uint32_t statesOf(micromap::Format format) {
    return format == micromap::Format::twoState ? 2 : 4;
}

}  // namespace filigree::capi
