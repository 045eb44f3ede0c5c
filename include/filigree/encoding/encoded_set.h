// Sets of micromaps in one of the encodings, as the bytes that stay in memory while rays are traced.
#pragma once

#include "filigree/core/api.h"
#include "filigree/micromap/state.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace filigree::encoding {

// One page of docs/spec/ each. The numbers are those of the container file.
enum class Encoding : uint8_t {
    flat = 0,         // as the APIs take them
    gruen = 1,        // masks in row order (Gruen, Benthin and Woop 2020)
    bitmask = 2,      // states of the texture's cells, not of triangles (Waldemarson and Doggett 2024, 5)
    tree = 3,         // succinct quadtrees, found by scanning (Waldemarson and Doggett 2024, 4)
    indexedTree = 4,  // the same with a rank directory
    dag = 5,          // merged subtrees (Chernaik, Modisett and Billeter 2026)
    sdag = 6,         // merged subtrees, our layout
};
inline constexpr unsigned encodingCount = 7;

// The name that the command line takes, and the way back.
FILIGREE_API std::string_view nameOf(Encoding encoding);
FILIGREE_API std::optional<Encoding> encodingNamed(std::string_view name);

// Distinct micromaps, or with Encoding::bitmask textures. Every byte that a lookup needs is in one of the two
// blocks; both are little-endian and may be mapped from a file at any address.
struct EncodedSet {
    Encoding encoding = Encoding::flat;
    micromap::Format format = micromap::Format::fourState;
    uint32_t mapCount = 0;
    std::vector<uint8_t> descriptors;  // what is stored once for each map
    std::vector<uint8_t> payload;      // all else
};

// The same, in memory of somebody else.
struct EncodedView {
    Encoding encoding = Encoding::flat;
    micromap::Format format = micromap::Format::fourState;
    uint32_t mapCount = 0;
    std::span<const uint8_t> descriptors;
    std::span<const uint8_t> payload;
};

// Looks into `set`, which must outlive it.
inline EncodedView viewOf(const EncodedSet& set) {
    return {set.encoding, set.format, set.mapCount, set.descriptors, set.payload};
}

// What a number of bits is spent on. The parts of a set add up to its bytes, padding included.
struct Part {
    std::string_view name;
    uint64_t bits = 0;
};

}  // namespace filigree::encoding
