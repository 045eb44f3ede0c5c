// What callers get wrong: every function says so, and makes nothing.
#include "check.h"
#include "samples.h"
#include "suites.h"

#include <math.h>
#include <string.h>

static filigree_error_info error = FILIGREE_ERROR_INFO_INIT;

static filigree_error bakeWith(const filigree_triangles* triangles, const filigree_image* image,
                               const filigree_alpha_test* test, const filigree_bake_settings* settings) {
    filigree_micromaps* maps = (filigree_micromaps*)&error;
    const filigree_error code = filigree_bake(NULL, triangles, image, test, settings, NULL, &maps, &error);
    CHECK(code == FILIGREE_OK || maps == NULL);
    if (code == FILIGREE_OK) filigree_micromaps_destroy(maps);
    return code;
}

#define BAD(call) CHECK_CODE(FILIGREE_ERROR_ARGUMENT, &error, call)

// One field of a struct at a time.
#define BAD_FIELD(type, init, field, value, call) \
    do {                                          \
        type given = init;                        \
        given.field = value;                      \
        BAD(call);                                \
    } while (0)

static void checkImages(void) {
    const filigree_triangles triangles = leafTriangleList();
    static const float notANumber[2] = {NAN, 0};
#define BAD_IMAGE(field, value) \
    BAD_FIELD(filigree_image, leafImage(), field, value, bakeWith(&triangles, &given, NULL, NULL))
    BAD(bakeWith(&triangles, NULL, NULL, NULL));
    BAD_IMAGE(texels, NULL);
    BAD_IMAGE(width, 0);
    BAD_IMAGE(height, 0);
    BAD_IMAGE(width, 65537);
    BAD_IMAGE(texel, 3);
    BAD_IMAGE(wrap_u, 3);
    BAD_IMAGE(wrap_v, 77);
    BAD_IMAGE(filter, 3);
    filigree_image image = FILIGREE_IMAGE_INIT;
    image.texels = notANumber;
    image.width = 1;
    image.height = 2;
    image.texel = FILIGREE_TEXEL_F32;
    BAD(bakeWith(&triangles, &image, NULL, NULL));
    CHECK(strstr(error.message, "(0, 0)") != NULL);
#undef BAD_IMAGE
}

static void checkTests(void) {
    const filigree_triangles triangles = leafTriangleList();
    const filigree_image image = leafImage();
    const filigree_alpha_test defaults = FILIGREE_ALPHA_TEST_INIT;
#define BAD_TEST(field, value) \
    BAD_FIELD(filigree_alpha_test, defaults, field, value, bakeWith(&triangles, &image, &given, NULL))
    BAD_TEST(mode, 2);
    BAD_TEST(mips, 33);
    BAD_TEST(cutoff, -0.1);
    BAD_TEST(cutoff, NAN);
    BAD_TEST(factor, 1.5);
    BAD_TEST(guard, -1);
    BAD_TEST(guard, INFINITY);
#undef BAD_TEST
}

static void checkTriangles(void) {
    static const float alpha[11] = {1, 1, 1, 1, 1, 1.5F, 1, 1, 1, 1, 1};
    static const uint8_t levels[leafTriangles] = {1, 2, 3, 13, 1, 1};
    const filigree_image image = leafImage();
    const filigree_bake_settings defaults = FILIGREE_BAKE_SETTINGS_INIT;
    const filigree_triangles triangles = leafTriangleList();
#define BAD_TRIANGLES(field, value) \
    BAD_FIELD(filigree_triangles, leafTriangleList(), field, value, bakeWith(&given, &image, NULL, NULL))
    BAD(bakeWith(NULL, &image, NULL, NULL));
    BAD_TRIANGLES(uvs, NULL);
    BAD_TRIANGLES(index_bytes, 3);
    BAD_TRIANGLES(index_bytes, 0);
    BAD_TRIANGLES(vertex_count, 10);
    BAD_TRIANGLES(triangle_count, SIZE_MAX);
    BAD_TRIANGLES(vertex_alpha, alpha);
#undef BAD_TRIANGLES
#define BAD_SETTING(field, value) \
    BAD_FIELD(filigree_bake_settings, defaults, field, value, bakeWith(&triangles, &image, NULL, &given))
    BAD_SETTING(states, 3);
    BAD_SETTING(level, 13);
    BAD_SETTING(level, -2);
    BAD_SETTING(max_level, 13);
    BAD_SETTING(rotate, 2);
    BAD_SETTING(levels, levels);
#undef BAD_SETTING
    filigree_triangles none = FILIGREE_TRIANGLES_INIT;
    CHECK_CODE(FILIGREE_OK, &error, bakeWith(&none, &image, NULL, NULL));
    BAD(filigree_bake(NULL, &none, &image, NULL, NULL, NULL, NULL, &error));
}

