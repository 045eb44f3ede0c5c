// Filigree from C, and from every language that calls C: opacity micromaps baked from alpha textures, their
// encodings, opacity squares, compressed vertex grids and rays against them. C99 and later, C++.
//
// Errors. Functions return FILIGREE_OK or say what went wrong; the last parameter, which may be NULL,
// receives the same with one line of text that names the parameter or the place in the data. On an error
// nothing is leaked, no handle is made (*out is NULL), and what was written to output memory is unspecified.
//
// Structs. Those that the caller fills begin with struct_size, the size in bytes that the caller was compiled
// with: FILIGREE_..._INIT sets it with the defaults, and so do the filigree_..._init() functions for other
// languages. Later versions add fields at the end only. A shorter struct of an earlier version is accepted,
// and its missing fields take their defaults; a longer one of a later version is accepted where all that this
// version does not know is zero, and otherwise refused with FILIGREE_ERROR_STRUCT. Structs that the library
// fills want struct_size set, too: fields beyond it are not written, fields that this version does not know
// become zero.
//
// Lists. Functions with `to`, `capacity` and `count` are asked for the size first, with `to` NULL and
// `capacity` 0, then fill: `capacity` and *count are in elements of `to`. *count is always set to what the
// list holds; with less capacity nothing is written and FILIGREE_ERROR_CAPACITY returned.
//
// Memory. Handles and all that they keep in proportion to their contents come from the context's allocator:
// micromaps, encoded sets, squares, blobs and indices of triangles. Not the records, hierarchies and
// attributes of grids, the cache of a tracer (some 100 KiB), and what a call needs while it runs: these come
// from C++'s operator new. Where either has no memory left, the call returns FILIGREE_ERROR_MEMORY.
//
// Threads. There is no global state. Handles may be used by any number of threads at once, but for a tracer,
// which is for one thread at a time, and destroying, which must come last. Nothing is printed, no file is
// touched, no thread is started but those that the context asks for.
#ifndef FILIGREE_H
#define FILIGREE_H

#include <stddef.h>
#include <stdint.h>

#ifndef FILIGREE_API
#if defined(_WIN32)
#define FILIGREE_API
#else
#define FILIGREE_API __attribute__((visibility("default")))
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

// The version of this header.
#define FILIGREE_VERSION_MAJOR 0
#define FILIGREE_VERSION_MINOR 1
#define FILIGREE_VERSION_PATCH 0

// The version of the library that runs: 10000 * major + 100 * minor + patch.
FILIGREE_API uint32_t filigree_version(void);

// ---- Errors

// What went wrong.
typedef enum filigree_error {
    FILIGREE_OK = 0,
    FILIGREE_ERROR_ARGUMENT = 1,     // NULL, a number out of its range, memory that overlaps
    FILIGREE_ERROR_STRUCT = 2,       // a struct_size of no version, or fields that this version does not know
    FILIGREE_ERROR_CAPACITY = 3,     // too little room for a list; *count says how much it takes
    FILIGREE_ERROR_MEMORY = 4,       // no memory left
    FILIGREE_ERROR_FORMAT = 5,       // bytes that break their format
    FILIGREE_ERROR_UNSUPPORTED = 6,  // legal input that this build cannot handle
    FILIGREE_ERROR_LIMIT = 7,        // more than a format or the machine can hold
    FILIGREE_ERROR_CANCELLED = 8,    // the progress callback asked to stop
    FILIGREE_ERROR_INTERNAL = 9      // a mistake in the library: please report it
} filigree_error;

// Of a filigree_error: "FILIGREE_ERROR_ARGUMENT"; "unknown error" for other numbers. Valid for ever.
FILIGREE_API const char* filigree_error_name(uint32_t error);

// Written by every call that gets one, on success too.
typedef struct filigree_error_info {
    size_t struct_size;  // at least 64; the message is cut where it does not fit
    uint32_t code;       // filigree_error
    char message[500];   // one line in UTF-8, ends with a zero; empty on success
} filigree_error_info;
#define FILIGREE_ERROR_INFO_INIT          \
    {                                     \
        sizeof(filigree_error_info), 0, { \
            0                             \
        }                                 \
    }

// ---- Context: threads and memory

// Calls body(work, begin, end) on ranges that together cover [0, count), each index once, in any order and on
// any threads, and returns when all calls have returned. A range should hold at most `grain` indices where
// the work is split. Calls may be nested: a body may come back to the callback. Nothing may be thrown or
// jumped through a body.
typedef void (*filigree_range_body)(void* work, size_t begin, size_t end);
typedef void (*filigree_parallel_for)(void* user, size_t count, size_t grain, filigree_range_body body,
                                      void* work);

// As malloc and free; NULL where there is no memory. Called on the thread that calls the library.
typedef void* (*filigree_allocate)(void* user, size_t bytes);
typedef void (*filigree_release)(void* user, void* memory);

// What a context is made with.
typedef struct filigree_context_settings {
    size_t struct_size;
    uint32_t threads;                    // of the library: 0 one for each processor, 1 the caller's alone
    uint32_t concurrency;                // with parallel_for: how many bodies may run at once, at least 1
    filigree_parallel_for parallel_for;  // the caller's threads, used instead; or NULL
    void* parallel_for_user;             // handed to it
    filigree_allocate allocate;          // both or neither
    filigree_release release;
    void* allocator_user;  // handed to both; must outlive the context and all that is made with it
} filigree_context_settings;
#define FILIGREE_CONTEXT_SETTINGS_INIT \
    { sizeof(filigree_context_settings), 1, 1, NULL, NULL, NULL, NULL, NULL }
