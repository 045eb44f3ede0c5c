// Compressed grids with the hierarchy over them: all that is resident while rays are traced.
#pragma once

#include "filigree/bvh/node.h"
#include "filigree/core/api.h"
#include "filigree/grid/lattice.h"
#include "filigree/grid/paper.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace filigree::grid {

// How the records of grids are written.
enum class Codec : uint8_t {
    paper,    // 128-byte sub-grids of 5 x 5 vertices (docs/spec/paper.md)
    lattice,  // tiles of up to 16 x 16 quads (docs/spec/lattice.md)
};
// The name that the command line takes, and the way back.
FILIGREE_API std::string_view nameOf(Codec codec);
FILIGREE_API std::optional<Codec> codecNamed(std::string_view name);

// A leaf of the hierarchy is one record: a sub-grid or a tile, after the codec, or a cluster of loose
// triangles (docs/spec/cluster.md). Records stand in the order of the leaves.
struct EncodedGrids {
    Codec codec = Codec::lattice;
    Lattice lattice;  // of tiles and clusters
    PaperCode paper;  // of sub-grids
    std::vector<bvh::Node>
        nodes;  // the first is the root; boxes in lattice coordinates; paper: in world units
    // [leaf_count], where each record begins, in units of 8 bytes; the top bit marks a cluster. Empty where
    // leaf k is the sub-grid at byte 128 k.
    std::vector<uint32_t> offsets;
    std::vector<uint8_t> records;  // and then recordSlack zeros, so that wide loads stay inside

    static constexpr size_t recordUnit = 8;
    static constexpr size_t recordSlack = 64;
    static constexpr uint32_t clusterBit = 0x80000000;

    [[nodiscard]] uint64_t leafCount() const {
        return offsets.empty() ? (records.size() - recordSlack) / 128 : offsets.size();
    }
};

}  // namespace filigree::grid
