// Looks up opacity micromaps and opacity squares that Filigree compressed. One header of plain C (C99, or
// C++11 and up) that needs nothing else: a renderer drops it in. Filigree's own readers call the same code.
//
//     filigree_fil file;   // a .fil in memory; or, on blocks that you keep elsewhere, filigree_sdag_open()
//     filigree_view maps;  // and its like: one type for each encoding, and filigree_view for all of them
//     if (filigree_fil_open(&file, bytes, size) || filigree_view_open_fil(&maps, &file)) return;
//     const int32_t map = filigree_fil_index(&file, triangle);
//     const unsigned state =
//         map < 0 ? filigree_special_state(map) : filigree_view_at_point(&maps, (uint32_t)map, u, v);
//
// A set of micromaps is two blocks of bytes, `descriptors` (something for each map) and `payload`: sections 3
// and 4 of a .fil, each at a multiple of 64 bytes (docs/spec/fil.md). `filigree compress` leaves them plain
// unless --zstd is given; filigree_fil_find() finds any section. Views point into the blocks, at any address,
// and own nothing.
//
// What is checked: open() compares sizes with what the blocks say of themselves, in O(1) or O(maps), and so
// finds what is cut short or mixed up; a view is good where it returns 0. Lookups check nothing. Bytes that
// may be damaged inside or hostile go through `filigree validate` or the library's readers first, which check
// every byte; what they pass is safe here. Maps, indices and levels must lie in the ranges given below.
//
// Any number of threads may look up at once. Floats must be IEEE 754 and evaluated in their own precision (no
// x87, no -ffast-math); then results are those of the library to the bit. Beside filigree.h no name clashes.
// Names that end in _ are steps of the others, which the library takes one by one.
#ifndef FILIGREE_LOOKUP_H
#define FILIGREE_LOOKUP_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

// 1 where integers may be loaded as they stand.
#ifndef FILIGREE_LOOKUP_LITTLE_ENDIAN
#if defined(_MSC_VER) || (defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__)
#define FILIGREE_LOOKUP_LITTLE_ENDIAN 1
#else
#define FILIGREE_LOOKUP_LITTLE_ENDIAN 0
#endif
#endif

#if !defined(__cplusplus)
#define FILIGREE_LOOKUP_INLINE static inline
#define FILIGREE_LOOKUP_CONSTEXPR static inline
#define FILIGREE_LOOKUP_TABLE static const
#elif __cplusplus >= 201703L
#define FILIGREE_LOOKUP_INLINE inline
#define FILIGREE_LOOKUP_CONSTEXPR constexpr
#define FILIGREE_LOOKUP_TABLE inline constexpr
#else
#define FILIGREE_LOOKUP_INLINE inline
#define FILIGREE_LOOKUP_CONSTEXPR inline
#define FILIGREE_LOOKUP_TABLE static const
#endif

#if defined(__GNUC__)
#define FILIGREE_LOOKUP_LIKELY(condition) __builtin_expect(!!(condition), 1)
#else
#define FILIGREE_LOOKUP_LIKELY(condition) (condition)
#endif

#if defined(__cplusplus) && defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#endif

// --------------------------------------------------------------------------------------------------- numbers

// What open() and the like return; 0 is success.
typedef enum filigree_lookup_error {
    FILIGREE_LOOKUP_OK = 0,
    FILIGREE_LOOKUP_NULL,         // a null pointer to a block that has bytes
    FILIGREE_LOOKUP_ENCODING,     // an encoding or a format that does not exist, or that the call is not for
    FILIGREE_LOOKUP_DESCRIPTORS,  // the descriptors have another size than so many maps need, or make no
                                  // sense
    FILIGREE_LOOKUP_PAYLOAD,      // the payload has another size than the descriptors say
    FILIGREE_LOOKUP_FILE,         // no .fil, cut short, or damaged in its table or meta section
    FILIGREE_LOOKUP_COMPRESSED,   // the section is compressed with zstd: write the file without --zstd
    FILIGREE_LOOKUP_MISSING       // the file has no such section, mesh or primitive
} filigree_lookup_error;

// One line of text for an error.
FILIGREE_LOOKUP_INLINE const char* filigree_lookup_error_text(filigree_lookup_error error) {
    switch (error) {
        case FILIGREE_LOOKUP_OK:
            return "no error";
        case FILIGREE_LOOKUP_NULL:
            return "a pointer is null, but its size is not 0";
        case FILIGREE_LOOKUP_ENCODING:
            return "no such encoding or format, or not one that this function reads";
        case FILIGREE_LOOKUP_DESCRIPTORS:
            return "the descriptors are not those of so many maps";
        case FILIGREE_LOOKUP_PAYLOAD:
            return "the payload is not what the descriptors say";
        case FILIGREE_LOOKUP_FILE:
            return "not a .fil of version 1, or cut short";
        case FILIGREE_LOOKUP_COMPRESSED:
            return "the section is compressed with zstd; write the file without --zstd";
        case FILIGREE_LOOKUP_MISSING:
            return "the file has no such section or primitive";
    }
    return "no such error";
}

// Encodings by their numbers in the container (docs/spec/fil.md); each has a page of its name in docs/spec.
enum {
    FILIGREE_FLAT = 0,
    FILIGREE_GRUEN = 1,
    FILIGREE_BITMASK = 2,
    FILIGREE_TREE = 3,
    FILIGREE_INDEXED_TREE = 4,
    FILIGREE_DAG = 5,
    FILIGREE_SDAG = 6,
    FILIGREE_VQ2 = 16,  // opacity squares from here on
    FILIGREE_VQ2_PLUS = 17,
    FILIGREE_VQ4 = 18,
    FILIGREE_VQ4_PLUS = 19
};

// Formats, by the numbers of Vulkan, DXR and glTF.
enum { FILIGREE_TWO_STATE = 1, FILIGREE_FOUR_STATE = 2 };

// States of micro-triangles, by the numbers of the APIs. 2-state sets give 0 and 1.
enum {
    FILIGREE_TRANSPARENT = 0,
    FILIGREE_OPAQUE = 1,
    FILIGREE_UNKNOWN_TRANSPARENT = 2,  // run the alpha test; mostly transparent
    FILIGREE_UNKNOWN_OPAQUE = 3        // run the alpha test; mostly opaque
};

// Regions of opacity squares; the paper's T, C and O.
enum { FILIGREE_VQ_TRANSPARENT = 0, FILIGREE_VQ_MIXED = 1, FILIGREE_VQ_OPAQUE = 2 };

// Levels run from 0 to 12; level L has 4^L micro-triangles.
enum { FILIGREE_LOOKUP_MAX_LEVEL = 12 };

// The state of a whole triangle from its special index, -1 to -4.
FILIGREE_LOOKUP_CONSTEXPR unsigned filigree_special_state(int32_t index) {
    return (unsigned)(-1 - index) & 3u;
}

// The state that bit 0 or 1 of a 2-state map stands for, where the file has a section of pairs
// (docs/spec/one-bit.md); `pairs` has two bits for each map.
FILIGREE_LOOKUP_INLINE unsigned filigree_pair_state(const uint8_t* pairs, uint32_t map, unsigned bit) {
    const unsigned pair = ((unsigned)pairs[map / 4] >> (2 * (map % 4))) & 3u;
    return pair == 2 ? 2 - bit : pair == 1 ? 3 * bit : bit;
}

// ----------------------------------------------------------------------------------------------- bits, bytes

// Little-endian integers at any address.
FILIGREE_LOOKUP_INLINE uint32_t filigree_load16(const uint8_t* from) {
#if FILIGREE_LOOKUP_LITTLE_ENDIAN
    uint16_t value;
    memcpy(&value, from, sizeof value);
    return value;
#else
    return (uint32_t)from[0] | (uint32_t)from[1] << 8;
#endif
}
FILIGREE_LOOKUP_INLINE uint32_t filigree_load32(const uint8_t* from) {
#if FILIGREE_LOOKUP_LITTLE_ENDIAN
    uint32_t value;
    memcpy(&value, from, sizeof value);
    return value;
#else
    return filigree_load16(from) | filigree_load16(from + 2) << 16;
#endif
}
FILIGREE_LOOKUP_INLINE uint64_t filigree_load64(const uint8_t* from) {
#if FILIGREE_LOOKUP_LITTLE_ENDIAN
    uint64_t value;
    memcpy(&value, from, sizeof value);
    return value;
#else
    return filigree_load32(from) | (uint64_t)filigree_load32(from + 4) << 32;
#endif
}

// How many of the low `child` bits of `mask` are set, child 0..15. Without the instruction, which baseline
// x86-64 lacks: four copies of the bits, 15 apart, bring each bit to the lowest place of a nibble exactly
// once; the product sums the nibbles.
FILIGREE_LOOKUP_CONSTEXPR uint32_t filigree_rank16(uint32_t mask, uint32_t child) {
    const uint32_t before = mask & ((1u << child) - 1);
#if defined(__GNUC__) && defined(__POPCNT__)
    return (uint32_t)__builtin_popcount(before);
#else
    const uint64_t copies = 0x0000200040008001u;
    const uint64_t lowest_of_nibbles = 0x1111111111111111u;
    return (uint32_t)((((before * copies) & lowest_of_nibbles) * lowest_of_nibbles) >> 60);
#endif
}

// `x` within 0..1; NaN counts as 0.
FILIGREE_LOOKUP_CONSTEXPR float filigree_clamp01_(float x) {
    return x > 0 ? (1.0f < x ? 1.0f : x) : 0.0f;
}

// Value `index` of an array of 1-bit (shift 0, mask 1) or 2-bit (shift 1, mask 3) values, lowest bits first.
FILIGREE_LOOKUP_INLINE unsigned filigree_value_(const uint8_t* values, uint32_t index, unsigned shift,
                                                unsigned mask) {
    const uint32_t bit = index << shift;
    return ((unsigned)values[bit / 8] >> (bit % 8)) & mask;
}

// -------------------------------------------------------------------------------------------- the bird curve

// One micro-triangle by its place in the lattice of 2^level steps along each edge: upright ones have the
// corners (i, j), (i+1, j), (i, j+1), flipped ones (i+1, j+1), (i, j+1), (i+1, j), where point (i, j) has the
// weights i / 2^level of vertex 1 and j / 2^level of vertex 2.
typedef struct filigree_lattice_triangle {
    uint32_t i, j;
    uint32_t flipped;  // 0 or 1
} filigree_lattice_triangle;

// Integer coordinates of a micro-triangle as the reference function of VK_KHR_opacity_micromap takes them:
// the barycentrics times 2^level, rounded down; the low `level` bits of `w` make u + v + w = -1, or -2 where
// the triangle is flipped.
typedef struct filigree_curve_coordinates {
    uint32_t u, v, w;
} filigree_curve_coordinates;

// Those of the micro-triangle that holds the point with barycentrics (u, v), the weights of vertices 1 and 2;
// coordinates outside the triangle are clamped, NaN counts as 0. As the reference function in single
// precision, ties included. level 0..15. (Products are with powers of two, so fused multiply-adds change
// nothing.)
FILIGREE_LOOKUP_CONSTEXPR filigree_curve_coordinates filigree_curve_coordinates_at(float u, float v,
                                                                                   unsigned level) {
    const uint32_t n = 1u << level;
    const float scaled_u = filigree_clamp01_(u) * (float)n;
    const float scaled_v = filigree_clamp01_(v) * (float)n;
    const int32_t floor_u = (int32_t)scaled_u;
    const int32_t floor_v = (int32_t)scaled_v;
    const float fractions = (scaled_u - (float)floor_u) + (scaled_v - (float)floor_v);
    const uint32_t iv = n - 1 < (uint32_t)floor_v ? n - 1 : (uint32_t)floor_v;
    const uint32_t most_u = n - 1 < (uint32_t)floor_u ? n - 1 : (uint32_t)floor_u;
    const uint32_t sum = most_u + iv;
    const uint32_t iu = sum >= n ? most_u - (sum - n + 1) : most_u;
    const uint32_t flipped = fractions >= 1.0f && sum < n - 1 ? 1 : 0;
    const filigree_curve_coordinates at = {iu, iv, ~(iu + iv) - flipped};
    return at;
}

#define FILIGREE_SPREAD2_(n) (n), (n) + 1, (n) + 4, (n) + 5
#define FILIGREE_SPREAD4_(n)                                                        \
    FILIGREE_SPREAD2_(n), FILIGREE_SPREAD2_((n) + 16), FILIGREE_SPREAD2_((n) + 64), \
        FILIGREE_SPREAD2_((n) + 80)
#define FILIGREE_SPREAD6_(n)                                                           \
    FILIGREE_SPREAD4_(n), FILIGREE_SPREAD4_((n) + 256), FILIGREE_SPREAD4_((n) + 1024), \
        FILIGREE_SPREAD4_((n) + 1280)
// Each byte with its bits spread to the even places.
FILIGREE_LOOKUP_TABLE uint16_t filigree_spread_bytes_[256] = {
    FILIGREE_SPREAD6_(0), FILIGREE_SPREAD6_(4096), FILIGREE_SPREAD6_(16384), FILIGREE_SPREAD6_(20480)};
#undef FILIGREE_SPREAD2_
#undef FILIGREE_SPREAD4_
#undef FILIGREE_SPREAD6_

// Spreads the low 16 bits of `bits` to the even places.
FILIGREE_LOOKUP_CONSTEXPR uint32_t filigree_spread_(uint32_t bits) {
    return filigree_spread_bytes_[bits & 255] | (uint32_t)filigree_spread_bytes_[bits >> 8 & 255] << 16;
}