FILIGREE_API filigree_error filigree_context_settings_init(filigree_context_settings* settings,
                                                           size_t struct_size);

// Where a context is a parameter, NULL stands for one of the defaults: the calling thread, malloc and free.
// Handles may outlive the context that they were made with, and results do not depend on it.
typedef struct filigree_context filigree_context;
FILIGREE_API filigree_error filigree_context_create(const filigree_context_settings* settings,
                                                    filigree_context** out, filigree_error_info* error);
FILIGREE_API void filigree_context_destroy(filigree_context* context);

// Tells how far long work is. The callback is called by one thread at a time, though not always the same, at
// the begin and the end of each stage and about every hundredth of it; `done` of `total` units are done, and
// `total` may be 0. What it returns stops the work unless it is 0: the call then returns
// FILIGREE_ERROR_CANCELLED soon.
typedef int (*filigree_progress_callback)(void* user, const char* stage, uint64_t done, uint64_t total);
typedef struct filigree_progress {
    size_t struct_size;
    filigree_progress_callback callback;  // or NULL
    void* user;
} filigree_progress;
#define FILIGREE_PROGRESS_INIT \
    { sizeof(filigree_progress), NULL, NULL }

// ---- Alpha images

// How the texels of an image stand in memory.
typedef enum filigree_texel {
    FILIGREE_TEXEL_U8 = 0,   // 0..255
    FILIGREE_TEXEL_U16 = 1,  // 0..65535, in the machine's byte order
    FILIGREE_TEXEL_F32 = 2   // 0..1, clamped and rounded to the nearest 1/65535; NaN is an error
} filigree_texel;

// What a sampler does outside of the image.
typedef enum filigree_wrap {
    FILIGREE_WRAP_REPEAT = 0,
    FILIGREE_WRAP_MIRRORED_REPEAT = 1,
    FILIGREE_WRAP_CLAMP_TO_EDGE = 2
} filigree_wrap;

// Which filters a shader may apply.
typedef enum filigree_filter {
    FILIGREE_FILTER_LINEAR = 0,
    FILIGREE_FILTER_NEAREST = 1,
    FILIGREE_FILTER_BOTH = 2  // of a sampler that magnifies and minifies differently: right under either
} filigree_filter;

// The alpha channel of a texture in the caller's memory, read during the call only. Row 0 lies at v = 0,
// texel (x, y) has its centre at u = (x + 0.5) / width, v = (y + 0.5) / height. Alpha is linear: sRGB does
// not touch it. Of RGBA8 pixels: texels = pixels + 3, texel_stride = 4.
typedef struct filigree_image {
    size_t struct_size;
    const void* texels;   // the alpha of texel (0, 0), at any address
    uint32_t width;       // texels, 1 to 65536
    uint32_t height;      // the same
    uint32_t texel;       // filigree_texel
    uint32_t wrap_u;      // filigree_wrap
    uint32_t wrap_v;      // filigree_wrap
    uint32_t filter;      // filigree_filter
    size_t texel_stride;  // bytes from a texel to the next of its row; 0: without gaps
    size_t row_stride;    // bytes from a row to the next; 0: without gaps
} filigree_image;
#define FILIGREE_IMAGE_INIT \
    { sizeof(filigree_image), NULL, 0, 0, 0, 0, 0, 0, 0, 0 }
FILIGREE_API filigree_error filigree_image_init(filigree_image* image, size_t struct_size);

// How a filtered alpha becomes a state.
typedef enum filigree_alpha_mode {
    FILIGREE_ALPHA_MASK = 0,  // opaque where alpha >= cutoff (glTF MASK)
    FILIGREE_ALPHA_BLEND = 1  // opaque where alpha is 1, transparent where it is 0 (glTF BLEND)
} filigree_alpha_mode;

// What "known" means: a known state is certain under all of this (docs/spec/bake.md). Where a pointer to it
// is a parameter, NULL stands for the defaults.
typedef struct filigree_alpha_test {
    size_t struct_size;
    uint32_t mode;  // filigree_alpha_mode
    uint32_t mips;  // a known state also holds at this many coarser mip levels, 0 to 32
    double cutoff;  // at least 0, for masks; above 1 everything is transparent
    double factor;  // 0 to 1, multiplies the texture's alpha (baseColorFactor.a)
    double guard;   // texels, 0 to 1024: how far around a micro-triangle its state holds, too
} filigree_alpha_test;
#define FILIGREE_ALPHA_TEST_INIT \
    { sizeof(filigree_alpha_test), FILIGREE_ALPHA_MASK, 0, 0.5, 1.0, 1.0 / 256 }
FILIGREE_API filigree_error filigree_alpha_test_init(filigree_alpha_test* test, size_t struct_size);

// ---- Baking micromaps

// Triangles with texture coordinates in the caller's memory, read during the call only.
typedef struct filigree_triangles {
    size_t struct_size;
    size_t triangle_count;
    const float* uvs;            // u, v of each vertex, in the machine's byte order, at any address
    size_t uv_stride;            // bytes from a vertex to the next; 0: 8
    const void* indices;         // [3 * triangle_count] vertices; NULL: 0 1 2, 3 4 5, ...
    uint32_t index_bytes;        // 1, 2 or 4, with indices
    uint32_t reserved;           // 0
    size_t vertex_count;         // with indices, all of which must lie below
    size_t triangle_stride;      // without indices: bytes from a triangle's uvs to the next's; 0: 3 uv_stride
    const float* vertex_alpha;   // 0 to 1, multiplies the texture's alpha (COLOR_0.a); NULL: 1 everywhere
    size_t vertex_alpha_stride;  // bytes from a vertex to the next; 0: 4
    const float* positions;      // x, y, z of each vertex: for squares, to find shared edges
    size_t position_stride;      // bytes from a vertex to the next; 0: 12
} filigree_triangles;
#define FILIGREE_TRIANGLES_INIT \
    { sizeof(filigree_triangles), 0, NULL, 0, NULL, 0, 0, 0, 0, NULL, 0, NULL, 0 }
