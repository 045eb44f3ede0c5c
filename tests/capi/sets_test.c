// Encoding, decoding and looking up from C.
#include "check.h"
#include "samples.h"
#include "suites.h"

#include <string.h>

enum { queries = 3000 };

// Points all over the triangle, and for each a map.
static void makeQueries(uint32_t mapCount, uint32_t* maps, float* u, float* v) {
    uint32_t state = 1;
    for (int k = 0; k < queries; ++k) {
        state = state * 1664525u + 1013904223u;
        maps[k] = (state >> 8) % mapCount;
        state = state * 1664525u + 1013904223u;
        u[k] = (float)(state >> 8) / 16777216.0F;
        state = state * 1664525u + 1013904223u;
        v[k] = (float)(state >> 8) / 16777216.0F * (1 - u[k]);
    }
}

// `masksSides`: unknown states read as unknown-opaque.
static void checkLookups(const filigree_set* set, const filigree_set* flat, int masksSides) {
    static uint32_t maps[queries], indices[queries];
    static float u[queries], v[queries];
    static uint8_t states[queries], statesAt[queries], expected[queries];
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    filigree_set_info info = FILIGREE_SET_INFO_INIT;
    uint8_t levels[leafTriangles];
    size_t count = 0;
    CHECK_CODE(FILIGREE_OK, &error, filigree_set_get_info(set, &info, &error));
    CHECK(info.map_count == 4 && info.triangle_count == leafTriangles && info.states == 4);
    CHECK_CODE(FILIGREE_OK, &error, filigree_set_get_levels(set, levels, leafTriangles, &count, &error));
    CHECK(count == info.map_count);
    makeQueries(info.map_count, maps, u, v);
    for (int k = 0; k < queries; ++k) indices[k] = filigree_curve_index(u[k], v[k], levels[maps[k]]);
    CHECK_CODE(FILIGREE_OK, &error, filigree_set_lookup(set, queries, maps, u, v, states, &error));
    CHECK_CODE(FILIGREE_OK, &error, filigree_set_lookup_at(set, queries, maps, indices, statesAt, &error));
    CHECK_CODE(FILIGREE_OK, &error, filigree_set_lookup(flat, queries, maps, u, v, expected, &error));
    for (int k = 0; k < queries; ++k) {
        if (masksSides && expected[k] == FILIGREE_STATE_UNKNOWN_TRANSPARENT)
            expected[k] = FILIGREE_STATE_UNKNOWN_OPAQUE;
    }
    CHECK(memcmp(states, expected, queries) == 0 && memcmp(states, statesAt, queries) == 0);
    for (int k = 0; k < queries; ++k) {
        CHECK(filigree_set_state(set, maps[k], u[k], v[k]) == states[k]);
        CHECK(filigree_set_state_at(set, maps[k], indices[k]) == states[k]);
    }
    CHECK(filigree_set_state(set, info.map_count, 0, 0) == -1);
    CHECK(filigree_set_state(NULL, 0, 0, 0) == -1);
    CHECK(filigree_set_state_at(set, 0, 1u << (2 * levels[0])) == -1);
    CHECK(filigree_set_triangle_state(set, 0, 0.5F, 0.5F) == filigree_set_state(set, 0, 0.5F, 0.5F));
    CHECK(filigree_set_triangle_state(set, 4, 0.3F, 0.3F) == FILIGREE_STATE_OPAQUE);
    CHECK(filigree_set_triangle_state(set, 5, 0.3F, 0.3F) == FILIGREE_STATE_TRANSPARENT);
    CHECK(filigree_set_triangle_state(set, leafTriangles, 0, 0) == -1);

    maps[1500] = 4;
    CHECK_CODE(FILIGREE_ERROR_ARGUMENT, &error,
               filigree_set_lookup(set, queries, maps, u, v, states, &error));
    CHECK(strstr(error.message, "1500") != NULL);
    maps[1500] = 0;
    indices[2500] = 1u << (2 * levels[maps[2500]]);
    CHECK_CODE(FILIGREE_ERROR_ARGUMENT, &error,
               filigree_set_lookup_at(set, queries, maps, indices, states, &error));
    CHECK(strstr(error.message, "2500") != NULL);
}

