// Numbers of docs/spec/sdag.md that encoder and decoder share.
#pragma once

#include "filigree/micromap/state.h"
#include "filigree/micromap/symmetry.h"

#include <array>
#include <cstdint>
#include <span>

namespace filigree::encoding::sdag {

// Heights of roots and nodes are even; a micromap of level L hangs under a root of height rootHeight(L),
// behind digits 0 where L is lower.
inline constexpr unsigned leafHeight = 4;
inline constexpr unsigned nodeHeights = 4;  // 6, 8, 10, 12
constexpr unsigned rootHeight(unsigned level) {
    return level <= leafHeight ? leafHeight : (level + 1) / 2 * 2;
}
constexpr unsigned heightSlot(unsigned height) {
    return height / 2 - 3;
}

// Which of its 16 grandchildren a digit pair names: bits a a b b, the upper digit first in each pair.
constexpr unsigned grandchild(unsigned upperDigit, unsigned lowerDigit) {
    return ((upperDigit >> 1) << 3) | ((lowerDigit >> 1) << 2) | ((upperDigit & 1) << 1) | (lowerDigit & 1);
}

// Codes below `shortCodes` take one byte, those up to `codeLimit` two; 255 escapes.
inline constexpr unsigned shortCodes = 192;
inline constexpr unsigned escape = 255;
inline constexpr unsigned codeLimit = shortCodes + (escape - shortCodes) * 256;
// After an escaped head: what follows.
inline constexpr unsigned explicitHead = 0;
inline constexpr unsigned rawLeaf = 1;

constexpr unsigned codeBytes(uint32_t code) {
    return code < shortCodes ? 1 : 2;
}
constexpr unsigned firstByte(uint32_t code) {
    return code < shortCodes ? code : shortCodes + ((code - shortCodes) >> 8);
}
constexpr unsigned secondByte(uint32_t code) {
    return (code - shortCodes) & 255;
}

// Bytes of one pattern of 16 states.
constexpr unsigned patternBytes(micromap::Format format) {
    return 2 * micromap::bitsPerState(format);
}

// Zero bytes behind the blocks, so that lookups may load ahead.
inline constexpr unsigned padding = 16;
// And behind the descriptors.
inline constexpr unsigned descriptorPadding = 8;

inline constexpr unsigned symmetryBits = 3;

// What stands before the descriptors.
struct Head {
    bool shares = false;         // opaque shares of nodes are stored
    bool flatMaps = false;       // some maps are stored flat
    unsigned baseBytes = 0;      // of a node's base, 0..4
    unsigned referenceBits = 0;  // of a reference to a shared leaf, 0..32
    unsigned valueBits = 0;      // of a descriptor's value, 0..32
    uint32_t levels = 0;         // bit L: some map has level L
    uint32_t patterns = 0;
    uint32_t heads = 0;
    std::array<uint32_t, nodeHeights> nodes{};
    uint32_t sharedBytes = 0;
    uint32_t blockBytes = 0;
    uint64_t flatBytes = 0;

    static constexpr size_t bytes = 48;
    [[nodiscard]] uint64_t nodeCount() const;
    [[nodiscard]] unsigned nodeBytes() const { return 4 + baseBytes; }
    // True when some map is not stored flat.
    [[nodiscard]] bool hasLeaves() const { return sharedBytes > 0 || blockBytes > 0 || nodeCount() > 0; }
    [[nodiscard]] unsigned levelBits() const;
    [[nodiscard]] unsigned descriptorBits() const {
        return levelBits() + (flatMaps ? 1 : 0) + symmetryBits + valueBits;
    }
    [[nodiscard]] uint64_t descriptorBlockBytes(uint32_t mapCount) const;
};

// Where the parts of a payload begin, in bytes.
struct Offsets {
    uint64_t patterns = 0;
    uint64_t heads = 0;
    std::array<uint64_t, nodeHeights> nodes{};
    uint64_t shares = 0;
    uint64_t shared = 0;
    uint64_t blocks = 0;
    uint64_t padding = 0;
    uint64_t flat = 0;
    uint64_t end = 0;
};
Offsets offsetsOf(const Head& head, micromap::Format format);

// `to` and `from` hold Head::bytes.
void writeHead(const Head& head, std::span<uint8_t> to);
Head readHead(std::span<const uint8_t> from);

}  // namespace filigree::encoding::sdag