FILIGREE_API filigree_error filigree_triangles_init(filigree_triangles* triangles, size_t struct_size);

// Numbers of the APIs. Bit 0: which side covers more. Bit 1: unknown.
typedef enum filigree_state {
    FILIGREE_STATE_TRANSPARENT = 0,
    FILIGREE_STATE_OPAQUE = 1,
    FILIGREE_STATE_UNKNOWN_TRANSPARENT = 2,
    FILIGREE_STATE_UNKNOWN_OPAQUE = 3
} filigree_state;

// A triangle that has one state throughout needs no map: its index is special, -1 - state.
#define FILIGREE_SPECIAL_INDEX(state) (-1 - (int32_t)(state))

// Levels: the greatest, and what stands for the highest useful one.
#define FILIGREE_MAX_LEVEL 12  // level L has 4^L micro-triangles
#define FILIGREE_LEVEL_AUTO (-1)

// How micromaps are baked.
typedef struct filigree_bake_settings {
    size_t struct_size;
    uint32_t states;        // 2 or 4
    int32_t level;          // of every map, 0 to 12; FILIGREE_LEVEL_AUTO: each triangle's highest useful one
    uint32_t max_level;     // 0 to 12, with FILIGREE_LEVEL_AUTO
    uint32_t rotate;        // 1: a triangle's vertices may rotate where it then shares a map; 0: not
    const uint8_t* levels;  // [triangle_count], 0 to 12 each; overrides level; or NULL
} filigree_bake_settings;
#define FILIGREE_BAKE_SETTINGS_INIT \
    { sizeof(filigree_bake_settings), 4, FILIGREE_LEVEL_AUTO, 8, 0, NULL }
FILIGREE_API filigree_error filigree_bake_settings_init(filigree_bake_settings* settings, size_t struct_size);

// Distinct micromaps, and for each triangle its index: a map, or special.
typedef struct filigree_micromaps filigree_micromaps;

// Bakes; the same micromaps whatever the context. `test` and `settings` may be NULL for the defaults.
// Triangles whose texture coordinates are NaN, infinite or too large become unknown-opaque.
FILIGREE_API filigree_error filigree_bake(const filigree_context* context,
                                          const filigree_triangles* triangles, const filigree_image* image,
                                          const filigree_alpha_test* test,
                                          const filigree_bake_settings* settings,
                                          const filigree_progress* progress, filigree_micromaps** out,
                                          filigree_error_info* error);
FILIGREE_API void filigree_micromaps_destroy(filigree_micromaps* maps);

// Micromaps that exist already, flat as Vulkan, DXR and glTF take them, in the caller's memory, read during
// the call only.
typedef struct filigree_flat_micromaps {
    size_t struct_size;
    const void* data;
    size_t data_bytes;
    const struct filigree_record* records;  // [record_count], each within the data
    size_t record_count;
    const int32_t* indices;  // [triangle_count], a record or special
    size_t triangle_count;
} filigree_flat_micromaps;
#define FILIGREE_FLAT_MICROMAPS_INIT \
    { sizeof(filigree_flat_micromaps), NULL, 0, NULL, 0, NULL, 0 }
FILIGREE_API filigree_error filigree_flat_micromaps_init(filigree_flat_micromaps* flat, size_t struct_size);

// Equal ones become one, those of one state throughout special. Four states where any record has four.
FILIGREE_API filigree_error filigree_micromaps_from_flat(const filigree_context* context,
                                                         const filigree_flat_micromaps* flat,
                                                         filigree_micromaps** out,
                                                         filigree_error_info* error);

// What a bake made.
typedef struct filigree_micromaps_info {
    size_t struct_size;
    uint64_t triangle_count;
    uint32_t states;     // 2 or 4
    uint32_t map_count;  // distinct ones; may be 0
    // What the lists below hold. The APIs allow no empty ones: where no triangle needs a map, there is one
    // record all the same, which no index names.
    uint64_t data_bytes;
    uint32_t record_count;
    uint32_t usage_count;
    uint32_t index_bytes;  // the smallest that serves: 1, 2 or 4
    uint32_t reserved;
    // Of a bake; 0 of other micromaps.
    uint64_t distinct_triangles;  // after equal ones are merged
    uint64_t unplaced_triangles;  // texture coordinates NaN, infinite or too large
    uint64_t micro_triangles;     // of all triangles
    uint64_t state_counts[4];     // how many of them have each filigree_state
} filigree_micromaps_info;
#define FILIGREE_MICROMAPS_INFO_INIT                                        \
    {                                                                       \
        sizeof(filigree_micromaps_info), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, { \
            0                                                               \
        }                                                                   \
    }
FILIGREE_API filigree_error filigree_micromaps_get_info(const filigree_micromaps* maps,
                                                        filigree_micromaps_info* info,
                                                        filigree_error_info* error);

