// The handle of an encoded set.
#pragma once

#include "filigree/encoding/bitmask.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/encoding/map_reader.h"

#include "capi/memory.h"
#include "filigree.h"

#include <cstdint>
#include <memory>
#include <optional>

struct filigree_set {
    filigree::capi::Memory memory;
    filigree::capi::Array<uint8_t> descriptors;  // empty where the blocks are the caller's
    filigree::capi::Array<uint8_t> payload;
    filigree::encoding::EncodedView view;
    std::unique_ptr<filigree::encoding::MapReader> maps;        // but for a bitmask
    std::optional<filigree::encoding::BitmaskReader> textures;  // of a bitmask
    filigree::capi::Array<uint8_t> levels;                      // [map_count], but for a bitmask
    std::optional<unsigned> level;                              // of all maps; none where they differ
    filigree::capi::Array<int32_t> indices;                     // [triangle_count]
    filigree::capi::Array<filigree_primitive> primitives;       // that these belong to
};

namespace filigree::capi {

// A set that owns a copy of the blocks, resp. looks into them, open for lookups.
Owned<filigree_set> ownedSet(const Memory& memory, const encoding::EncodedView& blocks);
Owned<filigree_set> borrowedSet(const Memory& memory, const encoding::EncodedView& blocks);

}  // namespace filigree::capi
