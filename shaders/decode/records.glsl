// Records of compressed grids (docs/spec/lattice.md, cluster.md), as words. Four words of any value stand behind the
// last record. Includers bind the words: GRID_WORDS names the array.
#ifndef FILIGREE_DECODE_RECORDS
#define FILIGREE_DECODE_RECORDS

uint recordWord(uint record, uint word) {
    return GRID_WORDS[record + word];
}

// `count` bits, 0 to 31.
uint lowestBits(uint bits, uint count) {
    return bits & ((1u << count) - 1u);
}
int signedBits(uint word, int at, int count) {
    return bitfieldExtract(int(word), at, count);
}

// 32 bits from a bit of a record on; `record` is the word that it begins at.
uint recordWindow(uint record, uint bit) {
    const uint at = record + (bit >> 5);
    const uint shift = bit & 31u;
    const uint low = GRID_WORDS[at];
    return shift == 0u ? low : (low >> shift) | (GRID_WORDS[at + 1u] << (32u - shift));
}
uint recordBits(uint record, uint bit, uint count) {
    return lowestBits(recordWindow(record, bit), count);
}
// The fields of a vertex, which follow each other: x, y, z, 0 to 24 bits each.
ivec3 recordFields(uint record, uint bit, uvec3 width) {
    const uint first = record + (bit >> 5);
    const uvec4 words = uvec4(GRID_WORDS[first], GRID_WORDS[first + 1u], GRID_WORDS[first + 2u], GRID_WORDS[first + 3u]);
    const uint x = bit & 31u;
    const uint y = x + width.x;
    const uint z = y + width.y;
    const uvec2 pastFirst = uvec2(y, z) >> 5u;
    const uvec3 low = uvec3(words.x, pastFirst.x == 0u ? words.x : words.y,
                            pastFirst.y == 0u ? words.x : pastFirst.y == 1u ? words.y : words.z);
    const uvec3 high = uvec3(words.y, pastFirst.x == 0u ? words.y : words.z,
                             pastFirst.y == 0u ? words.y : pastFirst.y == 1u ? words.z : words.w);
    const uvec3 shift = uvec3(x, y, z) & 31u;
    // Twice, because a shift by 32 means nothing.
    const uvec3 window = (low >> shift) | ((high << 1u) << (31u - shift));
    return ivec3(window & ((uvec3(1u) << width) - 1u));
}

int onAxis(ivec3 v, uint axis) {
    return axis == 0u ? v.x : axis == 1u ? v.y : v.z;
}
// Minor axes of tiles and level axes of clusters: the lower and the higher of those that are not `axis`, and 0 on it.
ivec3 besides(uint axis, int lower, int higher) {
    return axis == 0u ? ivec3(0, lower, higher) : axis == 1u ? ivec3(lower, 0, higher) : ivec3(lower, higher, 0);
}

const int latticeMask = 0xffffff;

#endif