// The 8-byte record of VkMicromapTriangleEXT, D3D12_RAYTRACING_OPACITY_MICROMAP_DESC and glTF, in the
// machine's byte order.
typedef struct filigree_record {
    uint32_t byte_offset;  // into the data
    uint16_t level;
    uint16_t format;  // 1: two states, 2: four states
} filigree_record;

// VkMicromapUsageEXT and D3D12_RAYTRACING_OPACITY_MICROMAP_HISTOGRAM_ENTRY.
typedef struct filigree_usage {
    uint32_t count;
    uint32_t level;
    uint32_t format;
} filigree_usage;

// What a usage counts.
typedef enum filigree_usage_of {
    FILIGREE_USAGE_OF_RECORDS = 0,   // to build the array of micromaps
    FILIGREE_USAGE_OF_TRIANGLES = 1  // to build the geometry that uses it: triangles that name a record
} filigree_usage_of;

// The flat lists; `of` is a filigree_usage_of. LIMIT where the data pass 4 GiB - 1, the reach of the records.
FILIGREE_API filigree_error filigree_micromaps_get_data(const filigree_micromaps* maps, void* to,
                                                        size_t capacity, size_t* count,
                                                        filigree_error_info* error);
FILIGREE_API filigree_error filigree_micromaps_get_records(const filigree_micromaps* maps,
                                                           filigree_record* to, size_t capacity,
                                                           size_t* count, filigree_error_info* error);
FILIGREE_API filigree_error filigree_micromaps_get_usage(const filigree_micromaps* maps, uint32_t of,
                                                         filigree_usage* to, size_t capacity, size_t* count,
                                                         filigree_error_info* error);

// [triangle_count] indices of `index_bytes` bytes each: 4 signed, 1 and 2 as APIs take them, special ones in
// two's complement. `capacity` and *count are indices. LIMIT where they need more bytes.
FILIGREE_API filigree_error filigree_micromaps_get_indices(const filigree_micromaps* maps,
                                                           uint32_t index_bytes, void* to, size_t capacity,
                                                           size_t* count, filigree_error_info* error);

// [triangle_count] of a bake, none of other micromaps. Levels: those that triangles were baked at, special or
// not. Rotations, of bakes with `rotate` alone: vertex k of the map is vertex (k + r) % 3 of the triangle.
FILIGREE_API filigree_error filigree_micromaps_get_levels(const filigree_micromaps* maps, uint8_t* to,
                                                          size_t capacity, size_t* count,
                                                          filigree_error_info* error);
FILIGREE_API filigree_error filigree_micromaps_get_rotations(const filigree_micromaps* maps, uint8_t* to,
                                                             size_t capacity, size_t* count,
                                                             filigree_error_info* error);

// ---- Encoded sets

// docs/spec/ has a page for each.
typedef enum filigree_encoding {
    FILIGREE_ENCODING_FLAT = 0,
    FILIGREE_ENCODING_GRUEN = 1,
    FILIGREE_ENCODING_BITMASK = 2,  // of textures, not of micromaps
    FILIGREE_ENCODING_TREE = 3,
    FILIGREE_ENCODING_INDEXED_TREE = 4,
    FILIGREE_ENCODING_DAG = 5,
    FILIGREE_ENCODING_SDAG = 6  // the smallest
} filigree_encoding;

// How micromaps are encoded.
typedef struct filigree_encode_settings {
    size_t struct_size;
    uint32_t encoding;  // filigree_encoding, but BITMASK
    uint32_t states;    // 2, 4, or 0: as the micromaps have. 2 keeps the sides of unknown states
    // 1: keep the opaque share of interior nodes (SDAG).
    uint32_t aggregates;
    // 1: a set bit of GRUEN with 2 states means "not known to be transparent" and reads as unknown-opaque.
    uint32_t maybe_opaque;
    // Gives known parts up where that saves most (docs/spec/lossy.md); at most one. With 4 states no known
    // state is ever wrong.
    uint64_t max_bytes;    // of the set; 0: lossless
    double max_cost;       // sum of weight times the share of micro-triangles given up; below 0: lossless
    const float* weights;  // [triangle_count], at least 0: how much each triangle matters; NULL: 1 each
} filigree_encode_settings;
#define FILIGREE_ENCODE_SETTINGS_INIT \
    { sizeof(filigree_encode_settings), FILIGREE_ENCODING_SDAG, 0, 0, 0, 0, -1.0, NULL }
FILIGREE_API filigree_error filigree_encode_settings_init(filigree_encode_settings* settings,
                                                          size_t struct_size);

// Micromaps in one encoding with the triangles' indices, or textures as bitmasks: to look up and to keep.
typedef struct filigree_set filigree_set;

// The same bytes whatever the context. LIMIT where the set outgrows the encoding's offsets, or cannot keep to
// max_bytes: the message names the fewest bytes then.
FILIGREE_API filigree_error filigree_encode(const filigree_context* context, const filigree_micromaps* maps,
                                            const filigree_encode_settings* settings,
                                            const filigree_progress* progress, filigree_set** out,
                                            filigree_error_info* error);

// Each cell between the texels of a texture as one state: "map" 0 of the set, looked up by texture
// coordinates. `states` is 2 or 4. The guard is at most 8 texels.
FILIGREE_API filigree_error filigree_encode_bitmask(const filigree_context* context,
                                                    const filigree_image* image,
                                                    const filigree_alpha_test* test, uint32_t states,
                                                    const filigree_progress* progress, filigree_set** out,
                                                    filigree_error_info* error);

FILIGREE_API void filigree_set_destroy(filigree_set* set);