// The way back: the even places of `bits`, gathered.
FILIGREE_LOOKUP_CONSTEXPR uint32_t filigree_gather_(uint32_t bits) {
    const uint32_t even = bits & 0x55555555u;
    const uint32_t pairs = (even | (even >> 1)) & 0x33333333u;
    const uint32_t nibbles = (pairs | (pairs >> 2)) & 0x0f0f0f0fu;
    const uint32_t bytes = (nibbles | (nibbles >> 4)) & 0x00ff00ffu;
    return (bytes | (bytes >> 8)) & 0x0000ffffu;
}

// Each bit becomes the parity of itself and all higher ones, in the low 16 bits.
FILIGREE_LOOKUP_CONSTEXPR uint32_t filigree_prefix_parity_(uint32_t bits) {
    const uint32_t of2 = bits ^ (bits >> 1);
    const uint32_t of4 = of2 ^ (of2 >> 2);
    const uint32_t of8 = of4 ^ (of4 >> 4);
    return of8 ^ (of8 >> 8);
}

// Curve index, 0..4^level - 1, of a micro-triangle: the interleaving step of the reference function.
// level 0..15.
FILIGREE_LOOKUP_CONSTEXPR uint32_t filigree_curve_index_of(filigree_curve_coordinates at, unsigned level) {
    const uint32_t mask = (1u << level) - 1;
    const uint32_t low = ~(at.u ^ at.w) & mask;
    const uint32_t tie = (at.u ^ at.v) & low;
    const uint32_t high = ((filigree_prefix_parity_(tie) ^ at.u) & ~low & mask) | tie;
    return filigree_spread_(low) | (filigree_spread_(high) << 1);
}

// Curve index of the micro-triangle that holds a point: the number that BarycentricsToSpaceFillingCurveIndex
// of VK_KHR_opacity_micromap gives. u, v are the weights of vertices 1 and 2; level 0..15.
FILIGREE_LOOKUP_CONSTEXPR uint32_t filigree_curve_index_at(float u, float v, unsigned level) {
    return filigree_curve_index_of(filigree_curve_coordinates_at(u, v, level), level);
}

// The micro-triangle at curve index `index` < 4^level, at any level up to 15 alike. Children 1 and 3 swap the
// first two vertices of what is below them, and the middle child, 1, also turns it upside down, which
// complements the bits of both coordinates.
FILIGREE_LOOKUP_CONSTEXPR filigree_lattice_triangle filigree_lattice_triangle_at(uint32_t index) {
    const uint32_t low = filigree_gather_(index);
    const uint32_t high = filigree_gather_(index >> 1);
    const uint32_t turns = filigree_prefix_parity_(low & ~high);
    const uint32_t swaps = filigree_prefix_parity_(low) >> 1;
    const filigree_lattice_triangle found = {(~low & (high ^ swaps)) ^ (turns >> 1),
                                             (low & high) ^ (turns >> 1), turns & 1};
    return found;
}

// ------------------------------------------------------------------------------------ a frame for symmetries

// Where a micro-triangle lies: the digit of each level is two bits, bit k of `a` and bit k of `b` for the
// level of children that are 2^k micro-triangle edges long (docs/spec/sdag.md, "The frame").
typedef struct filigree_planes {
    uint32_t a, b;
} filigree_planes;

// level 0..15.
FILIGREE_LOOKUP_CONSTEXPR filigree_planes filigree_planes_of(filigree_curve_coordinates at, unsigned level) {
    const uint32_t mask = (1u << level) - 1;
    const filigree_planes planes = {(at.u ^ at.w) & mask, (at.v ^ at.w) & mask};
    return planes;
}

// The planes of curve index `index` < 4^level, level 0..15. On the curve children 1 and 3 turn the order of 0
// and 2 around in all that lies below them.
FILIGREE_LOOKUP_CONSTEXPR filigree_planes filigree_planes_of_index(uint32_t index, unsigned level) {
    const uint32_t mask = (1u << level) - 1;
    const uint32_t low = filigree_gather_(index);
    const uint32_t high = filigree_gather_(index >> 1);
    const uint32_t b = (low & high) | ~(low | (high ^ filigree_prefix_parity_(low)));
    const filigree_planes planes = {~low & mask, b & mask};
    return planes;
}

// The way back.
FILIGREE_LOOKUP_CONSTEXPR uint32_t filigree_index_of_planes(filigree_planes p, unsigned level) {
    const uint32_t mask = (1u << level) - 1;
    const uint32_t low = ~p.a & mask;
    const uint32_t high = (low & p.b) | (~low & ~(p.b ^ filigree_prefix_parity_(low)) & mask);
    return filigree_spread_(low) | (filigree_spread_(high) << 1);
}

// The six symmetries, four bits each, the lowest symmetry 0: m0..m3 of the map a' = m0 a ^ m1 b,
// b' = m2 a ^ m3 b over GF(2).
#define FILIGREE_SYMMETRY_MATRICES 0xe7bd69u

// The planes under a symmetry.
FILIGREE_LOOKUP_CONSTEXPR filigree_planes filigree_planes_turned(filigree_planes p, unsigned symmetry) {
    const uint32_t m = (FILIGREE_SYMMETRY_MATRICES >> (4 * symmetry)) & 15;
    const filigree_planes turned = {((0 - (m & 1)) & p.a) ^ ((0 - (m >> 1 & 1)) & p.b),
                                    ((0 - (m >> 2 & 1)) & p.a) ^ ((0 - (m >> 3 & 1)) & p.b)};
    return turned;
}

// ---------------------------------------------------------------------------------------------------- blocks

// What all views of micromaps have in common.
typedef struct filigree_blocks {
    const uint8_t* descriptors;
    const uint8_t* payload;
    uint32_t map_count;
    unsigned state_shift;  // log2 of a state's bits: 0 for 2-state, 1 for 4-state
    unsigned state_mask;   // 1 or 3
} filigree_blocks;

// The checks that all open() begin with.
FILIGREE_LOOKUP_INLINE filigree_lookup_error
filigree_blocks_open_(filigree_blocks* blocks, unsigned format, uint32_t map_count, const void* descriptors,
                      size_t descriptor_bytes, const void* payload, size_t payload_bytes) {
    blocks->descriptors = (const uint8_t*)descriptors;
    blocks->payload = (const uint8_t*)payload;
    blocks->map_count = map_count;
    blocks->state_shift = format == FILIGREE_FOUR_STATE ? 1 : 0;
    blocks->state_mask = format == FILIGREE_FOUR_STATE ? 3 : 1;
    if ((!descriptors && descriptor_bytes != 0) || (!payload && payload_bytes != 0))
        return FILIGREE_LOOKUP_NULL;
    if (format != FILIGREE_TWO_STATE && format != FILIGREE_FOUR_STATE) return FILIGREE_LOOKUP_ENCODING;
    return FILIGREE_LOOKUP_OK;
}

// The descriptors are `each` bytes a map.
FILIGREE_LOOKUP_INLINE filigree_lookup_error filigree_descriptors_fit_(const filigree_blocks* blocks,
                                                                       uint64_t each,
                                                                       size_t descriptor_bytes) {
    return each * blocks->map_count == descriptor_bytes ? FILIGREE_LOOKUP_OK : FILIGREE_LOOKUP_DESCRIPTORS;
}

// The 8 bytes of a map in flat, gruen, tree and indexed-tree sets.
FILIGREE_LOOKUP_INLINE const uint8_t* filigree_record_(const filigree_blocks* blocks, uint32_t map) {
    return blocks->descriptors + (size_t)8 * map;
}

// Flat and gruen sets: the last map ends with the payload.
FILIGREE_LOOKUP_INLINE filigree_lookup_error filigree_records_fit_(const filigree_blocks* blocks,
                                                                   size_t descriptor_bytes,
                                                                   size_t payload_bytes) {
    const filigree_lookup_error error = filigree_descriptors_fit_(blocks, 8, descriptor_bytes);
    uint64_t end = 0;
    if (error != FILIGREE_LOOKUP_OK) return error;
    if (blocks->map_count > 0) {
        const uint8_t* last = filigree_record_(blocks, blocks->map_count - 1);
        const uint32_t level = filigree_load16(last + 4);
        if (level > FILIGREE_LOOKUP_MAX_LEVEL) return FILIGREE_LOOKUP_DESCRIPTORS;
        end = filigree_load32(last) + ((((uint64_t)1 << (2 * level)) << blocks->state_shift) + 7) / 8;
    }
    return end == payload_bytes ? FILIGREE_LOOKUP_OK : FILIGREE_LOOKUP_PAYLOAD;
}

// ------------------------------------------------------------------------------------------------------ flat

// Micromaps as the APIs take them (docs/spec/flat.md).
typedef struct filigree_flat {
    filigree_blocks blocks;
} filigree_flat;

// As filigree_view_open(), for this encoding alone.
FILIGREE_LOOKUP_INLINE filigree_lookup_error filigree_flat_open(filigree_flat* view, unsigned format,
                                                                uint32_t map_count, const void* descriptors,
                                                                size_t descriptor_bytes, const void* payload,
                                                                size_t payload_bytes) {
    const filigree_lookup_error error = filigree_blocks_open_(&view->blocks, format, map_count, descriptors,
                                                              descriptor_bytes, payload, payload_bytes);
    if (error != FILIGREE_LOOKUP_OK) return error;
    return filigree_records_fit_(&view->blocks, descriptor_bytes, payload_bytes);
}

// 0..12, of map < map_count.
FILIGREE_LOOKUP_INLINE unsigned filigree_flat_level(const filigree_flat* view, uint32_t map) {
    return filigree_load16(filigree_record_(&view->blocks, map) + 4);
}

// The state of micro-triangle `index` < 4^level, counted along the curve.
FILIGREE_LOOKUP_INLINE unsigned filigree_flat_at(const filigree_flat* view, uint32_t map, uint32_t index) {
    const uint32_t offset = filigree_load32(filigree_record_(&view->blocks, map));
    return filigree_value_(view->blocks.payload + offset, index, view->blocks.state_shift,
                           view->blocks.state_mask);
}

// The state at weights u and v of vertices 1 and 2.
FILIGREE_LOOKUP_INLINE unsigned filigree_flat_at_point(const filigree_flat* view, uint32_t map, float u,
                                                       float v) {
    return filigree_flat_at(view, map, filigree_curve_index_at(u, v, filigree_flat_level(view, map)));
}

// ----------------------------------------------------------------------------------------------------- gruen

// Masks in row order (docs/spec/gruen.md; Gruen, Benthin and Woop 2020). Unknown states read as
// unknown-opaque.
typedef struct filigree_gruen {
    filigree_blocks blocks;
    unsigned state_scale;  // of a stored value to a state: 3 where a set bit says "maybe opaque", else 1
} filigree_gruen;

// The place of a micro-triangle in row order. Row r, counted from vertex 0, starts at r * r.
FILIGREE_LOOKUP_CONSTEXPR uint32_t filigree_row_order_of(filigree_lattice_triangle t) {
    const uint32_t row = t.i + t.j + t.flipped;
    return row * row + 2 * t.j + t.flipped;
}

// The same from a curve index.
FILIGREE_LOOKUP_CONSTEXPR uint32_t filigree_row_order_of_curve(uint32_t index) {
    return filigree_row_order_of(filigree_lattice_triangle_at(index));
}

// The same from barycentrics, without the curve: the micro-triangle that filigree_curve_index_at() finds,
// ties included.
FILIGREE_LOOKUP_CONSTEXPR uint32_t filigree_row_order_at(float u, float v, unsigned level) {
    const float n = (float)(1u << level);
    const float scaled_u = filigree_clamp01_(u) * n;
    const float scaled_v = filigree_clamp01_(v) * n;
    const int32_t floor_u = (int32_t)scaled_u;
    const int32_t floor_v = (int32_t)scaled_v;
    const float fractions = (scaled_u - (float)floor_u) + (scaled_v - (float)floor_v);
    const int32_t last = (int32_t)((1u << level) - 1);
    const int32_t j = last < floor_v ? last : floor_v;
    const int32_t sum = (last < floor_u ? last : floor_u) + j;
    const int32_t flipped = fractions >= 1.0f && sum < last ? 1 : 0;
    const int32_t row = (last < sum ? last : sum) + flipped;
    return (uint32_t)(row * row + 2 * j + flipped);
}

// As filigree_view_open(), for this encoding alone.
FILIGREE_LOOKUP_INLINE filigree_lookup_error filigree_gruen_open(filigree_gruen* view, unsigned format,
                                                                 uint32_t map_count, const void* descriptors,
                                                                 size_t descriptor_bytes, const void* payload,
                                                                 size_t payload_bytes) {
    filigree_lookup_error error = filigree_blocks_open_(&view->blocks, format, map_count, descriptors,
                                                        descriptor_bytes, payload, payload_bytes);
    view->state_scale = 1;
    if (error == FILIGREE_LOOKUP_OK)
        error = filigree_records_fit_(&view->blocks, descriptor_bytes, payload_bytes);
    if (error != FILIGREE_LOOKUP_OK || map_count == 0) return error;
    // The form, which all maps of a set have in common: 1 sides, 2 three states, 3 maybe opaque.
    if (filigree_load16(filigree_record_(&view->blocks, 0) + 6) == 3) {
        if (format != FILIGREE_TWO_STATE) return FILIGREE_LOOKUP_DESCRIPTORS;
        view->state_scale = 3;
    }
    return FILIGREE_LOOKUP_OK;
}

// 0..12, of map < map_count.
FILIGREE_LOOKUP_INLINE unsigned filigree_gruen_level(const filigree_gruen* view, uint32_t map) {
    return filigree_load16(filigree_record_(&view->blocks, map) + 4);
}

