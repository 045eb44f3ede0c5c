// Encoding `sdag`: parts that are equal up to the triangle's symmetries once, in short codes. docs/spec/sdag.md.
#include "blocks.glsl"
#include "curve.glsl"

// The head of the descriptors, and where the parts of the payload begin, in bytes.
struct SdagLayout {
    uint levels;
    uint levelBits;
    uint flatBit;
    uint valueBits;
    uint baseBytes;
    uint referenceBits;
    uint headsAt;
    uint nodesAt[4];  // of heights 6, 8, 10, 12
    uint sharedAt;
    uint blocksAt;
    uint flatAt;
};

SdagLayout sdagLayout() {
    SdagLayout layout_;
    const uint flags = descriptorWords[0];
    layout_.baseBytes = (flags >> 8) & 255u;
    layout_.referenceBits = (flags >> 16) & 255u;
    layout_.valueBits = flags >> 24;
    layout_.flatBit = (flags >> 1) & 1u;
    layout_.levels = descriptorWords[1];
    layout_.levelBits = uint(findMSB(uint(bitCount(layout_.levels)) - 1u) + 1);
    layout_.headsAt = descriptorWords[2] << (widthShift + 1u);
    uint next = layout_.headsAt + 4u * descriptorWords[3];
    uint nodes = 0u;
    for (uint slot = 0u; slot < 4u; ++slot) {
        layout_.nodesAt[slot] = next;
        next += descriptorWords[4u + slot] * (4u + layout_.baseBytes);
        nodes += descriptorWords[4u + slot];
    }
    layout_.sharedAt = next + 2u * nodes * (flags & 1u);
    layout_.blocksAt = layout_.sharedAt + descriptorWords[8];
    const uint padding = nodes + descriptorWords[8] + descriptorWords[9] > 0u ? 16u : 0u;
    layout_.flatAt = layout_.blocksAt + descriptorWords[9] + padding;
    return layout_;
}

// A map's descriptor.
struct SdagMap {
    uint level;
    bool isFlat;
    uint symmetry;
    uint value;
};

SdagMap sdagMap(SdagLayout layout_, uint map) {
    uint bit = 384u + map * (layout_.levelBits + layout_.flatBit + 3u + layout_.valueBits);
    uint levels = layout_.levels;
    for (uint number = descriptorBits(bit, layout_.levelBits); number > 0u; --number) levels &= levels - 1u;
    bit += layout_.levelBits;
    const bool isFlat = descriptorBits(bit, layout_.flatBit) != 0u;
    bit += layout_.flatBit;
    return SdagMap(uint(findLSB(levels)), isFlat, descriptorBits(bit, 3u),
                   descriptorBits(bit + 3u, layout_.valueBits));
}

// A place: the bits a and b of the digits of all levels, turned by a symmetry.
uvec2 sdagPlanes(float u, float v, uint level, uint symmetry) {
    const CurveCoordinates at = curveCoordinates(u, v, level);
    const uvec2 planes = uvec2(at.u ^ at.w, at.v ^ at.w) & ((1u << level) - 1u);
    const uint matrix = 0xe7bd69u >> (4u * symmetry);
    const uvec4 picks = uvec4(0u) - ((uvec4(matrix) >> uvec4(0u, 1u, 2u, 3u)) & 1u);
    return (planes.xx & picks.xz) ^ (planes.yy & picks.yw);
}
// Which grandchild holds a place, from bits `low` and `low` + 1.
uint grandchildAt(uvec2 planes, uint low) {
    return (((planes.x >> low) & 3u) << 2) | ((planes.y >> low) & 3u);
}

// The byte of the leaf under mixed child `child` of a node of height 6.
uint leafUnder(SdagLayout layout_, uint head, uint base, uint child) {
    const uint block = layout_.blocksAt + base;
    const uint mixed = head & 0xffffu;
    const uint sharedOnes = mixed & (head >> 16);
    const uint bit = 8u * rankOf(mixed & ~sharedOnes, child) + layout_.referenceBits * rankOf(sharedOnes, child);
    if (((sharedOnes >> child) & 1u) == 0u) return block + payloadBits(block, bit, 8u);
    return layout_.sharedAt + payloadBits(block, bit, layout_.referenceBits);
}