// A set as bytes. With the three numbers they are all that lookups need.
typedef struct filigree_set_blocks {
    size_t struct_size;
    uint32_t encoding;  // filigree_encoding
    uint32_t states;    // 2 or 4
    uint32_t map_count;
    uint32_t reserved;
    const uint8_t* descriptors;  // what is stored once for each map, at any address
    size_t descriptor_bytes;
    const uint8_t* payload;  // all else
    size_t payload_bytes;
} filigree_set_blocks;
#define FILIGREE_SET_BLOCKS_INIT \
    { sizeof(filigree_set_blocks), 0, 4, 0, 0, NULL, 0, NULL, 0 }
FILIGREE_API filigree_error filigree_set_blocks_init(filigree_set_blocks* blocks, size_t struct_size);

// The blocks of a set; the pointers are valid as long as the set.
FILIGREE_API filigree_error filigree_set_get_blocks(const filigree_set* set, filigree_set_blocks* blocks,
                                                    filigree_error_info* error);

// A set that looks into the caller's blocks, which must outlive it; all of them are checked first. It has no
// indices.
FILIGREE_API filigree_error filigree_set_open(const filigree_context* context,
                                              const filigree_set_blocks* blocks, filigree_set** out,
                                              filigree_error_info* error);

// What an encoded set holds.
typedef struct filigree_set_info {
    size_t struct_size;
    uint32_t encoding;  // filigree_encoding
    uint32_t states;    // 2 or 4
    uint32_t map_count;
    uint32_t reserved;
    uint64_t bytes;           // descriptors and payload: what stays in memory while rays are traced
    uint64_t triangle_count;  // that it has indices for
} filigree_set_info;
#define FILIGREE_SET_INFO_INIT \
    { sizeof(filigree_set_info), 0, 0, 0, 0, 0, 0 }
FILIGREE_API filigree_error filigree_set_get_info(const filigree_set* set, filigree_set_info* info,
                                                  filigree_error_info* error);

// [triangle_count]: a map of the set, or special.
FILIGREE_API filigree_error filigree_set_get_indices(const filigree_set* set, int32_t* to, size_t capacity,
                                                     size_t* count, filigree_error_info* error);

// [map_count] levels; none of a bitmask.
FILIGREE_API filigree_error filigree_set_get_levels(const filigree_set* set, uint8_t* to, size_t capacity,
                                                    size_t* count, filigree_error_info* error);

// All maps of a set back as micromaps, with its indices. UNSUPPORTED for a bitmask.
FILIGREE_API filigree_error filigree_decode(const filigree_context* context, const filigree_set* set,
                                            filigree_micromaps** out, filigree_error_info* error);

// One map flat, as filigree_micromaps_get_data has it.
FILIGREE_API filigree_error filigree_set_get_map(const filigree_set* set, uint32_t map, uint8_t* to,
                                                 size_t capacity, size_t* count, filigree_error_info* error);

// ---- Looking states up

// A filigree_state, or -1 where `set` is NULL or has no such map, triangle or micro-triangle.
//
// At a point: u and v are the weights of vertices 1 and 2 as ray tracers give them, clamped to the triangle,
// NaN counts as 0; of a bitmask they are texture coordinates.
FILIGREE_API int filigree_set_state(const filigree_set* set, uint32_t map, float u, float v);
// Of micro-triangle `index` < 4^level, counted along the curve of VK_EXT_opacity_micromap. Not of a bitmask.
FILIGREE_API int filigree_set_state_at(const filigree_set* set, uint32_t map, uint32_t index);
// Of a triangle through the set's indices.
FILIGREE_API int filigree_set_triangle_state(const filigree_set* set, size_t triangle, float u, float v);

// The same of many: maps[k] at (u[k], v[k]), or at indices[k], into states[k] for all k < count, in SIMD.
// `states` may not overlap the others.
FILIGREE_API filigree_error filigree_set_lookup(const filigree_set* set, size_t count, const uint32_t* maps,
                                                const float* u, const float* v, uint8_t* states,
                                                filigree_error_info* error);
FILIGREE_API filigree_error filigree_set_lookup_at(const filigree_set* set, size_t count,
                                                   const uint32_t* maps, const uint32_t* indices,
                                                   uint8_t* states, filigree_error_info* error);

// The curve index of the micro-triangle that holds a point; level 0 to 12, otherwise UINT32_MAX.
FILIGREE_API uint32_t filigree_curve_index(float u, float v, uint32_t level);

// ---- Opacity squares

// Three-state squares of pairs of triangles (Fenney and Ozkan 2023): docs/spec/vq2.md, docs/spec/vq4.md.
typedef enum filigree_square_format {
    FILIGREE_SQUARE_VQ2 = 0,       // 16 x 16 regions in 32 bytes
    FILIGREE_SQUARE_VQ2_PLUS = 1,  // the same, smaller loss
    FILIGREE_SQUARE_VQ4 = 2,       // 32 x 32 regions in 64 bytes
    FILIGREE_SQUARE_VQ4_PLUS = 3
} filigree_square_format;

// What is known of a region of a square.
typedef enum filigree_region {
    FILIGREE_REGION_TRANSPARENT = 0,
    FILIGREE_REGION_MIXED = 1,
    FILIGREE_REGION_OPAQUE = 2
} filigree_region;

// Opacity squares of pairs of triangles.
typedef struct filigree_squares filigree_squares;