static void checkLists(void) {
    filigree_micromaps* maps = bakedLeaf(NULL);
    filigree_micromaps_info info = FILIGREE_MICROMAPS_INFO_INIT;
    size_t count = 0;
    union {
        uint8_t bytes[4096];
        size_t count;
    } both;
    BAD(filigree_micromaps_get_info(NULL, &info, &error));
    BAD(filigree_micromaps_get_info(maps, NULL, &error));
    info.struct_size = 12;
    CHECK_CODE(FILIGREE_ERROR_STRUCT, &error, filigree_micromaps_get_info(maps, &info, &error));
    BAD(filigree_micromaps_get_data(NULL, NULL, 0, &count, &error));
    BAD(filigree_micromaps_get_data(maps, NULL, 0, NULL, &error));
    BAD(filigree_micromaps_get_data(maps, NULL, 10, &count, &error));
    BAD(filigree_micromaps_get_data(maps, both.bytes, sizeof both, &both.count, &error));
    BAD(filigree_micromaps_get_records(NULL, NULL, 0, &count, &error));
    BAD(filigree_micromaps_get_records(maps, (filigree_record*)(void*)both.bytes, SIZE_MAX, &count, &error));
    BAD(filigree_micromaps_get_usage(maps, 2, NULL, 0, &count, &error));
    BAD(filigree_micromaps_get_usage(NULL, FILIGREE_USAGE_OF_RECORDS, NULL, 0, &count, &error));
    BAD(filigree_micromaps_get_indices(maps, 3, NULL, 0, &count, &error));
    BAD(filigree_micromaps_get_indices(NULL, 4, NULL, 0, &count, &error));
    CHECK_CODE(FILIGREE_ERROR_CAPACITY, &error,
               filigree_micromaps_get_indices(maps, 4, both.bytes, leafTriangles - 1, &count, &error));
    CHECK(count == leafTriangles);
    BAD(filigree_micromaps_get_levels(NULL, NULL, 0, &count, &error));
    BAD(filigree_micromaps_get_rotations(NULL, NULL, 0, &count, &error));
    filigree_micromaps_destroy(maps);
    BAD(filigree_micromaps_from_flat(NULL, NULL, &maps, &error));
    CHECK(maps == NULL);
}

