// Lookups by the shaders of shaders/decode, to compare them with the readers of the CPU.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/result.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/micromap/state.h"
#include "filigree/quadmap/reader.h"
#include "filigree/vulkan/device.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::vulkan {

// The states of maps[k], below set.mapCount, at (u[k], v[k]): barycentrics, or texture coordinates in a
// bitmask. All spans have one length. The set is checked first; ErrorKind::limit where it does not fit the
// device.
FILIGREE_API Result<std::vector<micromap::State>> lookup(const Device& device,
                                                         const encoding::EncodedView& set,
                                                         std::span<const uint32_t> maps,
                                                         std::span<const float> u, std::span<const float> v);

// The regions of maps[k], below squares.mapCount(), at weights u[k] and v[k] of vertices 1 and 2 of
// halves[k]. ErrorKind::unsupported for the raw formats, which have no shader.
FILIGREE_API Result<std::vector<quadmap::Region>> lookup(const Device& device,
                                                         const quadmap::SquareReader& squares,
                                                         std::span<const uint32_t> maps,
                                                         std::span<const quadmap::Half> halves,
                                                         std::span<const float> u, std::span<const float> v);

}  // namespace filigree::vulkan