// Pairs the triangles over shared edges and encodes a square for each pair, equal ones once, in a
// filigree_square_format; the same
// whatever the context. Vertices are one where their positions are equal, or their texture coordinates where
// `triangles` has no positions. Where C++'s own memory runs out in the midst of the pairing, LEMON, which
// does it, may lose a few bytes.
FILIGREE_API filigree_error filigree_squares_encode(const filigree_context* context,
                                                    const filigree_triangles* triangles,
                                                    const filigree_image* image,
                                                    const filigree_alpha_test* test, uint32_t format,
                                                    const filigree_progress* progress, filigree_squares** out,
                                                    filigree_error_info* error);
FILIGREE_API void filigree_squares_destroy(filigree_squares* squares);

// What squares hold.
typedef struct filigree_squares_info {
    size_t struct_size;
    uint64_t triangle_count;
    uint32_t format;       // filigree_square_format
    uint32_t side;         // regions along an edge
    uint32_t block_count;  // may be 0
    uint32_t block_bytes;  // of each
} filigree_squares_info;
#define FILIGREE_SQUARES_INFO_INIT \
    { sizeof(filigree_squares_info), 0, 0, 0, 0, 0 }
FILIGREE_API filigree_error filigree_squares_get_info(const filigree_squares* squares,
                                                      filigree_squares_info* info,
                                                      filigree_error_info* error);

// [block_count * block_bytes] bytes.
FILIGREE_API filigree_error filigree_squares_get_blocks(const filigree_squares* squares, uint8_t* to,
                                                        size_t capacity, size_t* count,
                                                        filigree_error_info* error);
// [triangle_count] each. Indices: a block, or special: -1 transparent, -2 opaque, -4 mixed throughout.
// Places: bit 0 is the half of the square, 0 or 1; bits 1 to 3 say which of the triangle's vertices stand as
// its vertices 0, 1 and 2: 012, 120, 201, 021, 102 or 210 (docs/spec/vq2.md).
FILIGREE_API filigree_error filigree_squares_get_indices(const filigree_squares* squares, int32_t* to,
                                                         size_t capacity, size_t* count,
                                                         filigree_error_info* error);
FILIGREE_API filigree_error filigree_squares_get_places(const filigree_squares* squares, uint8_t* to,
                                                        size_t capacity, size_t* count,
                                                        filigree_error_info* error);

// The filigree_region at the weights u and v of a triangle's vertices 1 and 2, or -1 where `squares` is NULL
// or has no such triangle.
FILIGREE_API int filigree_squares_triangle_region(const filigree_squares* squares, size_t triangle, float u,
                                                  float v);

// Of many blocks and halves (0 or 1), at the weights of the half's vertices 1 and 2, into regions[k] for all
// k < count, in SIMD. `regions` may not overlap the others.
FILIGREE_API filigree_error filigree_squares_lookup(const filigree_squares* squares, size_t count,
                                                    const uint32_t* blocks, const uint8_t* halves,
                                                    const float* u, const float* v, uint8_t* regions,
                                                    filigree_error_info* error);

// ---- Vertex grids

// A mesh in the caller's memory, read during the call only.
typedef struct filigree_mesh {
    size_t struct_size;
    const float* positions;  // x, y, z of each vertex, world units, finite; at any address, as all here
    size_t position_stride;  // bytes from a vertex to the next; 0: 12
    size_t vertex_count;
    const void* indices;     // [face_vertices * face_count]; NULL: 0 1 2, 3 4 5, ...
    uint32_t index_bytes;    // 1, 2 or 4, with indices
    uint32_t face_vertices;  // 3, or 4: the triangles 0 1 2 and 0 2 3 of each quad. A fourth index of the
                             // greatest number of its type: the face is a triangle
    size_t face_count;
    const float* normals;  // x, y, z of each vertex; or NULL
    size_t normal_stride;  // 0: 12
    const float* uvs;      // u, v of each vertex; or NULL
    size_t uv_stride;      // 0: 8
} filigree_mesh;
#define FILIGREE_MESH_INIT \
    { sizeof(filigree_mesh), NULL, 0, 0, NULL, 0, 3, 0, NULL, 0, NULL, 0 }
FILIGREE_API filigree_error filigree_mesh_init(filigree_mesh* mesh, size_t struct_size);

// A heightfield in the caller's memory, read during the call only: vertex (column, row) stands at (column *
// cell, height * height_scale, row * cell). Triangles 2 q and 2 q + 1 make quad q, row by row.
typedef struct filigree_heightfield {
    size_t struct_size;
    const void* heights;   // the height at (0, 0), at any address
    uint32_t columns;      // vertices, 2 to 65536
    uint32_t rows;         // the same
    uint32_t type;         // filigree_texel, F32 of any finite value
    uint32_t reserved;     // 0
    size_t height_stride;  // bytes from a height to the next of its row; 0: without gaps
    size_t row_stride;     // bytes from a row to the next; 0: without gaps
    double cell;           // world units, above 0
    double height_scale;   // world units, not 0
} filigree_heightfield;
#define FILIGREE_HEIGHTFIELD_INIT \
    { sizeof(filigree_heightfield), NULL, 0, 0, 0, 0, 0, 0, 1.0, 1.0 }
FILIGREE_API filigree_error filigree_heightfield_init(filigree_heightfield* heightfield, size_t struct_size);

// How the records of grids are written.
typedef enum filigree_grid_codec {
    FILIGREE_GRID_PAPER = 0,   // Benthin, Vaidyanathan and Woop 2021: docs/spec/paper.md
    FILIGREE_GRID_LATTICE = 1  // no cracks, smaller: docs/spec/lattice.md
} filigree_grid_codec;