// The state at a place in row order.
FILIGREE_LOOKUP_INLINE unsigned filigree_gruen_at_row_order(const filigree_gruen* view, uint32_t map,
                                                            uint32_t place) {
    const uint32_t offset = filigree_load32(filigree_record_(&view->blocks, map));
    return view->state_scale * filigree_value_(view->blocks.payload + offset, place, view->blocks.state_shift,
                                               view->blocks.state_mask);
}

// The state of micro-triangle `index` < 4^level, counted along the curve.
FILIGREE_LOOKUP_INLINE unsigned filigree_gruen_at(const filigree_gruen* view, uint32_t map, uint32_t index) {
    return filigree_gruen_at_row_order(view, map, filigree_row_order_of_curve(index));
}

// The state at weights u and v of vertices 1 and 2.
FILIGREE_LOOKUP_INLINE unsigned filigree_gruen_at_point(const filigree_gruen* view, uint32_t map, float u,
                                                        float v) {
    return filigree_gruen_at_row_order(view, map,
                                       filigree_row_order_at(u, v, filigree_gruen_level(view, map)));
}

// --------------------------------------------------------------------------------------------------- bitmask

// One state for each texel-sized cell of a texture (docs/spec/bitmask.md; Waldemarson and Doggett 2024,
// section 5). Its maps are textures, looked up with texture coordinates.
typedef struct filigree_bitmask {
    filigree_blocks blocks;
} filigree_bitmask;

// How the cells of one axis are stored. Cell c of a linearly filtered axis lies between the centres of texels
// c and c + 1; with nearest filtering cells are texels.
typedef struct filigree_bitmask_axis {
    uint32_t size;            // texels, 1..65536
    uint32_t wrap;            // 0 repeat, 1 mirrored repeat, 2 clamp to edge
    uint32_t between_texels;  // 0 or 1
} filigree_bitmask_axis;

// How many more cells than texels an axis stores: one, -1, where its border is between texels, too.
FILIGREE_LOOKUP_CONSTEXPR uint32_t filigree_bitmask_extra(filigree_bitmask_axis axis) {
    return axis.between_texels != 0 && axis.wrap != 0 ? 1 : 0;
}

// Which of the stored cells any cell equals, mirrored ones by their mirror image.
FILIGREE_LOOKUP_CONSTEXPR uint32_t filigree_bitmask_stored(filigree_bitmask_axis axis, int64_t cell) {
    const int64_t extra = filigree_bitmask_extra(axis);
    const int64_t cells = axis.size + extra;
    const int64_t at = cell + extra;
    const int64_t period = axis.wrap == 0 ? (int64_t)axis.size : 2 * (int64_t)axis.size;
    if (at >= 0 && at < cells) return (uint32_t)at;
    if (axis.wrap == 2) return at < 0 ? 0 : (uint32_t)(cells - 1);
    const int64_t in = (at % period + period) % period;
    return (uint32_t)(in < cells ? in : period - 1 + extra - in);
}

// The 12 bytes of a texture, and both axes from them.
FILIGREE_LOOKUP_INLINE const uint8_t* filigree_bitmask_record_(const filigree_blocks* blocks,
                                                               uint32_t texture) {
    return blocks->descriptors + (size_t)12 * texture;
}
FILIGREE_LOOKUP_INLINE filigree_bitmask_axis filigree_bitmask_axis_u_(const uint8_t* record) {
    const filigree_bitmask_axis axis = {filigree_load16(record + 4) + 1, record[8] & 3u,
                                        (record[8] & 16) == 0 ? 1u : 0u};
    return axis;
}
FILIGREE_LOOKUP_INLINE filigree_bitmask_axis filigree_bitmask_axis_v_(const uint8_t* record) {
    const filigree_bitmask_axis axis = {filigree_load16(record + 6) + 1, (uint32_t)record[8] >> 2 & 3u,
                                        (record[8] & 16) == 0 ? 1u : 0u};
    return axis;
}

// map_count is the number of textures.
FILIGREE_LOOKUP_INLINE filigree_lookup_error
filigree_bitmask_open(filigree_bitmask* view, unsigned format, uint32_t map_count, const void* descriptors,
                      size_t descriptor_bytes, const void* payload, size_t payload_bytes) {
    filigree_lookup_error error = filigree_blocks_open_(&view->blocks, format, map_count, descriptors,
                                                        descriptor_bytes, payload, payload_bytes);
    uint64_t end = 0;
    if (error == FILIGREE_LOOKUP_OK) error = filigree_descriptors_fit_(&view->blocks, 12, descriptor_bytes);
    if (error != FILIGREE_LOOKUP_OK) return error;
    if (map_count > 0) {
        const uint8_t* last = filigree_bitmask_record_(&view->blocks, map_count - 1);
        const filigree_bitmask_axis columns = filigree_bitmask_axis_u_(last);
        const filigree_bitmask_axis rows = filigree_bitmask_axis_v_(last);
        const uint64_t cells = (uint64_t)(columns.size + filigree_bitmask_extra(columns)) *
                               (rows.size + filigree_bitmask_extra(rows));
        if (columns.wrap > 2 || rows.wrap > 2) return FILIGREE_LOOKUP_DESCRIPTORS;
        end = filigree_load32(last) + ((cells << view->blocks.state_shift) + 7) / 8;
    }
    return end == payload_bytes ? FILIGREE_LOOKUP_OK : FILIGREE_LOOKUP_PAYLOAD;
}

// |x| < 2^40.
FILIGREE_LOOKUP_CONSTEXPR int64_t filigree_floor_(double x) {
    const int64_t towards_zero = (int64_t)x;
    return towards_zero - (x < (double)towards_zero ? 1 : 0);
}

// The state of the cell of texture < map_count that holds the texture coordinate (u, v). 4-state: a known one
// holds all over the cell; an unknown one has the side of the cell's centre. 2-state: the side of the cell's
// centre. Beyond 2^40 texels, and for NaN, unknown-opaque, 2-state opaque.
FILIGREE_LOOKUP_INLINE unsigned filigree_bitmask_at_point(const filigree_bitmask* view, uint32_t texture,
                                                          float u, float v) {
    const double reach = 1099511627776.0;  // 2^40 texels
    const uint8_t* record = filigree_bitmask_record_(&view->blocks, texture);
    const filigree_bitmask_axis columns = filigree_bitmask_axis_u_(record);
    const filigree_bitmask_axis rows = filigree_bitmask_axis_v_(record);
    const double half = columns.between_texels != 0 ? 0.5 : 0;
    const double x = (double)u * columns.size - half;
    const double y = (double)v * rows.size - half;
    if (!(x > -reach && x < reach && y > -reach && y < reach)) return view->blocks.state_mask;
    const uint64_t row_cells = columns.size + filigree_bitmask_extra(columns);
    const uint64_t cell = filigree_bitmask_stored(rows, filigree_floor_(y)) * row_cells +
                          filigree_bitmask_stored(columns, filigree_floor_(x));
    const uint64_t bit = cell << view->blocks.state_shift;
    const unsigned byte = view->blocks.payload[(size_t)(filigree_load32(record) + bit / 8)];
    return (byte >> (bit % 8)) & view->blocks.state_mask;
}

// ----------------------------------------------------------------------------------------------------- trees

// Succinct quadtrees that are read by scanning (docs/spec/tree.md; Waldemarson and Doggett 2024, section 4).
typedef struct filigree_tree {
    filigree_blocks blocks;
} filigree_tree;

// The same with a rank directory (docs/spec/indexed-tree.md).
typedef struct filigree_indexed_tree {
    filigree_blocks blocks;
} filigree_indexed_tree;

// One map: where it stands in the payload and what it holds.
typedef struct filigree_tree_map {
    uint32_t offset;
    uint32_t inner;  // inner nodes, below 2^24; three times as many leaves and one more
    unsigned level;
} filigree_tree_map;

// From its 8 bytes.
FILIGREE_LOOKUP_INLINE filigree_tree_map filigree_tree_map_(const uint8_t* record) {
    const uint32_t shape = filigree_load32(record + 4);
    const filigree_tree_map found = {filigree_load32(record), shape & 0xffffff, shape >> 24};
    return found;
}

// Bytes of the structure, 4 inner + 1 bits, and of the values of 3 inner + 1 leaves.
FILIGREE_LOOKUP_CONSTEXPR uint64_t filigree_tree_structure_bytes(uint64_t inner) {
    return (4 * inner + 8) / 8;
}
FILIGREE_LOOKUP_CONSTEXPR uint64_t filigree_tree_value_bytes(uint64_t inner, unsigned state_shift) {
    return (((3 * inner + 1) << state_shift) + 7) / 8;
}

enum {
    FILIGREE_TREE_SAMPLE_STEP = 64,       // every so many leaves there is a sample
    FILIGREE_INDEXED_TREE_TAIL_BYTES = 8  // zero bytes behind the last map
};

// Bytes of one sample, and of an indexed tree's directory: all samples but that of leaf 0.
FILIGREE_LOOKUP_CONSTEXPR uint32_t filigree_tree_sample_bytes_(unsigned level) {
    return (2 * level + 7) / 8;
}
FILIGREE_LOOKUP_CONSTEXPR uint64_t filigree_tree_directory_bytes_(uint64_t inner, unsigned level) {
    return 3 * inner / FILIGREE_TREE_SAMPLE_STEP * filigree_tree_sample_bytes_(level);
}

// The last map ends with the payload, but for the tail of indexed trees.
FILIGREE_LOOKUP_INLINE filigree_lookup_error filigree_trees_fit_(const filigree_blocks* blocks,
                                                                 unsigned indexed, size_t descriptor_bytes,
                                                                 size_t payload_bytes) {
    const filigree_lookup_error error = filigree_descriptors_fit_(blocks, 8, descriptor_bytes);
    uint64_t end = 0;
    if (error != FILIGREE_LOOKUP_OK) return error;
    if (blocks->map_count > 0) {
        const filigree_tree_map last = filigree_tree_map_(filigree_record_(blocks, blocks->map_count - 1));
        if (last.level > FILIGREE_LOOKUP_MAX_LEVEL) return FILIGREE_LOOKUP_DESCRIPTORS;
        end = last.offset + filigree_tree_structure_bytes(last.inner) +
              filigree_tree_value_bytes(last.inner, blocks->state_shift);
        if (indexed != 0) end += filigree_tree_directory_bytes_(last.inner, last.level);
    }
    if (indexed != 0) end += FILIGREE_INDEXED_TREE_TAIL_BYTES;
    return end == payload_bytes ? FILIGREE_LOOKUP_OK : FILIGREE_LOOKUP_PAYLOAD;
}

// As filigree_view_open(), for this encoding alone.
FILIGREE_LOOKUP_INLINE filigree_lookup_error filigree_tree_open(filigree_tree* view, unsigned format,
                                                                uint32_t map_count, const void* descriptors,
                                                                size_t descriptor_bytes, const void* payload,
                                                                size_t payload_bytes) {
    const filigree_lookup_error error = filigree_blocks_open_(&view->blocks, format, map_count, descriptors,
                                                              descriptor_bytes, payload, payload_bytes);
    if (error != FILIGREE_LOOKUP_OK) return error;
    return filigree_trees_fit_(&view->blocks, 0, descriptor_bytes, payload_bytes);
}

// 0..12, of map < map_count.
FILIGREE_LOOKUP_INLINE unsigned filigree_tree_level(const filigree_tree* view, uint32_t map) {
    return filigree_record_(&view->blocks, map)[7];
}

FILIGREE_LOOKUP_CONSTEXPR unsigned filigree_bit_(const uint8_t* bytes, uint32_t bit) {
    return (unsigned)bytes[bit / 8] >> (bit % 8) & 1u;
}

// Where the leaf of `index` stands: at bit `t` of the structure, as leaf `d`. The paper's names; `child` are
// the subtrees still to skip.
typedef struct filigree_tree_leaf {
    uint32_t t, d;
} filigree_tree_leaf;
FILIGREE_LOOKUP_INLINE filigree_tree_leaf filigree_tree_scan_(const uint8_t* structure, unsigned level,
                                                              uint32_t index) {
    filigree_tree_leaf leaf = {0, 0};
    unsigned height = 2 * level;
    while (filigree_bit_(structure, leaf.t) != 0) {
        uint32_t child;
        ++leaf.t;
        height -= 2;
        for (child = index >> height & 3; child > 0; --child, ++leaf.t) {
            if (filigree_bit_(structure, leaf.t) != 0) {
                child += 4;
            } else {
                ++leaf.d;
            }
        }
    }
    return leaf;
}

// The state of micro-triangle `index` < 4^level, counted along the curve. Algorithm 3 as it is published:
// reads the structure bit by bit up to the leaf, about four times as long at each level.
FILIGREE_LOOKUP_INLINE unsigned filigree_tree_at(const filigree_tree* view, uint32_t map, uint32_t index) {
    const filigree_tree_map found = filigree_tree_map_(filigree_record_(&view->blocks, map));
    const uint8_t* structure = view->blocks.payload + found.offset;
    const uint32_t leaf = filigree_tree_scan_(structure, found.level, index).d;
    return filigree_value_(structure + filigree_tree_structure_bytes(found.inner), leaf,
                           view->blocks.state_shift, view->blocks.state_mask);
}

// The state at weights u and v of vertices 1 and 2.
FILIGREE_LOOKUP_INLINE unsigned filigree_tree_at_point(const filigree_tree* view, uint32_t map, float u,
                                                       float v) {
    return filigree_tree_at(view, map, filigree_curve_index_at(u, v, filigree_tree_level(view, map)));
}

// --------------------------------------------------------------------------------------------- indexed trees