// Blocks opened again answer alike, and maps come back as they were.
static void checkBlocksAndMaps(const filigree_set* set, int masksSides) {
    filigree_set_blocks blocks = FILIGREE_SET_BLOCKS_INIT;
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    filigree_set* opened = NULL;
    filigree_micromaps* decoded = NULL;
    filigree_micromaps* baked = bakedLeaf(NULL);
    uint8_t expected[4096], found[4096], map[4096];
    size_t expectedCount = 0, foundCount = 0, mapCount = 0;
    CHECK_CODE(FILIGREE_OK, &error, filigree_set_get_blocks(set, &blocks, &error));
    CHECK_CODE(FILIGREE_OK, &error, filigree_set_open(NULL, &blocks, &opened, &error));
    CHECK_CODE(FILIGREE_OK, &error, filigree_decode(NULL, opened, &decoded, &error));
    filigree_micromaps_get_data(baked, expected, sizeof expected, &expectedCount, NULL);
    filigree_micromaps_get_data(decoded, found, sizeof found, &foundCount, NULL);
    CHECK(foundCount == expectedCount && (masksSides || memcmp(expected, found, expectedCount) == 0));
    CHECK_CODE(FILIGREE_OK, &error, filigree_set_get_map(opened, 0, map, sizeof map, &mapCount, &error));
    CHECK(memcmp(map, found, mapCount) == 0);
    CHECK_CODE(FILIGREE_ERROR_ARGUMENT, &error,
               filigree_set_get_map(opened, 4, map, sizeof map, &mapCount, &error));
    filigree_micromaps_destroy(decoded);
    filigree_set_destroy(opened);

    blocks.payload_bytes -= 1;
    CHECK_CODE(FILIGREE_ERROR_FORMAT, &error, filigree_set_open(NULL, &blocks, &opened, &error));
    CHECK(opened == NULL);
    filigree_micromaps_destroy(baked);
}

static void checkLossy(void) {
    filigree_encode_settings settings = FILIGREE_ENCODE_SETTINGS_INIT;
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    filigree_set_info whole = FILIGREE_SET_INFO_INIT, less = FILIGREE_SET_INFO_INIT;
    filigree_micromaps* maps = bakedLeaf(NULL);
    filigree_set* lossless = encodedLeaf(NULL, FILIGREE_ENCODING_SDAG);
    filigree_set* set = NULL;
    const float weights[leafTriangles] = {1, 1, 0, 0, 1, 1};
    filigree_set_get_info(lossless, &whole, NULL);
    settings.max_bytes = whole.bytes * 3 / 4;
    settings.weights = weights;
    CHECK_CODE(FILIGREE_OK, &error, filigree_encode(NULL, maps, &settings, NULL, &set, &error));
    filigree_set_get_info(set, &less, NULL);
    CHECK(less.bytes <= settings.max_bytes && less.triangle_count == leafTriangles);
    for (size_t t = 0; t < leafTriangles; ++t) {
        const int state = filigree_set_triangle_state(set, t, 0.25F, 0.5F);
        CHECK(state >= 2 || state == filigree_set_triangle_state(lossless, t, 0.25F, 0.5F));
    }
    filigree_set_destroy(set);
    settings.max_bytes = 1;
    CHECK_CODE(FILIGREE_ERROR_LIMIT, &error, filigree_encode(NULL, maps, &settings, NULL, &set, &error));
    settings.max_cost = 1;
    CHECK_CODE(FILIGREE_ERROR_ARGUMENT, &error, filigree_encode(NULL, maps, &settings, NULL, &set, &error));
    CHECK(set == NULL);
    filigree_set_destroy(lossless);
    filigree_micromaps_destroy(maps);
}

static void checkBitmask(void) {
    const filigree_image image = leafImage();
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    filigree_set* set = NULL;
    filigree_micromaps* decoded = NULL;
    const uint32_t maps[2] = {0, 0};
    const uint32_t indices[2] = {0, 1};
    const float u[2] = {0.5F, 0.01F};
    uint8_t states[2];
    CHECK_CODE(FILIGREE_OK, &error, filigree_encode_bitmask(NULL, &image, NULL, 4, NULL, &set, &error));
    CHECK_CODE(FILIGREE_OK, &error, filigree_set_lookup(set, 2, maps, u, u, states, &error));
    CHECK(states[0] == FILIGREE_STATE_OPAQUE && states[1] == FILIGREE_STATE_TRANSPARENT);
    CHECK(filigree_set_state(set, 0, 0.5F, 0.5F) == FILIGREE_STATE_OPAQUE);
    CHECK(filigree_set_state_at(set, 0, 0) == -1);
    CHECK_CODE(FILIGREE_ERROR_UNSUPPORTED, &error,
               filigree_set_lookup_at(set, 2, maps, indices, states, &error));
    CHECK_CODE(FILIGREE_ERROR_UNSUPPORTED, &error, filigree_decode(NULL, set, &decoded, &error));
    filigree_set_destroy(set);
}

int setsSuite(void) {
    const filigree_encoding encodings[] = {FILIGREE_ENCODING_FLAT, FILIGREE_ENCODING_GRUEN,
                                           FILIGREE_ENCODING_TREE, FILIGREE_ENCODING_INDEXED_TREE,
                                           FILIGREE_ENCODING_DAG,  FILIGREE_ENCODING_SDAG};
    filigree_set* flat = encodedLeaf(NULL, FILIGREE_ENCODING_FLAT);
    failedChecks = 0;
    for (size_t k = 0; k < sizeof encodings / sizeof encodings[0]; ++k) {
        filigree_set* set = encodedLeaf(NULL, encodings[k]);
        checkLookups(set, flat, encodings[k] == FILIGREE_ENCODING_GRUEN);
        checkBlocksAndMaps(set, encodings[k] == FILIGREE_ENCODING_GRUEN);
        filigree_set_destroy(set);
    }
    filigree_set_destroy(flat);
    checkLossy();
    checkBitmask();
    return failedChecks;
}