// How far decoded vertices may lie from their sources.
typedef enum filigree_grid_precision {
    FILIGREE_GRID_MATCH_PAPER = 0,      // the root mean square error of PAPER on the same grids
    FILIGREE_GRID_MAX_ERROR = 1,        // max_error, world units
    FILIGREE_GRID_MAX_ERROR_SHARE = 2,  // max_error, of the diagonal of the box around all vertices
    FILIGREE_GRID_LOSSLESS = 3          // to the bit; UNSUPPORTED where no lattice holds the vertices
} filigree_grid_precision;

// How grids are made.
typedef struct filigree_grid_settings {
    size_t struct_size;
    uint32_t codec;            // filigree_grid_codec
    uint32_t precision;        // filigree_grid_precision, of LATTICE
    double max_error;          // above 0, where the precision wants it
    uint32_t shared_exponent;  // 1: displacements of PAPER with a shared exponent; 0: unit vectors
    uint32_t snap;             // 1: PAPER cuts sub-grids where the surface would crack
    uint32_t turn_quads;       // 1: quads may be cut along either diagonal
    uint32_t attributes;       // 1: keep normals, texture coordinates and sources
    uint32_t measure;          // 1: measure the errors of filigree_grids_info
    uint32_t reserved;         // 0
} filigree_grid_settings;
#define FILIGREE_GRID_SETTINGS_INIT                                                                        \
    {                                                                                                      \
        sizeof(filigree_grid_settings), FILIGREE_GRID_LATTICE, FILIGREE_GRID_MATCH_PAPER, 0.0, 0, 0, 0, 1, \
            1, 0                                                                                           \
    }
FILIGREE_API filigree_error filigree_grid_settings_init(filigree_grid_settings* settings, size_t struct_size);

// Every triangle of a mesh, compressed, under a hierarchy: to trace rays against.
typedef struct filigree_grids filigree_grids;

// The same bytes whatever the context.
FILIGREE_API filigree_error filigree_grids_create(const filigree_context* context, const filigree_mesh* mesh,
                                                  const filigree_grid_settings* settings,
                                                  const filigree_progress* progress, filigree_grids** out,
                                                  filigree_error_info* error);
FILIGREE_API filigree_error filigree_grids_create_from_heights(const filigree_context* context,
                                                               const filigree_heightfield* heights,
                                                               const filigree_grid_settings* settings,
                                                               const filigree_progress* progress,
                                                               filigree_grids** out,
                                                               filigree_error_info* error);
FILIGREE_API void filigree_grids_destroy(filigree_grids* grids);

// What grids hold.
typedef struct filigree_grids_info {
    size_t struct_size;
    uint32_t codec;  // filigree_grid_codec
    uint32_t grid_count;
    uint64_t triangle_count;  // of grids and loose
    uint64_t loose_count;
    uint64_t geometry_bytes;   // what stays in memory while rays are traced: the records of grids,
    uint64_t hierarchy_bytes;  // the hierarchy over all records,
    uint64_t cluster_bytes;    // and the records of loose triangles
    uint64_t attribute_bytes;  // for shading
    double rms_error;          // distance of decoded vertices from their sources, world units; -1: not known
    double max_error;
} filigree_grids_info;
#define FILIGREE_GRIDS_INFO_INIT \
    { sizeof(filigree_grids_info), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 }
FILIGREE_API filigree_error filigree_grids_get_info(const filigree_grids* grids, filigree_grids_info* info,
                                                    filigree_error_info* error);

// A decoded triangle.
typedef struct filigree_grid_triangle {
    float positions[3][3];  // world units
    uint32_t source;  // of the mesh: faces in order, a quad's two one after the other; or, where sources
                      // were not kept, its own number in this list
} filigree_grid_triangle;

// [triangle_count]: those of grids, two for each quad, row by row, then loose ones.
FILIGREE_API filigree_error filigree_grids_get_triangles(const filigree_grids* grids,
                                                         filigree_grid_triangle* to, size_t capacity,
                                                         size_t* count, filigree_error_info* error);

// ---- Rays

// Points origin + t * direction with t_min <= t <= t_max, world units. A ray that is not finite (but for
// t_max), has no direction or t_min > t_max hits nothing.
typedef struct filigree_ray {
    float origin[3];
    float direction[3];  // of any length
    float t_min;
    float t_max;
} filigree_ray;

// What filigree_hit.grid says besides a grid.
#define FILIGREE_NO_GRID 0xffffffffu     // nothing is hit
#define FILIGREE_LOOSE_GRID 0xfffffffeu  // a loose triangle: its number is `column`

// What a ray hits.
typedef struct filigree_hit {
    float t;          // infinite where nothing is hit
    uint32_t grid;    // or one of the two above
    uint32_t column;  // of the quad
    uint32_t row;
    uint32_t half;  // 0 or 1: which triangle of the quad
    float u;        // weights of the triangle's vertices 1 and 2
    float v;
    float normal[3];  // of the triangle, not of length 1
    uint32_t source;  // as filigree_grid_triangle has it
} filigree_hit;

// For one thread at a time: make one for each. It looks into the grids, which must outlive it.
typedef struct filigree_tracer filigree_tracer;
FILIGREE_API filigree_error filigree_tracer_create(const filigree_context* context,
                                                   const filigree_grids* grids, filigree_tracer** out,
                                                   filigree_error_info* error);
FILIGREE_API void filigree_tracer_destroy(filigree_tracer* tracer);