// As filigree_view_open(), for this encoding alone.
FILIGREE_LOOKUP_INLINE filigree_lookup_error filigree_indexed_tree_open(
    filigree_indexed_tree* view, unsigned format, uint32_t map_count, const void* descriptors,
    size_t descriptor_bytes, const void* payload, size_t payload_bytes) {
    const filigree_lookup_error error = filigree_blocks_open_(&view->blocks, format, map_count, descriptors,
                                                              descriptor_bytes, payload, payload_bytes);
    if (error != FILIGREE_LOOKUP_OK) return error;
    return filigree_trees_fit_(&view->blocks, 1, descriptor_bytes, payload_bytes);
}

// 0..12, of map < map_count.
FILIGREE_LOOKUP_INLINE unsigned filigree_indexed_tree_level(const filigree_indexed_tree* view, uint32_t map) {
    return filigree_record_(&view->blocks, map)[7];
}

// For each byte of a structure, in which a bit 1 leaves three more subtrees to skip and a bit 0 one fewer:
// bits 4k..4k+3 for k = 0..7: after how many bits k + 1 subtrees are skipped, 1..8, or 0 where it takes
// more; bits 40..47: 8 + the change of subtrees left over all 8 bits.
FILIGREE_LOOKUP_TABLE uint64_t filigree_skip_table_[256] = {
    0x000087654321, 0x040000008765, 0x040000008761, 0x080000000000, 0x040000008721, 0x080000000000,
    0x080000000001, 0x0c0000000000, 0x040000008321, 0x080000000000, 0x080000000001, 0x0c0000000000,
    0x080000000021, 0x0c0000000000, 0x0c0000000001, 0x100000000000, 0x040000004321, 0x080000000000,
    0x080000000001, 0x0c0000000000, 0x080000000021, 0x0c0000000000, 0x0c0000000001, 0x100000000000,
    0x080000000321, 0x0c0000000000, 0x0c0000000001, 0x100000000000, 0x0c0000000021, 0x100000000000,
    0x100000000001, 0x140000000000, 0x040000054321, 0x080000000005, 0x080000000001, 0x0c0000000000,
    0x080000000021, 0x0c0000000000, 0x0c0000000001, 0x100000000000, 0x080000000321, 0x0c0000000000,
    0x0c0000000001, 0x100000000000, 0x0c0000000021, 0x100000000000, 0x100000000001, 0x140000000000,
    0x080000004321, 0x0c0000000000, 0x0c0000000001, 0x100000000000, 0x0c0000000021, 0x100000000000,
    0x100000000001, 0x140000000000, 0x0c0000000321, 0x100000000000, 0x100000000001, 0x140000000000,
    0x100000000021, 0x140000000000, 0x140000000001, 0x180000000000, 0x040000654321, 0x080000000065,
    0x080000000061, 0x0c0000000000, 0x080000000021, 0x0c0000000000, 0x0c0000000001, 0x100000000000,
    0x080000000321, 0x0c0000000000, 0x0c0000000001, 0x100000000000, 0x0c0000000021, 0x100000000000,
    0x100000000001, 0x140000000000, 0x080000004321, 0x0c0000000000, 0x0c0000000001, 0x100000000000,
    0x0c0000000021, 0x100000000000, 0x100000000001, 0x140000000000, 0x0c0000000321, 0x100000000000,
    0x100000000001, 0x140000000000, 0x100000000021, 0x140000000000, 0x140000000001, 0x180000000000,
    0x080000054321, 0x0c0000000005, 0x0c0000000001, 0x100000000000, 0x0c0000000021, 0x100000000000,
    0x100000000001, 0x140000000000, 0x0c0000000321, 0x100000000000, 0x100000000001, 0x140000000000,
    0x100000000021, 0x140000000000, 0x140000000001, 0x180000000000, 0x0c0000004321, 0x100000000000,
    0x100000000001, 0x140000000000, 0x100000000021, 0x140000000000, 0x140000000001, 0x180000000000,
    0x100000000321, 0x140000000000, 0x140000000001, 0x180000000000, 0x140000000021, 0x180000000000,
    0x180000000001, 0x1c0000000000, 0x040007654321, 0x080000000765, 0x080000000761, 0x0c0000000000,
    0x080000000721, 0x0c0000000000, 0x0c0000000001, 0x100000000000, 0x080000000321, 0x0c0000000000,
    0x0c0000000001, 0x100000000000, 0x0c0000000021, 0x100000000000, 0x100000000001, 0x140000000000,
    0x080000004321, 0x0c0000000000, 0x0c0000000001, 0x100000000000, 0x0c0000000021, 0x100000000000,
    0x100000000001, 0x140000000000, 0x0c0000000321, 0x100000000000, 0x100000000001, 0x140000000000,
    0x100000000021, 0x140000000000, 0x140000000001, 0x180000000000, 0x080000054321, 0x0c0000000005,
    0x0c0000000001, 0x100000000000, 0x0c0000000021, 0x100000000000, 0x100000000001, 0x140000000000,
    0x0c0000000321, 0x100000000000, 0x100000000001, 0x140000000000, 0x100000000021, 0x140000000000,
    0x140000000001, 0x180000000000, 0x0c0000004321, 0x100000000000, 0x100000000001, 0x140000000000,
    0x100000000021, 0x140000000000, 0x140000000001, 0x180000000000, 0x100000000321, 0x140000000000,
    0x140000000001, 0x180000000000, 0x140000000021, 0x180000000000, 0x180000000001, 0x1c0000000000,
    0x080000654321, 0x0c0000000065, 0x0c0000000061, 0x100000000000, 0x0c0000000021, 0x100000000000,
    0x100000000001, 0x140000000000, 0x0c0000000321, 0x100000000000, 0x100000000001, 0x140000000000,
    0x100000000021, 0x140000000000, 0x140000000001, 0x180000000000, 0x0c0000004321, 0x100000000000,
    0x100000000001, 0x140000000000, 0x100000000021, 0x140000000000, 0x140000000001, 0x180000000000,
    0x100000000321, 0x140000000000, 0x140000000001, 0x180000000000, 0x140000000021, 0x180000000000,
    0x180000000001, 0x1c0000000000, 0x0c0000054321, 0x100000000005, 0x100000000001, 0x140000000000,
    0x100000000021, 0x140000000000, 0x140000000001, 0x180000000000, 0x100000000321, 0x140000000000,
    0x140000000001, 0x180000000000, 0x140000000021, 0x180000000000, 0x180000000001, 0x1c0000000000,
    0x100000004321, 0x140000000000, 0x140000000001, 0x180000000000, 0x140000000021, 0x180000000000,
    0x180000000001, 0x1c0000000000, 0x140000000321, 0x180000000000, 0x180000000001, 0x1c0000000000,
    0x180000000021, 0x1c0000000000, 0x1c0000000001, 0x200000000000};

// After how many bits `skip` subtrees are skipped, or 0: none are to be, or it takes more than the byte.
FILIGREE_LOOKUP_CONSTEXPR uint32_t filigree_skip_length_(uint64_t entry, uint32_t skip) {
    return skip - 1 >= 8 ? 0 : (uint32_t)(entry >> (4 * (skip - 1))) & 15u;
}

// The sum of the base-4 digits of a curve index.
FILIGREE_LOOKUP_CONSTEXPR uint32_t filigree_digit_sum_(uint32_t index) {
    const uint32_t pairs = (index & 0x33333333u) + (index >> 2 & 0x33333333u);
    const uint32_t bytes = (pairs & 0x0f0f0f0fu) + (pairs >> 4 & 0x0f0f0f0fu);
    return bytes * 0x01010101u >> 24;
}

FILIGREE_LOOKUP_INLINE unsigned filigree_trailing_zeros_(uint32_t bits) {
#if defined(__GNUC__)
    return (unsigned)__builtin_ctz(bits);
#else
    unsigned count = 0;
    for (; (bits & 1) == 0; bits >>= 1) ++count;
    return count;
#endif
}
FILIGREE_LOOKUP_INLINE unsigned filigree_bit_width_(uint32_t bits) {
#if defined(__GNUC__)
    return bits == 0 ? 0 : 32 - (unsigned)__builtin_clz(bits);
#else
    unsigned count = 0;
    for (; bits != 0; bits >>= 1) ++count;
    return count;
#endif
}

// The depth of the highest node that begins at curve index `first`. Nodes that begin at one index are a run
// of inner nodes and a leaf in the structure.
FILIGREE_LOOKUP_INLINE unsigned filigree_tree_top_depth_(uint32_t first, unsigned level) {
    unsigned height;
    if (first == 0) return 0;
    height = filigree_trailing_zeros_(first) / 2;
    return level - (height < level ? height : level);
}

// A node: where it stands in the structure, and its depth.
typedef struct filigree_tree_node {
    uint32_t bit;
    unsigned depth;
} filigree_tree_node;

// Where the nodes that begin at one curve index begin in the structure, and that index.
typedef struct filigree_tree_sample {
    filigree_tree_node top;
    uint32_t first;
    unsigned looked;  // how many entries of the directory led to it
} filigree_tree_sample;

// The last sample at or before `index`; `directory` may be read 3 bytes beyond its end. Every 64th leaf is a
// sample: the curve index that it begins at. Before the top node there, there are b leaves and a inner nodes
// with 3a - b = 3 depth - digit_sum(first), since each inner node on the way down has 3 minus its digit of
// children still to come.
FILIGREE_LOOKUP_INLINE filigree_tree_sample filigree_tree_sample_before_(const uint8_t* directory,
                                                                         filigree_tree_map map,
                                                                         uint32_t index) {
    const uint32_t bytes = filigree_tree_sample_bytes_(map.level);
    const uint32_t mask = (1u << (8 * bytes)) - 1;
    filigree_tree_sample found = {{0, 0}, 0, 0};
    uint32_t sample = 0;
    uint32_t left = 3 * map.inner / FILIGREE_TREE_SAMPLE_STEP;
    while (left > 0) {
        const uint32_t half = (left + 1) / 2;
        const uint32_t middle = filigree_load32(directory + (size_t)(sample + half - 1) * bytes) & mask;
        const int after = middle > index;
        sample = after ? sample : sample + half;
        found.first = after ? found.first : middle;
        left = after ? half - 1 : left - half;
        ++found.looked;
    }
    found.top.depth = filigree_tree_top_depth_(found.first, map.level);
    found.top.bit =
        found.top.depth + (4 * FILIGREE_TREE_SAMPLE_STEP * sample - filigree_digit_sum_(found.first)) / 3;
    return found;
}

// The leaf that holds `index`, from a node at or before it in the structure.
FILIGREE_LOOKUP_INLINE filigree_tree_node filigree_tree_leaf_from_(const uint8_t* structure,
                                                                   filigree_tree_sample sample,
                                                                   unsigned level, uint32_t index) {
    // The nearest ancestor of `index` at or after the sample's top, and how many subtrees stand before it.
    const unsigned same = (filigree_bit_width_(sample.first ^ index) + 1) / 2;
    filigree_tree_node node = sample.top;
    uint32_t skip;
    if (level + 1 - same < node.depth) node.depth = level + 1 - same;
    skip = 3 * (sample.top.depth - node.depth) + filigree_digit_sum_(index >> (2 * (level - node.depth))) -
           filigree_digit_sum_(sample.first);
    for (;;) {
        const uint32_t bits = filigree_load16(structure + node.bit / 8) >> (node.bit % 8);
        const uint64_t entry = filigree_skip_table_[bits & 255];
        const uint32_t length = filigree_skip_length_(entry, skip);
        if (skip != 0 && length == 0) {
            skip += (uint32_t)(entry >> 40) - 8;
            node.bit += 8;
            continue;
        }
        node.bit += length;
        if ((bits >> length & 1) == 0) return node;
        ++node.bit;
        ++node.depth;
        skip = index >> (2 * (level - node.depth)) & 3;
    }
}

// The state of micro-triangle `index` < 4^level, counted along the curve: a binary search among every 64th
// leaf, then at most some hundred bits a byte at a time.
FILIGREE_LOOKUP_INLINE unsigned filigree_indexed_tree_at(const filigree_indexed_tree* view, uint32_t map,
                                                         uint32_t index) {
    const filigree_tree_map found = filigree_tree_map_(filigree_record_(&view->blocks, map));
    const uint8_t* structure = view->blocks.payload + found.offset;
    const uint8_t* values = structure + filigree_tree_structure_bytes(found.inner);
    const uint8_t* directory = values + filigree_tree_value_bytes(found.inner, view->blocks.state_shift);
    const filigree_tree_node leaf = filigree_tree_leaf_from_(
        structure, filigree_tree_sample_before_(directory, found, index), found.level, index);
    // The relation of the samples, solved for the leaves before.
    const uint32_t digits = filigree_digit_sum_(index >> (2 * (found.level - leaf.depth)));
    return filigree_value_(values, (3 * (leaf.bit - leaf.depth) + digits) / 4, view->blocks.state_shift,
                           view->blocks.state_mask);
}

// The state at weights u and v of vertices 1 and 2.
FILIGREE_LOOKUP_INLINE unsigned filigree_indexed_tree_at_point(const filigree_indexed_tree* view,
                                                               uint32_t map, float u, float v) {
    const unsigned level = filigree_indexed_tree_level(view, map);
    return filigree_indexed_tree_at(view, map, filigree_curve_index_at(u, v, level));
}

// ------------------------------------------------------------------------------------------------------- dag

// Merged subtrees (docs/spec/dag.md; Chernaik, Modisett and Billeter 2026).
typedef struct filigree_dag {
    filigree_blocks blocks;
} filigree_dag;

FILIGREE_LOOKUP_INLINE uint32_t filigree_dag_descriptor_(const filigree_blocks* blocks, uint32_t map) {
    return filigree_load32(blocks->descriptors + (size_t)4 * map);
}
FILIGREE_LOOKUP_INLINE uint32_t filigree_dag_word_(const filigree_blocks* blocks, uint32_t at) {
    return filigree_load32(blocks->payload + (size_t)4 * at);
}

