// The two blocks of an encoded set (docs/spec/), as words. Each needs two words of any value behind its last byte.
#ifndef FILIGREE_DECODE_BLOCKS
#define FILIGREE_DECODE_BLOCKS

layout(set = 0, binding = 0) readonly buffer Descriptors { uint descriptorWords[]; };
layout(set = 0, binding = 1) readonly buffer Payload { uint payloadWords[]; };

// Log2 of the bits of a state: 0 for two states, 1 for four.
layout(constant_id = 0) const uint widthShift = 1;

// The lowest `count` bits, 0 to 32.
uint lowBits(uint bits, uint count) {
    return count >= 32u ? bits : bits & ((1u << count) - 1u);
}
// 32 bits of `high` and `low` together, from bit `shift` of `low` up, 0 to 31.
uint funnelShift(uint low, uint high, uint shift) {
    return shift == 0u ? low : (low >> shift) | (high << (32u - shift));
}

uint descriptorBits(uint bit, uint count) {
    const uint word = bit >> 5;
    return lowBits(funnelShift(descriptorWords[word], descriptorWords[word + 1u], bit & 31u), count);
}
// `count` bits, 0 to 32, from a bit behind a byte.
uint payloadBits(uint byte, uint bit, uint count) {
    byte += bit >> 3;
    const uint word = byte >> 2;
    const uint shift = 8u * (byte & 3u) + (bit & 7u);
    return lowBits(funnelShift(payloadWords[word], payloadWords[word + 1u], shift), count);
}
uint payloadByte(uint byte) {
    return (payloadWords[byte >> 2] >> (8u * (byte & 3u))) & 255u;
}
// State `index` of those that begin at a byte, least significant bits first.
uint payloadState(uint byte, uint index) {
    const uint bit = index << widthShift;
    return (payloadByte(byte + (bit >> 3)) >> (bit & 7u)) & (widthShift == 0u ? 1u : 3u);
}

// How many bits of `mask` are set below `child`, 0 to 31.
uint rankOf(uint mask, uint child) {
    return uint(bitCount(mask & ((1u << child) - 1u)));
}

#endif