// The nearest hits of `count` rays into hits[0..count); and whether they hit anything, 1 or 0, into answers.
// Strides are in bytes, 0: without gaps; a stride is a multiple of 4. Many rays at a time take less time
// each: while one waits for memory, another computes. Outputs may not overlap the rays. An answer never
// depends on the other rays.
FILIGREE_API filigree_error filigree_tracer_closest(filigree_tracer* tracer, size_t count,
                                                    const filigree_ray* rays, size_t ray_stride,
                                                    filigree_hit* hits, size_t hit_stride,
                                                    filigree_error_info* error);
FILIGREE_API filigree_error filigree_tracer_any(filigree_tracer* tracer, size_t count,
                                                const filigree_ray* rays, size_t ray_stride, uint8_t* answers,
                                                filigree_error_info* error);

// What a hit says of the surface.
typedef struct filigree_surface {
    size_t struct_size;
    float grid_u;  // across the grid and down, 0 to 1; 0 of loose triangles
    float grid_v;
    uint32_t has_normal;  // 1 where the grids keep normals
    uint32_t has_uv;
    float normal[3];  // not of length 1
    float uv[2];
} filigree_surface;
#define FILIGREE_SURFACE_INIT                        \
    {                                                \
        sizeof(filigree_surface), 0, 0, 0, 0, {0}, { \
            0                                        \
        }                                            \
    }
FILIGREE_API filigree_error filigree_grids_get_surface(const filigree_grids* grids, const filigree_hit* hit,
                                                       filigree_surface* surface, filigree_error_info* error);

// ---- Containers: .fil in memory (docs/spec/fil.md)

// What a container holds.
typedef enum filigree_container {
    FILIGREE_CONTAINER_SET = 0,
    FILIGREE_CONTAINER_SQUARES = 1,
    FILIGREE_CONTAINER_GRIDS = 2
} filigree_container;

// How a container is written.
typedef struct filigree_container_settings {
    size_t struct_size;
    const char* asset_name;           // of the file that the contents were made from, UTF-8; NULL: none
    const void* asset;                // its bytes, of which size and hash are recorded; or NULL
    size_t asset_bytes;               // of them
    const filigree_alpha_test* test;  // that maps were made with, recorded; NULL: not known
    uint32_t zstd;                    // 1: compress each section that becomes smaller
    uint32_t reserved;                // 0
} filigree_container_settings;
#define FILIGREE_CONTAINER_SETTINGS_INIT \
    { sizeof(filigree_container_settings), NULL, NULL, 0, NULL, 0, 0 }
FILIGREE_API filigree_error filigree_container_settings_init(filigree_container_settings* settings,
                                                             size_t struct_size);

// Bytes that the library made. Data is NULL and size 0 for NULL.
typedef struct filigree_blob filigree_blob;
FILIGREE_API const void* filigree_blob_data(const filigree_blob* blob);
FILIGREE_API size_t filigree_blob_size(const filigree_blob* blob);
FILIGREE_API void filigree_blob_destroy(filigree_blob* blob);

// To a container; same contents and settings, same bytes. The triangles become one primitive.
FILIGREE_API filigree_error filigree_set_serialise(const filigree_context* context, const filigree_set* set,
                                                   const filigree_container_settings* settings,
                                                   filigree_blob** out, filigree_error_info* error);
FILIGREE_API filigree_error filigree_squares_serialise(const filigree_context* context,
                                                       const filigree_squares* squares,
                                                       const filigree_container_settings* settings,
                                                       filigree_blob** out, filigree_error_info* error);
FILIGREE_API filigree_error filigree_grids_serialise(const filigree_context* context,
                                                     const filigree_grids* grids,
                                                     const filigree_container_settings* settings,
                                                     filigree_blob** out, filigree_error_info* error);

// And back: everything is checked, and nothing looks into `bytes` afterwards. FORMAT names the section and
// the place in it. UNSUPPORTED for maps that are one bit and a pair of states.
FILIGREE_API filigree_error filigree_set_parse(const filigree_context* context, const void* bytes,
                                               size_t size, filigree_set** out, filigree_error_info* error);
FILIGREE_API filigree_error filigree_squares_parse(const filigree_context* context, const void* bytes,
                                                   size_t size, filigree_squares** out,
                                                   filigree_error_info* error);
FILIGREE_API filigree_error filigree_grids_parse(const filigree_context* context, const void* bytes,
                                                 size_t size, filigree_grids** out,
                                                 filigree_error_info* error);

// FILIGREE_OK for a container that keeps all rules, otherwise the first breach. *kind, where `kind` is not
// NULL, becomes what it claims to hold; with FILIGREE_ERROR_FORMAT that may be a guess.
FILIGREE_API filigree_error filigree_validate(const filigree_context* context, const void* bytes, size_t size,
                                              filigree_container* kind, filigree_error_info* error);

// The triangles of a parsed container belong to primitives of a file, one after another. Sets and squares
// that were made here have one: mesh 0, primitive 0.
typedef struct filigree_primitive {
    uint32_t mesh;       // into glTF meshes
    uint32_t primitive;  // into the mesh's primitives
    uint32_t triangles;
} filigree_primitive;
FILIGREE_API filigree_error filigree_set_get_primitives(const filigree_set* set, filigree_primitive* to,
                                                        size_t capacity, size_t* count,
                                                        filigree_error_info* error);
FILIGREE_API filigree_error filigree_squares_get_primitives(const filigree_squares* squares,
                                                            filigree_primitive* to, size_t capacity,
                                                            size_t* count, filigree_error_info* error);

#ifdef __cplusplus
}
#endif

#endif