// How far the index is shifted to number a root's children: four bits a node, the last four in a mask.
FILIGREE_LOOKUP_CONSTEXPR unsigned filigree_dag_root_shift_(unsigned level) {
    return level <= 4 ? 4 : 4 * ((level + 1) / 2) - 4;
}

// The last root is the last node: it ends with the payload.
FILIGREE_LOOKUP_INLINE filigree_lookup_error filigree_dag_fits_(const filigree_blocks* blocks,
                                                                size_t payload_bytes) {
    const uint64_t words = payload_bytes / 4;
    uint32_t last = 0;
    uint32_t map;
    uint32_t present;
    if (payload_bytes % 4 != 0) return FILIGREE_LOOKUP_PAYLOAD;
    for (map = 0; map < blocks->map_count; ++map) {
        const uint32_t descriptor = filigree_dag_descriptor_(blocks, map);
        if (descriptor >> 28 > FILIGREE_LOOKUP_MAX_LEVEL) return FILIGREE_LOOKUP_DESCRIPTORS;
        if ((descriptor & 0xfffffff) >= words) return FILIGREE_LOOKUP_PAYLOAD;
        if ((descriptor & 0xfffffff) >= (last & 0xfffffff)) last = descriptor;
    }
    if (blocks->map_count == 0) return words == 0 ? FILIGREE_LOOKUP_OK : FILIGREE_LOOKUP_PAYLOAD;
    present = filigree_dag_word_(blocks, last & 0xfffffff) & 0xffff;
    present = filigree_rank16(present, 15) + (present >> 15);
    // Below a node of height 4 there are masks, two a word where they are of 16 bits.
    if (last >> 28 <= 4 && blocks->state_shift == 0) present = (present + 1) / 2;
    return (uint64_t)(last & 0xfffffff) + 1 + present == words ? FILIGREE_LOOKUP_OK : FILIGREE_LOOKUP_PAYLOAD;
}

// As filigree_view_open(), for this encoding alone.
FILIGREE_LOOKUP_INLINE filigree_lookup_error filigree_dag_open(filigree_dag* view, unsigned format,
                                                               uint32_t map_count, const void* descriptors,
                                                               size_t descriptor_bytes, const void* payload,
                                                               size_t payload_bytes) {
    filigree_lookup_error error = filigree_blocks_open_(&view->blocks, format, map_count, descriptors,
                                                        descriptor_bytes, payload, payload_bytes);
    if (error == FILIGREE_LOOKUP_OK) error = filigree_descriptors_fit_(&view->blocks, 4, descriptor_bytes);
    if (error != FILIGREE_LOOKUP_OK) return error;
    return filigree_dag_fits_(&view->blocks, payload_bytes);
}

// 0..12, of map < map_count.
FILIGREE_LOOKUP_INLINE unsigned filigree_dag_level(const filigree_dag* view, uint32_t map) {
    return filigree_dag_descriptor_(&view->blocks, map) >> 28;
}

// The state of micro-triangle `index` < 4^level, counted along the curve: two reads for two levels, a node's
// head and one pointer, or one word of masks.
FILIGREE_LOOKUP_INLINE unsigned filigree_dag_at(const filigree_dag* view, uint32_t map, uint32_t index) {
    const filigree_blocks* blocks = &view->blocks;
    const uint32_t from = filigree_dag_descriptor_(blocks, map);
    uint32_t node = from & 0xfffffff;
    uint32_t head, child, bit, present;
    unsigned shift;
    for (shift = filigree_dag_root_shift_(from >> 28); shift > 4; shift -= 4) {
        head = filigree_dag_word_(blocks, node);
        child = (index >> shift) & 15;
        if (((head >> child) & 1) == 0) return FILIGREE_TRANSPARENT;
        node = filigree_dag_word_(blocks, node + 1 + filigree_rank16(head, child));
    }
    head = filigree_dag_word_(blocks, node);
    child = (index >> 4) & 15;
    bit = (16 * filigree_rank16(head, child) + (index & 15)) << blocks->state_shift;
    // Whether a block is absent is hard to predict: so an absent one reads the head instead.
    present = (head >> child) & 1;
    return (filigree_dag_word_(blocks, node + (present != 0 ? 1 + bit / 32 : 0)) >> (bit % 32)) &
           blocks->state_mask & (0 - present);
}

// The state at weights u and v of vertices 1 and 2.
FILIGREE_LOOKUP_INLINE unsigned filigree_dag_at_point(const filigree_dag* view, uint32_t map, float u,
                                                      float v) {
    return filigree_dag_at(view, map, filigree_curve_index_at(u, v, filigree_dag_level(view, map)));
}

// ------------------------------------------------------------------------------------------------------ sdag

enum {
    FILIGREE_SDAG_HEAD_BYTES = 48,
    FILIGREE_SDAG_DESCRIPTOR_PADDING = 8,  // zero bytes behind the descriptors
    FILIGREE_SDAG_PAYLOAD_PADDING = 16,    // zero bytes behind the blocks
    FILIGREE_SDAG_SHORT_CODES = 192,       // codes below take one byte, others two
    FILIGREE_SDAG_ESCAPE = 255             // the first byte of what has no code
};

// What stands before the descriptors (docs/spec/sdag.md, "Descriptors").
typedef struct filigree_sdag_head {
    uint32_t shares;          // 1 where opaque shares of nodes are stored, else 0
    uint32_t flat_maps;       // 1 where some maps are stored flat, else 0
    uint32_t base_bytes;      // of a node's base, 0..4
    uint32_t reference_bits;  // of a reference to a shared leaf, 0..32
    uint32_t value_bits;      // of a descriptor's value, 0..32
    uint32_t levels;          // bit L: some map has level L
    uint32_t patterns;        // entries of the table
    uint32_t heads;           // entries of the table
    uint32_t nodes[4];        // of heights 6, 8, 10, 12
    uint32_t shared_bytes;
    uint32_t block_bytes;
    uint64_t flat_bytes;
} filigree_sdag_head;

// Where the parts of a payload begin, in bytes.
typedef struct filigree_sdag_offsets {
    uint64_t patterns;
    uint64_t heads;
    uint64_t nodes[4];   // of heights 6, 8, 10, 12
    uint64_t shares[4];  // of those nodes
    uint64_t shared;
    uint64_t blocks;
    uint64_t padding;
    uint64_t flat;
    uint64_t end;
} filigree_sdag_offsets;

// Merged subtrees, up to the triangle's symmetries, with codes (docs/spec/sdag.md).
typedef struct filigree_sdag {
    const uint8_t* descriptors;  // behind the head
    const uint8_t* payload;
    uint32_t map_count;
    unsigned four_state;  // 0 or 1
    unsigned level_bits;
    unsigned flat_bit;  // 1 where descriptors tell flat maps apart, else 0
    unsigned value_bits;
    unsigned descriptor_bits;
    unsigned node_bytes;
    unsigned reference_bits;
    unsigned has_shares;  // 0 or 1
    uint8_t levels[16];   // by level number
    filigree_sdag_offsets at;
} filigree_sdag;

// A node: what it says of its 16 grandchildren.
typedef struct filigree_sdag_node {
    uint32_t mixed;
    uint32_t opaque;  // of a mixed child of height 4: its leaf is shared
    uint32_t base;
} filigree_sdag_node;

// A leaf: what it says of its 16 grandchildren, and where the mixed ones' patterns are told.
typedef struct filigree_sdag_leaf {
    uint32_t mixed;
    uint32_t opaque;
    const uint8_t* codes;  // null: raw patterns stand at `raw`
    const uint8_t* raw;
} filigree_sdag_leaf;

// The head, from its 48 bytes.
FILIGREE_LOOKUP_INLINE filigree_sdag_head filigree_sdag_head_(const uint8_t* from) {
    filigree_sdag_head head;
    unsigned slot;
    head.shares = from[0] & 1u;
    head.flat_maps = from[0] >> 1 & 1u;
    head.base_bytes = from[1];
    head.reference_bits = from[2];
    head.value_bits = from[3];
    head.levels = filigree_load32(from + 4);
    head.patterns = filigree_load32(from + 8);
    head.heads = filigree_load32(from + 12);
    for (slot = 0; slot < 4; ++slot) head.nodes[slot] = filigree_load32(from + 16 + 4 * slot);
    head.shared_bytes = filigree_load32(from + 32);
    head.block_bytes = filigree_load32(from + 36);
    head.flat_bytes = filigree_load64(from + 40);
    return head;
}

// Bits that number the levels of `levels`.
FILIGREE_LOOKUP_INLINE unsigned filigree_sdag_level_bits_(uint32_t levels) {
    unsigned used = 0;
    for (; levels != 0; levels &= levels - 1) ++used;
    return used <= 1 ? 0 : filigree_bit_width_(used - 1);
}

// Bits of one descriptor: level number, flat or not, symmetry, value.
FILIGREE_LOOKUP_INLINE unsigned filigree_sdag_descriptor_bits_(const filigree_sdag_head* head) {
    return filigree_sdag_level_bits_(head->levels) + head->flat_maps + 3 + head->value_bits;
}

// Bytes of the descriptors, the head and the padding included.
FILIGREE_LOOKUP_INLINE uint64_t filigree_sdag_descriptor_bytes_(const filigree_sdag_head* head,
                                                                uint32_t map_count) {
    const uint64_t bits = (uint64_t)filigree_sdag_descriptor_bits_(head) * map_count;
    return FILIGREE_SDAG_HEAD_BYTES + (bits + 7) / 8 + FILIGREE_SDAG_DESCRIPTOR_PADDING;
}

// The layout of the payload, from the head.
FILIGREE_LOOKUP_INLINE filigree_sdag_offsets filigree_sdag_offsets_(const filigree_sdag_head* head,
                                                                    unsigned format) {
    filigree_sdag_offsets at;
    uint64_t nodes = 0;
    uint64_t next;
    unsigned slot;
    at.patterns = 0;
    at.heads = (uint64_t)head->patterns * (format == FILIGREE_FOUR_STATE ? 4 : 2);
    next = at.heads + (uint64_t)head->heads * 4;
    for (slot = 0; slot < 4; ++slot) {
        at.nodes[slot] = next;
        next += (uint64_t)head->nodes[slot] * (4 + head->base_bytes);
        nodes += head->nodes[slot];
    }
    for (slot = 0; slot < 4; ++slot) {
        at.shares[slot] = next;
        next += head->shares != 0 ? (uint64_t)2 * head->nodes[slot] : 0;
    }
    at.shared = next;
    at.blocks = at.shared + head->shared_bytes;
    at.padding = at.blocks + head->block_bytes;
    at.flat = at.padding;
    if (nodes > 0 || head->shared_bytes > 0 || head->block_bytes > 0)
        at.flat += FILIGREE_SDAG_PAYLOAD_PADDING;
    at.end = at.flat + head->flat_bytes;
    return at;
}

// As filigree_view_open(), for this encoding alone.
FILIGREE_LOOKUP_INLINE filigree_lookup_error filigree_sdag_open(filigree_sdag* view, unsigned format,
                                                                uint32_t map_count, const void* descriptors,
                                                                size_t descriptor_bytes, const void* payload,
                                                                size_t payload_bytes) {
    filigree_blocks blocks;
    filigree_sdag_head head;
    unsigned level;
    unsigned number = 0;
    const filigree_lookup_error error = filigree_blocks_open_(&blocks, format, map_count, descriptors,
                                                              descriptor_bytes, payload, payload_bytes);
    if (error != FILIGREE_LOOKUP_OK) return error;
    if (descriptor_bytes < FILIGREE_SDAG_HEAD_BYTES) return FILIGREE_LOOKUP_DESCRIPTORS;
    head = filigree_sdag_head_(blocks.descriptors);
    if (head.base_bytes > 4 || head.reference_bits > 32 || head.value_bits > 32 ||
        head.levels >> (FILIGREE_LOOKUP_MAX_LEVEL + 1) != 0 || head.flat_bytes > payload_bytes ||
        filigree_sdag_descriptor_bytes_(&head, map_count) != descriptor_bytes) {
        return FILIGREE_LOOKUP_DESCRIPTORS;
    }
    view->descriptors = blocks.descriptors + FILIGREE_SDAG_HEAD_BYTES;
    view->payload = blocks.payload;
    view->map_count = map_count;
    view->four_state = format == FILIGREE_FOUR_STATE ? 1 : 0;
    view->level_bits = filigree_sdag_level_bits_(head.levels);
    view->flat_bit = head.flat_maps;
    view->value_bits = head.value_bits;
    view->descriptor_bits = filigree_sdag_descriptor_bits_(&head);
    view->node_bytes = 4 + head.base_bytes;
    view->reference_bits = head.reference_bits;
    view->has_shares = head.shares;
    memset(view->levels, 0, sizeof view->levels);
    for (level = 0; level <= FILIGREE_LOOKUP_MAX_LEVEL; ++level) {
        if ((head.levels >> level & 1) != 0) view->levels[number++] = (uint8_t)level;
    }
    view->at = filigree_sdag_offsets_(&head, format);
    return view->at.end == payload_bytes ? FILIGREE_LOOKUP_OK : FILIGREE_LOOKUP_PAYLOAD;
}

