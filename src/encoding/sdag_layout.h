// Numbers of docs/spec/sdag.md that encoder and decoder share.
#pragma once

#include "filigree/micromap/state.h"
#include "filigree/micromap/symmetry.h"

#include "filigree_lookup.h"

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
inline constexpr unsigned shortCodes = FILIGREE_SDAG_SHORT_CODES;
inline constexpr unsigned escape = FILIGREE_SDAG_ESCAPE;
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
inline constexpr unsigned padding = FILIGREE_SDAG_PAYLOAD_PADDING;
// And behind the descriptors.
inline constexpr unsigned descriptorPadding = FILIGREE_SDAG_DESCRIPTOR_PADDING;

inline constexpr unsigned symmetryBits = 3;

// What stands before the descriptors.
struct Head : filigree_sdag_head {
    Head() : filigree_sdag_head{} {}
    explicit Head(const filigree_sdag_head& head) : filigree_sdag_head(head) {}

    static constexpr size_t bytes = FILIGREE_SDAG_HEAD_BYTES;
    [[nodiscard]] unsigned nodeBytes() const { return 4 + base_bytes; }
    [[nodiscard]] unsigned levelBits() const { return filigree_sdag_level_bits_(levels); }
    [[nodiscard]] unsigned descriptorBits() const { return filigree_sdag_descriptor_bits_(this); }
    [[nodiscard]] uint64_t descriptorBlockBytes(uint32_t mapCount) const {
        return filigree_sdag_descriptor_bytes_(this, mapCount);
    }
};

// Where the parts of a payload begin, in bytes.
using Offsets = filigree_sdag_offsets;
inline Offsets offsetsOf(const Head& head, micromap::Format format) {
    return filigree_sdag_offsets_(&head, static_cast<unsigned>(format));
}

// `to` and `from` hold Head::bytes.
void writeHead(const Head& head, std::span<uint8_t> to);
inline Head readHead(std::span<const uint8_t> from) {
    return Head(filigree_sdag_head_(from.data()));
}

}  // namespace filigree::encoding::sdag