static void checkSets(void) {
    filigree_micromaps* maps = bakedLeaf(NULL);
    filigree_set* set = encodedLeaf(NULL, FILIGREE_ENCODING_FLAT);
    filigree_set* made = NULL;
    const filigree_encode_settings defaults = FILIGREE_ENCODE_SETTINGS_INIT;
    const filigree_set_blocks noBlocks = FILIGREE_SET_BLOCKS_INIT;
    const filigree_image image = leafImage();
    static const float weights[leafTriangles] = {1, 1, -1, 1, 1, 1};
    size_t count = 0;
    union {
        uint32_t maps[8];
        float weights[8];
        uint8_t states[32];
    } lists;
    memset(&lists, 0, sizeof lists);
#define BAD_ENCODE(field, value)                                \
    BAD_FIELD(filigree_encode_settings, defaults, field, value, \
              filigree_encode(NULL, maps, &given, NULL, &made, &error))
    BAD(filigree_encode(NULL, NULL, NULL, NULL, &made, &error));
    BAD(filigree_encode(NULL, maps, NULL, NULL, NULL, &error));
    BAD_ENCODE(encoding, 7);
    BAD_ENCODE(encoding, FILIGREE_ENCODING_BITMASK);
    BAD_ENCODE(states, 3);
    BAD_ENCODE(aggregates, 2);
    BAD_ENCODE(maybe_opaque, 2);
    BAD_ENCODE(max_cost, NAN);
    BAD_ENCODE(weights, weights);
#undef BAD_ENCODE
    BAD(filigree_encode_bitmask(NULL, &image, NULL, 3, NULL, &made, &error));
    BAD(filigree_encode_bitmask(NULL, NULL, NULL, 4, NULL, &made, &error));
#define BAD_BLOCKS(field, value) \
    BAD_FIELD(filigree_set_blocks, noBlocks, field, value, filigree_set_open(NULL, &given, &made, &error))
    BAD(filigree_set_open(NULL, NULL, &made, &error));
    BAD_BLOCKS(encoding, 7);
    BAD_BLOCKS(states, 1);
    BAD_BLOCKS(payload_bytes, 4);
    BAD_BLOCKS(descriptor_bytes, 4);
#undef BAD_BLOCKS
    BAD(filigree_set_get_blocks(set, NULL, &error));
    BAD(filigree_set_get_info(NULL, NULL, &error));
    BAD(filigree_set_get_indices(NULL, NULL, 0, &count, &error));
    BAD(filigree_set_get_levels(NULL, NULL, 0, &count, &error));
    BAD(filigree_set_get_map(NULL, 0, NULL, 0, &count, &error));
    filigree_micromaps_destroy(maps);
    BAD(filigree_decode(NULL, NULL, &maps, &error));
    BAD(filigree_set_lookup(NULL, 0, NULL, NULL, NULL, NULL, &error));
    CHECK_CODE(FILIGREE_OK, &error, filigree_set_lookup(set, 0, NULL, NULL, NULL, NULL, &error));
    BAD(filigree_set_lookup(set, 8, NULL, lists.weights, lists.weights, lists.states, &error));
    BAD(filigree_set_lookup(set, 8, lists.maps, NULL, lists.weights, lists.states, &error));
    BAD(filigree_set_lookup(set, 8, lists.maps, lists.weights, NULL, lists.states, &error));
    BAD(filigree_set_lookup(set, 8, lists.maps, lists.weights, lists.weights, NULL, &error));
    BAD(filigree_set_lookup(set, 8, lists.maps, lists.weights, lists.weights, lists.states + 31, &error));
    BAD(filigree_set_lookup_at(set, 8, lists.maps, lists.maps, lists.states, &error));
    BAD(filigree_set_lookup_at(set, 8, lists.maps, NULL, lists.states + 32, &error));
    CHECK(filigree_curve_index(0, 0, 13) == UINT32_MAX);
    filigree_set_destroy(set);
}