// A map's descriptor, and its fields from the lowest bits up: level number, flat or not, symmetry, value.
FILIGREE_LOOKUP_INLINE uint64_t filigree_sdag_descriptor_(const filigree_sdag* view, uint32_t map) {
    const uint64_t bit = (uint64_t)map * view->descriptor_bits;
    return filigree_load64(view->descriptors + (size_t)(bit / 8)) >> (bit % 8);
}
FILIGREE_LOOKUP_INLINE unsigned filigree_sdag_level_of_(const filigree_sdag* view, uint64_t descriptor) {
    // Most sets have one level; then the place of a point need not wait for the descriptor.
    if (FILIGREE_LOOKUP_LIKELY(view->level_bits == 0)) return view->levels[0];
    return view->levels[descriptor & ((1u << view->level_bits) - 1)];
}
FILIGREE_LOOKUP_INLINE unsigned filigree_sdag_is_flat_(const filigree_sdag* view, uint64_t descriptor) {
    return (unsigned)(descriptor >> view->level_bits) & view->flat_bit;
}
FILIGREE_LOOKUP_INLINE unsigned filigree_sdag_symmetry_of_(const filigree_sdag* view, uint64_t descriptor) {
    return (unsigned)(descriptor >> (view->level_bits + view->flat_bit)) & 7u;
}
FILIGREE_LOOKUP_INLINE uint32_t filigree_sdag_value_of_(const filigree_sdag* view, uint64_t descriptor) {
    return (uint32_t)((descriptor >> (view->level_bits + view->flat_bit + 3)) &
                      (((uint64_t)1 << view->value_bits) - 1));
}

// Micro-triangle `index` of a map that is stored flat.
FILIGREE_LOOKUP_INLINE unsigned filigree_sdag_flat_at_(const filigree_sdag* view, uint64_t descriptor,
                                                       uint32_t index) {
    const uint8_t* states =
        view->payload + (size_t)(view->at.flat + filigree_sdag_value_of_(view, descriptor));
    return filigree_value_(states, index, view->four_state, view->four_state != 0 ? 3 : 1);
}

// Which grandchild holds a place, from bits `low` and `low` + 1 of both planes.
FILIGREE_LOOKUP_CONSTEXPR uint32_t filigree_sdag_grandchild_(filigree_planes p, unsigned low) {
    return ((p.a >> low) & 3) << 2 | ((p.b >> low) & 3);
}

// Node `number` of those of `height` 6, 8, 10 or 12.
FILIGREE_LOOKUP_INLINE filigree_sdag_node filigree_sdag_node_(const filigree_sdag* view, unsigned height,
                                                              uint32_t number) {
    const uint64_t at = view->at.nodes[height / 2 - 3] + (uint64_t)number * view->node_bytes;
    const uint64_t bytes = filigree_load64(view->payload + (size_t)at);
    const uint64_t base_mask = ((uint64_t)1 << (8 * (view->node_bytes - 4))) - 1;
    const filigree_sdag_node node = {(uint32_t)(bytes & 0xffff), (uint32_t)((bytes >> 16) & 0xffff),
                                     (uint32_t)((bytes >> 32) & base_mask)};
    return node;
}

// `yes` where `mask` is all ones, `no` where it is 0.
FILIGREE_LOOKUP_CONSTEXPR uint64_t filigree_pick_(uint64_t mask, uint64_t yes, uint64_t no) {
    return no ^ ((no ^ yes) & mask);
}

// The leaf under mixed child `child` of a node of height 6.
FILIGREE_LOOKUP_INLINE const uint8_t* filigree_sdag_leaf_under_(const filigree_sdag* view,
                                                                filigree_sdag_node node, uint32_t child) {
    const uint8_t* block = view->payload + (size_t)(view->at.blocks + node.base);
    const uint32_t shared = node.mixed & node.opaque;
    const uint32_t bit = 8 * filigree_rank16(node.mixed & ~node.opaque, child) +
                         view->reference_bits * filigree_rank16(shared, child);
    const uint64_t reference = filigree_load64(block + bit / 8) >> (bit % 8);
    // Which of the two is anybody's guess, so no branch.
    const uint64_t is_shared = 0 - (uint64_t)((shared >> child) & 1);
    const uint64_t mask = filigree_pick_(is_shared, ((uint64_t)1 << view->reference_bits) - 1, 255);
    return view->payload + (size_t)(filigree_pick_(is_shared, view->at.shared, view->at.blocks + node.base) +
                                    (reference & mask));
}

// A leaf that begins with the escape: its head, or raw patterns.
FILIGREE_LOOKUP_INLINE filigree_sdag_leaf filigree_sdag_escaped_leaf_(const uint8_t* bytes) {
    filigree_sdag_leaf leaf = {0xffff, 0, NULL, NULL};
    if (bytes[1] != 0) {
        leaf.raw = bytes + 2;
    } else {
        const uint32_t head = filigree_load32(bytes + 2);
        leaf.mixed = head & 0xffff;
        leaf.opaque = head >> 16;
        leaf.codes = bytes + 6;
    }
    return leaf;
}

// The leaf at `bytes`.
FILIGREE_LOOKUP_INLINE filigree_sdag_leaf filigree_sdag_leaf_(const filigree_sdag* view,
                                                              const uint8_t* bytes) {
    const uint32_t first = bytes[0];
    if (FILIGREE_LOOKUP_LIKELY(first != FILIGREE_SDAG_ESCAPE)) {
        const uint32_t is_long = (first + (256 - FILIGREE_SDAG_SHORT_CODES)) >> 8;
        const uint32_t code = (uint32_t)filigree_pick_(
            0 - (uint64_t)is_long,
            FILIGREE_SDAG_SHORT_CODES + ((first - FILIGREE_SDAG_SHORT_CODES) << 8 | bytes[1]), first);
        const uint32_t head = filigree_load32(view->payload + (size_t)(view->at.heads + (uint64_t)4 * code));
        const filigree_sdag_leaf leaf = {head & 0xffff, head >> 16, bytes + 1 + is_long, NULL};
        return leaf;
    }
    return filigree_sdag_escaped_leaf_(bytes);
}

// Bit 7 of each byte that is at least 192, or 255.
FILIGREE_LOOKUP_CONSTEXPR uint64_t filigree_sdag_long_bytes_(uint64_t bytes) {
    return bytes & (bytes << 1) & 0x8080808080808080u;
}
FILIGREE_LOOKUP_CONSTEXPR uint64_t filigree_sdag_escapes_(uint64_t bytes) {
    const uint64_t low = (bytes & 0x7f7f7f7f7f7f7f7fu) + 0x0101010101010101u;
    return bytes & low & 0x8080808080808080u;
}

// The lowest `count` <= 8 bytes.
FILIGREE_LOOKUP_CONSTEXPR uint64_t filigree_sdag_low_bytes_(uint32_t count) {
    return count == 0 ? 0 : ~(uint64_t)0 >> (64 - 8 * count);
}

// How many of the first `count` <= 16 bytes are marked in bit 7.
FILIGREE_LOOKUP_CONSTEXPR uint32_t filigree_sdag_count_bytes_(uint64_t low, uint64_t high, uint32_t count) {
    const uint64_t in_low = (low >> 7) & filigree_sdag_low_bytes_(count < 8 ? count : 8);
    const uint64_t in_high = (high >> 7) & filigree_sdag_low_bytes_(count < 8 ? 0 : count - 8);
    return (uint32_t)(((in_low + in_high) * 0x0101010101010101u) >> 56);
}

// Patterns are 16 states: 16 or 32 bits.
FILIGREE_LOOKUP_INLINE uint32_t filigree_sdag_load_pattern_(const filigree_sdag* view, const uint8_t* from) {
    return view->four_state != 0 ? filigree_load32(from) : filigree_load16(from);
}
FILIGREE_LOOKUP_INLINE uint32_t filigree_sdag_table_pattern_(const filigree_sdag* view, uint32_t code) {
    const uint64_t at = view->at.patterns + ((uint64_t)code << (view->four_state != 0 ? 2 : 1));
    return filigree_sdag_load_pattern_(view, view->payload + (size_t)at);
}

// A pattern with more bytes, which stand behind the first bytes of all.
FILIGREE_LOOKUP_INLINE uint32_t filigree_sdag_long_pattern_(const filigree_sdag* view,
                                                            filigree_sdag_leaf leaf, uint32_t rank) {
    const uint8_t* seconds = leaf.codes + filigree_rank16(leaf.mixed, 15) + (leaf.mixed >> 15);
    const uint64_t low = filigree_load64(leaf.codes);
    const uint64_t high = filigree_load64(leaf.codes + 8);
    const uint64_t long_low = filigree_sdag_long_bytes_(low);
    const uint64_t long_high = filigree_sdag_long_bytes_(high);
    const uint32_t code = leaf.codes[rank];
    const uint32_t second = seconds[filigree_sdag_count_bytes_(long_low, long_high, rank)];
    if (code != FILIGREE_SDAG_ESCAPE) {
        return filigree_sdag_table_pattern_(
            view, FILIGREE_SDAG_SHORT_CODES + ((code - FILIGREE_SDAG_SHORT_CODES) << 8 | second));
    } else {
        const uint32_t all = (uint32_t)(seconds - leaf.codes);
        const uint8_t* rest = seconds + filigree_sdag_count_bytes_(long_low, long_high, all);
        const uint32_t before =
            filigree_sdag_count_bytes_(filigree_sdag_escapes_(low), filigree_sdag_escapes_(high), rank);
        if (view->four_state == 0) return second | (uint32_t)rest[before] << 8;
        return second | (filigree_load32(rest + (size_t)3 * before) & 0xffffff) << 8;
    }
}

// The pattern of mixed child `child` of a leaf.
FILIGREE_LOOKUP_INLINE uint32_t filigree_sdag_pattern_(const filigree_sdag* view, filigree_sdag_leaf leaf,
                                                       uint32_t child) {
    if (FILIGREE_LOOKUP_LIKELY(leaf.codes != NULL)) {
        const uint32_t rank = filigree_rank16(leaf.mixed, child);
        const uint32_t code = leaf.codes[rank];
        return code < FILIGREE_SDAG_SHORT_CODES ? filigree_sdag_table_pattern_(view, code)
                                                : filigree_sdag_long_pattern_(view, leaf, rank);
    }
    return filigree_sdag_load_pattern_(view, leaf.raw + ((size_t)child << (view->four_state != 0 ? 2 : 1)));
}

FILIGREE_LOOKUP_INLINE unsigned filigree_sdag_state_in_leaf_(const filigree_sdag* view, const uint8_t* bytes,
                                                             filigree_planes p) {
    const filigree_sdag_leaf leaf = filigree_sdag_leaf_(view, bytes);
    const uint32_t child = filigree_sdag_grandchild_(p, 2);
    if (((leaf.mixed >> child) & 1) == 0) {
        return (leaf.opaque >> child) & 1;
    } else {
        const uint32_t pattern = filigree_sdag_pattern_(view, leaf, child);
        const uint32_t at = filigree_sdag_grandchild_(p, 0);
        return view->four_state != 0 ? (pattern >> (2 * at)) & 3 : (pattern >> at) & 1;
    }
}

// The state at a place in the map's own frame, of a map that is not stored flat: a node for two levels above
// height 4, a reference, a leaf with two small tables.
FILIGREE_LOOKUP_INLINE unsigned filigree_sdag_state_at_(const filigree_sdag* view, uint64_t descriptor,
                                                        filigree_planes place) {
    const filigree_planes p = filigree_planes_turned(place, filigree_sdag_symmetry_of_(view, descriptor));
    const unsigned level = filigree_sdag_level_of_(view, descriptor);
    uint32_t number = filigree_sdag_value_of_(view, descriptor);
    unsigned height;
    if (level <= 4)
        return filigree_sdag_state_in_leaf_(view, view->payload + (size_t)(view->at.shared + number), p);
    for (height = (level + 1) & ~1u;; height -= 2) {
        const filigree_sdag_node node = filigree_sdag_node_(view, height, number);
        const uint32_t child = filigree_sdag_grandchild_(p, height - 2);
        if (((node.mixed >> child) & 1) == 0) return (node.opaque >> child) & 1;
        if (height == 6)
            return filigree_sdag_state_in_leaf_(view, filigree_sdag_leaf_under_(view, node, child), p);
        number = node.base + filigree_rank16(node.mixed, child);
    }
}

// The same of any map.
FILIGREE_LOOKUP_INLINE unsigned filigree_sdag_state_of_(const filigree_sdag* view, uint64_t descriptor,
                                                        filigree_planes place) {
    if (FILIGREE_LOOKUP_LIKELY(filigree_sdag_is_flat_(view, descriptor) == 0))
        return filigree_sdag_state_at_(view, descriptor, place);
    return filigree_sdag_flat_at_(view, descriptor,
                                  filigree_index_of_planes(place, filigree_sdag_level_of_(view, descriptor)));
}

// 0..12, of map < map_count.
FILIGREE_LOOKUP_INLINE unsigned filigree_sdag_level(const filigree_sdag* view, uint32_t map) {
    return filigree_sdag_level_of_(view, filigree_sdag_descriptor_(view, map));
}

// The state of micro-triangle `index` < 4^level, counted along the curve.
FILIGREE_LOOKUP_INLINE unsigned filigree_sdag_at(const filigree_sdag* view, uint32_t map, uint32_t index) {
    const uint64_t descriptor = filigree_sdag_descriptor_(view, map);
    const unsigned level = filigree_sdag_level_of_(view, descriptor);
    return filigree_sdag_state_of_(view, descriptor, filigree_planes_of_index(index, level));
}

// The state at weights u and v of vertices 1 and 2. No curve index is made on the way.
FILIGREE_LOOKUP_INLINE unsigned filigree_sdag_at_point(const filigree_sdag* view, uint32_t map, float u,
                                                       float v) {
    const uint64_t descriptor = filigree_sdag_descriptor_(view, map);
    const unsigned level = filigree_sdag_level_of_(view, descriptor);
    return filigree_sdag_state_of_(view, descriptor,
                                   filigree_planes_of(filigree_curve_coordinates_at(u, v, level), level));
}

// --------------------------------------------------------------------------------------- micromaps, any kind