uint tablePattern(uint code) {
    return payloadBits(code << (widthShift + 1u), 0u, 16u << widthShift);
}

// The pattern of the mixed child of a rank, from the codes of all `count` mixed children.
uint codedPattern(uint codes, uint count, uint rank) {
    const uint code = payloadByte(codes + rank);
    if (code < 192u) return tablePattern(code);
    uint longBefore = 0u;
    uint longOnes = 0u;
    uint escapesBefore = 0u;
    for (uint k = 0u; k < count; ++k) {
        const uint other = payloadByte(codes + k);
        longOnes += other >= 192u ? 1u : 0u;
        longBefore += other >= 192u && k < rank ? 1u : 0u;
        escapesBefore += other == 255u && k < rank ? 1u : 0u;
    }
    const uint second = payloadByte(codes + count + longBefore);
    if (code != 255u) return tablePattern(192u + ((code - 192u) << 8) + second);
    const uint restBytes = widthShift == 0u ? 1u : 3u;
    const uint rest = codes + count + longOnes + restBytes * escapesBefore;
    return second | (payloadBits(rest, 0u, 8u * restBytes) << 8);
}

uint stateInPattern(uint pattern, uvec2 planes) {
    return lowBits(pattern >> (grandchildAt(planes, 0u) << widthShift), 1u << widthShift);
}

uint stateInLeaf(SdagLayout layout_, uint leaf, uvec2 planes) {
    const uint first = payloadByte(leaf);
    const uint second = payloadByte(leaf + 1u);
    const uint child = grandchildAt(planes, 2u);
    if (first == 255u && second == 1u) {
        const uint raw = leaf + 2u + (child << (widthShift + 1u));
        return stateInPattern(payloadBits(raw, 0u, 16u << widthShift), planes);
    }
    const uint code = first < 192u ? first : 192u + ((first - 192u) << 8) + second;
    const uint head = payloadBits(first == 255u ? leaf + 2u : layout_.headsAt + 4u * code, 0u, 32u);
    if (((head >> child) & 1u) == 0u) return (head >> (16u + child)) & 1u;
    const uint codes = leaf + (first == 255u ? 6u : first < 192u ? 1u : 2u);
    const uint mixed = head & 0xffffu;
    return stateInPattern(codedPattern(codes, uint(bitCount(mixed)), rankOf(mixed, child)), planes);
}

// From the root down to a leaf or to what is known.
uint stateUnder(SdagLayout layout_, SdagMap map, uvec2 planes) {
    if (map.level <= 4u) return stateInLeaf(layout_, layout_.sharedAt + map.value, planes);
    uint number = map.value;
    uint leaf = 0u;
    for (uint height = (map.level + 1u) & ~1u; height >= 6u; height -= 2u) {
        const uint node = layout_.nodesAt[height / 2u - 3u] + number * (4u + layout_.baseBytes);
        const uint head = payloadBits(node, 0u, 32u);
        const uint child = grandchildAt(planes, height - 2u);
        if (((head >> child) & 1u) == 0u) return (head >> (16u + child)) & 1u;
        const uint base = payloadBits(node + 4u, 0u, 8u * layout_.baseBytes);
        number = base + rankOf(head & 0xffffu, child);
        if (height == 6u) leaf = leafUnder(layout_, head, base, child);
    }
    return stateInLeaf(layout_, leaf, planes);
}

// The state of a map at weights u and v of vertices 1 and 2.
uint stateAt(uint map, float u, float v) {
    const SdagLayout layout_ = sdagLayout();
    const SdagMap found = sdagMap(layout_, map);
    if (found.isFlat) return payloadState(layout_.flatAt + found.value, curveIndex(u, v, found.level));
    return stateUnder(layout_, found, sdagPlanes(u, v, found.level, found.symmetry));
}