static void checkSquaresAndGrids(void) {
    const filigree_image image = leafImage();
    const filigree_triangles triangles = leafTriangleList();
    const filigree_grid_settings defaults = FILIGREE_GRID_SETTINGS_INIT;
    const filigree_heightfield hills = hillHeights();
    filigree_squares* squares = NULL;
    filigree_grids* grids = NULL;
    filigree_tracer* tracer = NULL;
    filigree_blob* blob = NULL;
    size_t count = 0;
    BAD(filigree_squares_encode(NULL, &triangles, &image, NULL, 4, NULL, &squares, &error));
    BAD(filigree_squares_encode(NULL, NULL, &image, NULL, FILIGREE_SQUARE_VQ2, NULL, &squares, &error));
    BAD(filigree_squares_get_info(NULL, NULL, &error));
    BAD(filigree_squares_get_blocks(NULL, NULL, 0, &count, &error));
    BAD(filigree_squares_get_indices(NULL, NULL, 0, &count, &error));
    BAD(filigree_squares_get_places(NULL, NULL, 0, &count, &error));
    BAD(filigree_squares_get_primitives(NULL, NULL, 0, &count, &error));
    BAD(filigree_set_get_primitives(NULL, NULL, 0, &count, &error));
    BAD(filigree_squares_lookup(NULL, 0, NULL, NULL, NULL, NULL, NULL, &error));
#define BAD_HEIGHTS(field, value)                                \
    BAD_FIELD(filigree_heightfield, hillHeights(), field, value, \
              filigree_grids_create_from_heights(NULL, &given, NULL, NULL, &grids, &error))
    BAD(filigree_grids_create_from_heights(NULL, NULL, NULL, NULL, &grids, &error));
    BAD_HEIGHTS(heights, NULL);
    BAD_HEIGHTS(columns, 1);
    BAD_HEIGHTS(rows, 65537);
    BAD_HEIGHTS(type, 3);
    BAD_HEIGHTS(cell, 0);
    BAD_HEIGHTS(cell, 1e300);
    BAD_HEIGHTS(cell, NAN);
    BAD_HEIGHTS(height_scale, 0);
    BAD_HEIGHTS(height_scale, INFINITY);
#undef BAD_HEIGHTS
#define BAD_GRIDS(field, value)                               \
    BAD_FIELD(filigree_grid_settings, defaults, field, value, \
              filigree_grids_create_from_heights(NULL, &hills, &given, NULL, &grids, &error))
    BAD_GRIDS(codec, 2);
    BAD_GRIDS(precision, 4);
    BAD_GRIDS(snap, 2);
    BAD_GRIDS(shared_exponent, 2);
    BAD_GRIDS(turn_quads, 2);
    BAD_GRIDS(attributes, 2);
    BAD_GRIDS(measure, 2);
#undef BAD_GRIDS
    filigree_mesh mesh = FILIGREE_MESH_INIT;
    BAD(filigree_grids_create(NULL, NULL, NULL, NULL, &grids, &error));
    BAD(filigree_grids_create(NULL, &mesh, NULL, NULL, &grids, &error));
    mesh.face_count = 1;
    mesh.vertex_count = 3;
    BAD(filigree_grids_create(NULL, &mesh, NULL, NULL, &grids, &error));
    mesh.face_vertices = 5;
    BAD(filigree_grids_create(NULL, &mesh, NULL, NULL, &grids, &error));
    BAD(filigree_grids_get_info(NULL, NULL, &error));
    BAD(filigree_grids_get_triangles(NULL, NULL, 0, &count, &error));
    BAD(filigree_grids_get_surface(NULL, NULL, NULL, &error));
    BAD(filigree_tracer_create(NULL, NULL, &tracer, &error));
    BAD(filigree_tracer_closest(NULL, 0, NULL, 0, NULL, 0, &error));
    BAD(filigree_set_serialise(NULL, NULL, NULL, &blob, &error));
    BAD(filigree_squares_serialise(NULL, NULL, NULL, &blob, &error));
    BAD(filigree_grids_serialise(NULL, NULL, NULL, &blob, &error));
    BAD(filigree_validate(NULL, NULL, 7, NULL, &error));
    CHECK_CODE(FILIGREE_ERROR_FORMAT, &error, filigree_validate(NULL, NULL, 0, NULL, &error));
    CHECK(squares == NULL && grids == NULL && tracer == NULL && blob == NULL);
}

// Destroying nothing is fine.
static void checkNothing(void) {
    filigree_context_destroy(NULL);
    filigree_micromaps_destroy(NULL);
    filigree_set_destroy(NULL);
    filigree_squares_destroy(NULL);
    filigree_grids_destroy(NULL);
    filigree_tracer_destroy(NULL);
    filigree_blob_destroy(NULL);
}

int badInputSuite(void) {
    failedChecks = 0;
    checkImages();
    checkTests();
    checkTriangles();
    checkLists();
    checkSets();
    checkSquaresAndGrids();
    checkNothing();
    return failedChecks;
}