// A set in any encoding of micromaps or textures: a switch for each call.
typedef struct filigree_view {
    unsigned encoding;  // FILIGREE_FLAT and the like
    union {
        filigree_flat flat;
        filigree_gruen gruen;
        filigree_bitmask bitmask;
        filigree_tree tree;
        filigree_indexed_tree indexed_tree;
        filigree_dag dag;
        filigree_sdag sdag;
    } as;
} filigree_view;

// Checks the blocks as far as lookups need it, and looks into them from then on.
FILIGREE_LOOKUP_INLINE filigree_lookup_error filigree_view_open(filigree_view* set, unsigned encoding,
                                                                unsigned format, uint32_t map_count,
                                                                const void* descriptors,
                                                                size_t descriptor_bytes, const void* payload,
                                                                size_t payload_bytes) {
    set->encoding = encoding;
    switch (encoding) {
        case FILIGREE_FLAT:
            return filigree_flat_open(&set->as.flat, format, map_count, descriptors, descriptor_bytes,
                                      payload, payload_bytes);
        case FILIGREE_GRUEN:
            return filigree_gruen_open(&set->as.gruen, format, map_count, descriptors, descriptor_bytes,
                                       payload, payload_bytes);
        case FILIGREE_BITMASK:
            return filigree_bitmask_open(&set->as.bitmask, format, map_count, descriptors, descriptor_bytes,
                                         payload, payload_bytes);
        case FILIGREE_TREE:
            return filigree_tree_open(&set->as.tree, format, map_count, descriptors, descriptor_bytes,
                                      payload, payload_bytes);
        case FILIGREE_INDEXED_TREE:
            return filigree_indexed_tree_open(&set->as.indexed_tree, format, map_count, descriptors,
                                              descriptor_bytes, payload, payload_bytes);
        case FILIGREE_DAG:
            return filigree_dag_open(&set->as.dag, format, map_count, descriptors, descriptor_bytes, payload,
                                     payload_bytes);
        case FILIGREE_SDAG:
            return filigree_sdag_open(&set->as.sdag, format, map_count, descriptors, descriptor_bytes,
                                      payload, payload_bytes);
        default:
            return FILIGREE_LOOKUP_ENCODING;
    }
}

// 0..12, of map < map_count; 0 for a bitmask, which has none.
FILIGREE_LOOKUP_INLINE unsigned filigree_view_level(const filigree_view* set, uint32_t map) {
    switch (set->encoding) {
        case FILIGREE_FLAT:
            return filigree_flat_level(&set->as.flat, map);
        case FILIGREE_GRUEN:
            return filigree_gruen_level(&set->as.gruen, map);
        case FILIGREE_TREE:
            return filigree_tree_level(&set->as.tree, map);
        case FILIGREE_INDEXED_TREE:
            return filigree_indexed_tree_level(&set->as.indexed_tree, map);
        case FILIGREE_DAG:
            return filigree_dag_level(&set->as.dag, map);
        case FILIGREE_SDAG:
            return filigree_sdag_level(&set->as.sdag, map);
        default:
            return 0;
    }
}

// The state of micro-triangle `index` < 4^level, counted along the curve; unknown-opaque for a bitmask, which
// has none.
FILIGREE_LOOKUP_INLINE unsigned filigree_view_at(const filigree_view* set, uint32_t map, uint32_t index) {
    switch (set->encoding) {
        case FILIGREE_FLAT:
            return filigree_flat_at(&set->as.flat, map, index);
        case FILIGREE_GRUEN:
            return filigree_gruen_at(&set->as.gruen, map, index);
        case FILIGREE_TREE:
            return filigree_tree_at(&set->as.tree, map, index);
        case FILIGREE_INDEXED_TREE:
            return filigree_indexed_tree_at(&set->as.indexed_tree, map, index);
        case FILIGREE_DAG:
            return filigree_dag_at(&set->as.dag, map, index);
        case FILIGREE_SDAG:
            return filigree_sdag_at(&set->as.sdag, map, index);
        default:
            return FILIGREE_UNKNOWN_OPAQUE;
    }
}

// The state at weights u and v of vertices 1 and 2; in a bitmask at texture coordinates u and v.
FILIGREE_LOOKUP_INLINE unsigned filigree_view_at_point(const filigree_view* set, uint32_t map, float u,
                                                       float v) {
    switch (set->encoding) {
        case FILIGREE_FLAT:
            return filigree_flat_at_point(&set->as.flat, map, u, v);
        case FILIGREE_GRUEN:
            return filigree_gruen_at_point(&set->as.gruen, map, u, v);
        case FILIGREE_BITMASK:
            return filigree_bitmask_at_point(&set->as.bitmask, map, u, v);
        case FILIGREE_TREE:
            return filigree_tree_at_point(&set->as.tree, map, u, v);
        case FILIGREE_INDEXED_TREE:
            return filigree_indexed_tree_at_point(&set->as.indexed_tree, map, u, v);
        case FILIGREE_DAG:
            return filigree_dag_at_point(&set->as.dag, map, u, v);
        case FILIGREE_SDAG:
            return filigree_sdag_at_point(&set->as.sdag, map, u, v);
        default:
            return FILIGREE_UNKNOWN_OPAQUE;
    }
}

// --------------------------------------------------------------------------------------------------- squares

// A place in a grid, column and row; row 0 at the top.
typedef struct filigree_cell {
    unsigned x, y;
} filigree_cell;

// The cell of a stored `side` x `side` grid that stands at (x, y) once the grid is transformed, of the eight
// symmetries of a square: bit 0 rotate by 90 degrees anticlockwise, then bit 1 reflect top/bottom, then bit 2
// reflect left/right (table 1 of Fenney and Ozkan 2023). The side is a power of two. No branches, since
// transforms follow no pattern.
FILIGREE_LOOKUP_CONSTEXPR filigree_cell filigree_stored_cell(unsigned transform, unsigned side, unsigned x,
                                                             unsigned y) {
    const unsigned last = side - 1;
    const unsigned turned = 0u - (transform & 1u);
    const unsigned over_x = x ^ (last & (0u - (transform >> 2 & 1u)));
    const unsigned over_y = y ^ (last & (0u - (transform >> 1 & 1u)));
    const unsigned exchange = (over_x ^ over_y) & turned;
    const filigree_cell stored = {over_x ^ exchange ^ (last & turned), over_y ^ exchange};
    return stored;
}

// A region's state from whether it is known and what the known ones are, 0 or 1 each.
FILIGREE_LOOKUP_CONSTEXPR unsigned filigree_region_(unsigned known, unsigned palette) {
    return 1 - known + 2 * (known & palette);
}

// What a VQ2 block says of one region, on the way to it (docs/spec/vq2.md).
typedef struct filigree_vq2_look {
    uint64_t book;  // the last 8 bytes: transforms and words
    unsigned index;
    unsigned quadrant;
    filigree_cell cell;  // of the stored vector
} filigree_vq2_look;

FILIGREE_LOOKUP_INLINE filigree_vq2_look filigree_vq2_look_(const uint8_t* block, unsigned x, unsigned y) {
    filigree_vq2_look look;
    look.book = filigree_load64(block + 24);
    look.index = filigree_load32(block + (size_t)3 * (y / 2)) >> (3 * (x / 2)) & 7;
    look.quadrant = y / 8 * 2 + x / 8;
    look.cell =
        filigree_stored_cell((unsigned)((look.book & 511) << 3 >> (3 * look.quadrant)) & 7, 2, x % 2, y % 2);
    return look;
}

// Word k of those that quadrants share (0..2), or of the quadrant's own (0, 1).
FILIGREE_LOOKUP_CONSTEXPR unsigned filigree_vq2_shared_word_(const filigree_vq2_look* look, unsigned k) {
    return (unsigned)(look->book >> (9 + 5 * k)) & 31;
}
FILIGREE_LOOKUP_CONSTEXPR unsigned filigree_vq2_own_word_(const filigree_vq2_look* look, unsigned k) {
    return (unsigned)(look->book >> (24 + 10 * look->quadrant + 5 * k)) & 31;
}

// A cell of a 2 x 2 word of 5 bits: which regions are known, and what they are.
FILIGREE_LOOKUP_CONSTEXPR unsigned filigree_vq2_region_in_(unsigned word, filigree_cell cell) {
    return filigree_region_(word >> (2 * cell.y + cell.x) & 1u, word >> 4 & 1u);
}

// Without branches, since indices follow no pattern.
FILIGREE_LOOKUP_CONSTEXPR unsigned filigree_vq2_looked_(const filigree_vq2_look* look) {
    const unsigned place = 5 * look->index - 6 + (look->index >= 6 ? 10 * look->quadrant : 0);
    const unsigned word = (unsigned)(look->book >> (place & 63)) & 31;
    return look->index < 3 ? look->index : filigree_vq2_region_in_(word, look->cell);
}

// The region in column x and row y, 0..15, of a block of 32 bytes, read as VQ2 (docs/spec/vq2.md; Fenney and
// Ozkan 2023, section 4). Every bit pattern is a block.
FILIGREE_LOOKUP_INLINE unsigned filigree_vq2_region(const uint8_t* block, unsigned x, unsigned y) {
    const filigree_vq2_look look = filigree_vq2_look_(block, x, y);
    return filigree_vq2_looked_(&look);
}

// In VQ2+ the order of words is a message: what a quadrant makes of it (docs/spec/vq2-plus.md).
typedef struct filigree_vq2_plus_reading {
    unsigned rereads;   // 1: an index of the quadrant stands for the first shared word once more
    unsigned index;     // which: 0 or 2
    unsigned rotation;  // of that word, before the quadrant's transform
} filigree_vq2_plus_reading;

FILIGREE_LOOKUP_CONSTEXPR filigree_vq2_plus_reading filigree_vq2_plus_reading_(unsigned own_first,
                                                                               unsigned own_second,
                                                                               unsigned shared_second,
                                                                               unsigned shared_third) {
    const filigree_vq2_plus_reading reading = {own_first > own_second ? 1u : 0u,
                                               ((own_first ^ own_second) & 1) != 0 ? 2u : 0u,
                                               shared_second > shared_third ? 6u : 1u};
    return reading;
}

// What the quadrant of a region makes of it.
FILIGREE_LOOKUP_CONSTEXPR filigree_vq2_plus_reading
filigree_vq2_plus_reading_at_(const filigree_vq2_look* look) {
    return filigree_vq2_plus_reading_(filigree_vq2_own_word_(look, 0), filigree_vq2_own_word_(look, 1),
                                      filigree_vq2_shared_word_(look, 1), filigree_vq2_shared_word_(look, 2));
}

// The region in column x and row y, 0..15, of a block of 32 bytes, read as VQ2+ (docs/spec/vq2-plus.md).
FILIGREE_LOOKUP_INLINE unsigned filigree_vq2_plus_region(const uint8_t* block, unsigned x, unsigned y) {
    const filigree_vq2_look look = filigree_vq2_look_(block, x, y);
    const filigree_vq2_plus_reading reading = filigree_vq2_plus_reading_at_(&look);
    if (reading.rereads == 0 || look.index != reading.index) return filigree_vq2_looked_(&look);
    return filigree_vq2_region_in_(filigree_vq2_shared_word_(&look, 0),
                                   filigree_stored_cell(reading.rotation, 2, look.cell.x, look.cell.y));
}

// Which bit of a block's last 48 is the palette of each 2 x 2 part, row by row, of words 3..15: of VQ4, then
// of VQ4+. Words have one palette, one for the left and the right or the upper and the lower half, or four.
FILIGREE_LOOKUP_TABLE uint8_t filigree_vq4_palettes_[2][13][4] = {{{9, 9, 9, 9},
                                                                   {10, 10, 10, 10},
                                                                   {11, 11, 11, 11},
                                                                   {12, 13, 12, 13},
                                                                   {14, 14, 15, 15},
                                                                   {16, 17, 18, 19},
                                                                   {20, 21, 22, 23},
                                                                   {24, 25, 26, 27},
                                                                   {28, 29, 30, 31},
                                                                   {32, 33, 34, 35},
                                                                   {36, 37, 38, 39},
                                                                   {40, 41, 42, 43},
                                                                   {44, 45, 46, 47}},
                                                                  {{24, 25, 26, 27},
                                                                   {28, 29, 30, 31},
                                                                   {32, 33, 34, 35},
                                                                   {36, 37, 36, 37},
                                                                   {38, 38, 39, 39},
                                                                   {40, 40, 40, 40},
                                                                   {41, 41, 41, 41},
                                                                   {42, 42, 42, 42},
                                                                   {43, 43, 43, 43},
                                                                   {44, 44, 44, 44},
                                                                   {45, 45, 45, 45},
                                                                   {46, 46, 46, 46},
                                                                   {47, 47, 47, 47}}};

// The index of the 4 x 4 vector that holds a region: 0, 1, 2 uniform, else a word.
FILIGREE_LOOKUP_INLINE unsigned filigree_vq4_index_(const uint8_t* block, unsigned x, unsigned y) {
    return filigree_load32(block + y / 4 * 4) >> (x / 4 * 4) & 15;
}

// The region in column x and row y, 0..31, of a block of 64 bytes, read as VQ4 (plus 0, docs/spec/vq4.md;
// Fenney and Ozkan 2023, section 5) or as VQ4+ (plus 1, docs/spec/vq4-plus.md). Every bit pattern is a block.
FILIGREE_LOOKUP_INLINE unsigned filigree_vq4_any_region_(const uint8_t* block, unsigned plus, unsigned x,
                                                         unsigned y) {
    const unsigned index = filigree_vq4_index_(block, x, y);
    if (index < 3) {
        return index;
    } else {
        const uint64_t tail = filigree_load64(block + 56) >> 16;
        const unsigned quadrant = y / 16 * 2 + x / 16;
        const unsigned group = plus != 0 ? 2 * quadrant + y / 8 % 2 : quadrant;
        // The first quadrant of VQ4 stores no transform.
        const uint64_t transforms = plus != 0 ? tail : (tail & 511) << 3;
        const filigree_cell cell =
            filigree_stored_cell((unsigned)(transforms >> (3 * group)) & 7, 4, x % 4, y % 4);
        const uint32_t mask = filigree_load16(block + 32 + (size_t)2 * (index - 3));
        const unsigned part = cell.y / 2 * 2 + cell.x / 2;
        const unsigned place = filigree_vq4_palettes_[plus][index - 3][part];
        return filigree_region_(mask >> (4 * cell.y + cell.x) & 1, (unsigned)(tail >> place) & 1);
    }
}
FILIGREE_LOOKUP_INLINE unsigned filigree_vq4_region(const uint8_t* block, unsigned x, unsigned y) {
    return filigree_vq4_any_region_(block, 0, x, y);
}
FILIGREE_LOOKUP_INLINE unsigned filigree_vq4_plus_region(const uint8_t* block, unsigned x, unsigned y) {
    return filigree_vq4_any_region_(block, 1, x, y);
}

// Opacity squares of triangle pairs, one after the other (docs/spec/squares.md; Fenney and Ozkan 2023).
typedef struct filigree_vq {
    const uint8_t* payload;
    uint32_t count;
    unsigned encoding;  // FILIGREE_VQ2 .. FILIGREE_VQ4_PLUS
    unsigned side;      // regions along an edge: 16 or 32
} filigree_vq;

// Looks into `payload`, maps one after the other.
FILIGREE_LOOKUP_INLINE filigree_lookup_error filigree_vq_open(filigree_vq* view, unsigned encoding,
                                                              uint32_t count, const void* payload,
                                                              size_t payload_bytes) {
    view->payload = (const uint8_t*)payload;
    view->count = count;
    view->encoding = encoding;
    view->side = encoding == FILIGREE_VQ2 || encoding == FILIGREE_VQ2_PLUS ? 16 : 32;
    if (!payload && payload_bytes != 0) return FILIGREE_LOOKUP_NULL;
    if (encoding < FILIGREE_VQ2 || encoding > FILIGREE_VQ4_PLUS) return FILIGREE_LOOKUP_ENCODING;
    return (uint64_t)2 * view->side * count == payload_bytes ? FILIGREE_LOOKUP_OK : FILIGREE_LOOKUP_PAYLOAD;
}

// The region in column x and row y, 0..side - 1, of square < count.
FILIGREE_LOOKUP_INLINE unsigned filigree_vq_at(const filigree_vq* view, uint32_t square, unsigned x,
                                               unsigned y) {
    const uint8_t* block = view->payload + (size_t)2 * view->side * square;
    switch (view->encoding) {
        case FILIGREE_VQ2:
            return filigree_vq2_region(block, x, y);
        case FILIGREE_VQ2_PLUS:
            return filigree_vq2_plus_region(block, x, y);
        default:
            return filigree_vq4_any_region_(block, view->encoding == FILIGREE_VQ4_PLUS ? 1 : 0, x, y);
    }
}

// The column or row, of `side`, that holds coordinate `at`. Coordinates outside 0..1 and NaN count as the
// nearest inside; NaN as 0.
FILIGREE_LOOKUP_CONSTEXPR unsigned filigree_region_along(float at, unsigned side) {
    const unsigned along = (unsigned)(filigree_clamp01_(at) * (float)side);
    return along < side - 1 ? along : side - 1;
}

// A point of a square, 0..1: x to the right, y down.
typedef struct filigree_square_point {
    float x, y;
} filigree_square_point;

// The point with weights u and v of vertices 1 and 2 of one of a pair's triangles: (u, v) in half 0, (1 - u,
// 1 - v) in half 1.
FILIGREE_LOOKUP_CONSTEXPR filigree_square_point filigree_point_in_square(unsigned half, float u, float v) {
    const filigree_square_point point = {half == 0 ? u : 1 - u, half == 0 ? v : 1 - v};
    return point;
}

// The region at such a point.
FILIGREE_LOOKUP_INLINE unsigned filigree_vq_at_point(const filigree_vq* view, uint32_t square, unsigned half,
                                                     float u, float v) {
    const filigree_square_point point = filigree_point_in_square(half, u, v);
    return filigree_vq_at(view, square, filigree_region_along(point.x, view->side),
                          filigree_region_along(point.y, view->side));
}

// --------------------------------------------------------------------------------------------- files (*.fil)

// A section in memory.
typedef struct filigree_section {
    const uint8_t* bytes;
    size_t size;
} filigree_section;

// Kinds of sections (docs/spec/fil.md).
enum {
    FILIGREE_SECTION_META = 1,
    FILIGREE_SECTION_INDICES = 2,
    FILIGREE_SECTION_DESCRIPTORS = 3,
    FILIGREE_SECTION_PAYLOAD = 4,
    FILIGREE_SECTION_PAIRS = 5
};

// Finds a section of a file that stands in memory, all of it. Looks at no hashes: `filigree validate` does.
FILIGREE_LOOKUP_INLINE filigree_lookup_error filigree_fil_find(const void* file, size_t file_bytes,
                                                               uint32_t kind, filigree_section* section) {
    static const uint8_t magic[8] = {0x89, 0x46, 0x49, 0x4c, 0x0d, 0x0a, 0x1a, 0x0a};
    const uint8_t* bytes = (const uint8_t*)file;
    uint32_t count;
    uint32_t k;
    section->bytes = NULL;
    section->size = 0;
    if (!file) return file_bytes != 0 ? FILIGREE_LOOKUP_NULL : FILIGREE_LOOKUP_FILE;
    if (file_bytes < 32 || memcmp(bytes, magic, sizeof magic) != 0 || filigree_load32(bytes + 8) != 1)
        return FILIGREE_LOOKUP_FILE;
    count = filigree_load32(bytes + 12);
    if (count > 64 || filigree_load64(bytes + 16) != file_bytes || file_bytes < 32 + (size_t)40 * count)
        return FILIGREE_LOOKUP_FILE;
    for (k = 0; k < count; ++k) {
        const uint8_t* entry = bytes + 24 + (size_t)40 * k;
        const uint64_t offset = filigree_load64(entry + 8);
        const uint64_t size = filigree_load64(entry + 16);
        if (filigree_load32(entry) != kind) continue;
        if (offset > file_bytes || size > file_bytes - offset) return FILIGREE_LOOKUP_FILE;
        if (filigree_load32(entry + 4) != 0) return FILIGREE_LOOKUP_COMPRESSED;
        section->bytes = bytes + (size_t)offset;
        section->size = (size_t)size;
        return FILIGREE_LOOKUP_OK;
    }
    return FILIGREE_LOOKUP_MISSING;
}

// A file with micromaps or squares.
typedef struct filigree_fil {
    unsigned encoding;   // FILIGREE_FLAT .. FILIGREE_VQ4_PLUS
    unsigned format;     // FILIGREE_TWO_STATE or FILIGREE_FOUR_STATE
    uint32_t map_count;  // micromaps, textures or squares
    unsigned index_bits;
    filigree_section meta, indices, descriptors, payload;
    filigree_section pairs;  // empty where the file has none (docs/spec/one-bit.md)
} filigree_fil;

// Reads what a file in memory holds and where; the sections stay where they are. Compressed sections, and
// compressed grids, are refused.
FILIGREE_LOOKUP_INLINE filigree_lookup_error filigree_fil_open(filigree_fil* fil, const void* file,
                                                               size_t file_bytes) {
    filigree_lookup_error error = filigree_fil_find(file, file_bytes, FILIGREE_SECTION_META, &fil->meta);
    if (error != FILIGREE_LOOKUP_OK) return error;
    if (fil->meta.size < 8) return FILIGREE_LOOKUP_FILE;
    fil->encoding = fil->meta.bytes[0];
    fil->format = fil->meta.bytes[1];
    fil->map_count = filigree_load32(fil->meta.bytes + 4);
    if (fil->encoding > FILIGREE_VQ4_PLUS || fil->map_count >= 0x80000000u) return FILIGREE_LOOKUP_ENCODING;
    fil->index_bits = fil->encoding == FILIGREE_BITMASK ? 0 : filigree_bit_width_(fil->map_count + 3);
    error = filigree_fil_find(file, file_bytes, FILIGREE_SECTION_INDICES, &fil->indices);
    if (error == FILIGREE_LOOKUP_OK)
        error = filigree_fil_find(file, file_bytes, FILIGREE_SECTION_DESCRIPTORS, &fil->descriptors);
    if (error == FILIGREE_LOOKUP_OK)
        error = filigree_fil_find(file, file_bytes, FILIGREE_SECTION_PAYLOAD, &fil->payload);
    if (error != FILIGREE_LOOKUP_OK) return error;
    error = filigree_fil_find(file, file_bytes, FILIGREE_SECTION_PAIRS, &fil->pairs);
    return error == FILIGREE_LOOKUP_MISSING ? FILIGREE_LOOKUP_OK : error;
}

// The micromaps or textures of a file, for lookups.
FILIGREE_LOOKUP_INLINE filigree_lookup_error filigree_view_open_fil(filigree_view* set,
                                                                    const filigree_fil* fil) {
    return filigree_view_open(set, fil->encoding, fil->format, fil->map_count, fil->descriptors.bytes,
                              fil->descriptors.size, fil->payload.bytes, fil->payload.size);
}

// The squares of a file, for lookups.
FILIGREE_LOOKUP_INLINE filigree_lookup_error filigree_vq_open_fil(filigree_vq* squares,
                                                                  const filigree_fil* fil) {
    return filigree_vq_open(squares, fil->encoding, fil->map_count, fil->payload.bytes, fil->payload.size);
}

// The map, or the special index -1..-4, of a triangle, counted through all primitives of the file. Beyond the
// section -4, unknown-opaque.
FILIGREE_LOOKUP_INLINE int32_t filigree_fil_index(const filigree_fil* fil, uint64_t triangle) {
    const uint64_t first = triangle * fil->index_bits;
    uint64_t code = 0;
    uint64_t byte;
    if (fil->index_bits == 0 || first + fil->index_bits > (uint64_t)8 * fil->indices.size) return -4;
    for (byte = (first + fil->index_bits - 1) / 8 + 1; byte-- > first / 8;)
        code = code << 8 | fil->indices.bytes[(size_t)byte];
    code = (code >> (first % 8)) & (((uint64_t)1 << fil->index_bits) - 1);
    return code < 4 ? -1 - (int32_t)code : (int32_t)(code - 4);
}

// Where a triangle stands in its square: the low bit is its half, the others say which of its vertices stand
// as vertices 0, 1, 2 of that half (docs/spec/fil.md, "squares"). 0 beyond the section.
FILIGREE_LOOKUP_INLINE unsigned filigree_fil_place(const filigree_fil* fil, uint64_t triangle) {
    if (triangle / 2 >= fil->descriptors.size) return 0;
    return (unsigned)fil->descriptors.bytes[(size_t)(triangle / 2)] >> (triangle % 2 * 4) & 15u;
}

// The region of a square at weights u and v of vertices 1 and 2 of the triangle itself, `place` as above.
FILIGREE_LOOKUP_INLINE unsigned filigree_vq_at_triangle(const filigree_vq* view, uint32_t square,
                                                        unsigned place, float u, float v) {
    static const uint8_t orders[8][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1},
                                         {1, 0, 2}, {2, 1, 0}, {0, 1, 2}, {0, 1, 2}};
    const uint8_t* order = orders[place >> 1 & 7];
    float weights[3];
    weights[0] = 1 - u - v;
    weights[1] = u;
    weights[2] = v;
    return filigree_vq_at_point(view, square, place & 1u, weights[order[1]], weights[order[2]]);
}

// The first of a primitive's triangles, counted through all primitives of the file, and their number. `mesh`
// and `primitive` are those of the glTF file.
FILIGREE_LOOKUP_INLINE filigree_lookup_error filigree_fil_triangles(const filigree_fil* fil, uint32_t mesh,
                                                                    uint32_t primitive, uint64_t* first,
                                                                    uint32_t* count) {
    const uint8_t* meta = fil->meta.bytes;
    const size_t size = fil->meta.size;
    uint64_t at = 32;  // the name of the asset
    uint64_t sum = 0;
    uint32_t left;
    uint32_t k;
    *first = 0;
    *count = 0;
    if (size < at + 4) return FILIGREE_LOOKUP_FILE;
    at += 4 + (uint64_t)filigree_load32(meta + (size_t)at);
    if (at + 4 > size) return FILIGREE_LOOKUP_FILE;
    left = filigree_load32(meta + (size_t)at);
    // Groups: a name and 30 bytes.
    for (at += 4; left > 0; --left) {
        if (at + 4 > size) return FILIGREE_LOOKUP_FILE;
        at += 4 + (uint64_t)filigree_load32(meta + (size_t)at) + 30;
    }
    if (at + 4 > size) return FILIGREE_LOOKUP_FILE;
    left = filigree_load32(meta + (size_t)at);
    at += 4;
    if ((uint64_t)16 * left > size - at) return FILIGREE_LOOKUP_FILE;
    for (k = 0; k < left; ++k) {
        const uint8_t* entry = meta + (size_t)at + (size_t)16 * k;
        if (filigree_load32(entry) == mesh && filigree_load32(entry + 4) == primitive) {
            *first = sum;
            *count = filigree_load32(entry + 8);
            return FILIGREE_LOOKUP_OK;
        }
        sum += filigree_load32(entry + 8);
    }
    return FILIGREE_LOOKUP_MISSING;
}

#if defined(__cplusplus) && defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#endif
