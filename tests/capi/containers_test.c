// Containers in memory from C.
#include "check.h"
#include "samples.h"
#include "suites.h"

#include <stdlib.h>
#include <string.h>

static filigree_error validate(const void* bytes, size_t size) {
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    const filigree_error code = filigree_validate(NULL, bytes, size, NULL, &error);
    CHECK(code == FILIGREE_OK || error.message[0] != 0);
    return code;
}

// No prefix passes, nor one byte more, nor a byte changed in the table.
static void checkDamage(const filigree_blob* blob) {
    const size_t size = filigree_blob_size(blob);
    const size_t step = size / 97 + 1;
    for (size_t length = 0; length < size; length += length < 200 ? 7 : step) {
        uint8_t* part = malloc(length + 1);
        memcpy(part, filigree_blob_data(blob), length);
        CHECK(validate(part, length) == FILIGREE_ERROR_FORMAT);
        free(part);
    }
    uint8_t* copy = malloc(size + 1);
    memcpy(copy, filigree_blob_data(blob), size);
    copy[size] = 0;
    CHECK(validate(copy, size) == FILIGREE_OK);
    CHECK(validate(copy, size + 1) == FILIGREE_ERROR_FORMAT);
    copy[20] ^= 1;
    CHECK(validate(copy, size) == FILIGREE_ERROR_FORMAT);
    free(copy);
}

static void checkKind(const filigree_blob* blob, filigree_container expected) {
    filigree_container kind = (filigree_container)9;
    CHECK(filigree_validate(NULL, filigree_blob_data(blob), filigree_blob_size(blob), &kind, NULL) ==
          FILIGREE_OK);
    CHECK(kind == expected);
}

static void checkSet(filigree_encoding encoding) {
    filigree_set* set = encodedLeaf(NULL, encoding);
    filigree_set* parsed = NULL;
    filigree_grids* grids = NULL;
    filigree_blob* blob = NULL;
    filigree_blob* again = NULL;
    filigree_set_info info = FILIGREE_SET_INFO_INIT, parsedInfo = FILIGREE_SET_INFO_INIT;
    filigree_container_settings settings = FILIGREE_CONTAINER_SETTINGS_INIT;
    filigree_alpha_test test = FILIGREE_ALPHA_TEST_INIT;
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    filigree_primitive primitive[1];
    size_t count = 0;
    settings.asset_name = "leaf.glb";
    settings.asset = "the bytes of leaf.glb";
    settings.asset_bytes = strlen(settings.asset);
    settings.test = &test;
    CHECK_CODE(FILIGREE_OK, &error, filigree_set_serialise(NULL, set, &settings, &blob, &error));
    CHECK_CODE(FILIGREE_OK, &error,
               filigree_set_parse(NULL, filigree_blob_data(blob), filigree_blob_size(blob), &parsed, &error));
    filigree_set_get_info(set, &info, NULL);
    filigree_set_get_info(parsed, &parsedInfo, NULL);
    CHECK(memcmp(&info, &parsedInfo, sizeof info) == 0);
    CHECK_CODE(FILIGREE_OK, &error, filigree_set_get_primitives(parsed, primitive, 1, &count, &error));
    CHECK(count == 1 && primitive[0].triangles == leafTriangles);
    for (size_t t = 0; t < leafTriangles; ++t)
        CHECK(filigree_set_triangle_state(set, t, 0.2F, 0.3F) ==
              filigree_set_triangle_state(parsed, t, 0.2F, 0.3F));
    CHECK_CODE(FILIGREE_OK, &error, filigree_set_serialise(NULL, parsed, &settings, &again, &error));
    CHECK(filigree_blob_size(again) == filigree_blob_size(blob) &&
          memcmp(filigree_blob_data(again), filigree_blob_data(blob), filigree_blob_size(blob)) == 0);
    CHECK_CODE(
        FILIGREE_ERROR_FORMAT, &error,
        filigree_grids_parse(NULL, filigree_blob_data(blob), filigree_blob_size(blob), &grids, &error));
    checkKind(blob, FILIGREE_CONTAINER_SET);
    if (encoding == FILIGREE_ENCODING_SDAG) checkDamage(blob);
    filigree_blob_destroy(again);
    filigree_blob_destroy(blob);
    filigree_set_destroy(parsed);
    filigree_set_destroy(set);
}

static void checkBitmask(void) {
    const filigree_image image = leafImage();
    filigree_set* set = NULL;
    filigree_set* parsed = NULL;
    filigree_blob* blob = NULL;
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    filigree_encode_bitmask(NULL, &image, NULL, 2, NULL, &set, NULL);
    CHECK_CODE(FILIGREE_OK, &error, filigree_set_serialise(NULL, set, NULL, &blob, &error));
    CHECK_CODE(FILIGREE_OK, &error,
               filigree_set_parse(NULL, filigree_blob_data(blob), filigree_blob_size(blob), &parsed, &error));
    CHECK(filigree_set_state(parsed, 0, 0.5F, 0.5F) == FILIGREE_STATE_OPAQUE);
    filigree_blob_destroy(blob);
    filigree_set_destroy(parsed);
    filigree_set_destroy(set);
}

static void checkSquares(void) {
    filigree_squares* squares = squaresOfLeaf(NULL, FILIGREE_SQUARE_VQ4_PLUS);
    filigree_squares* parsed = NULL;
    filigree_blob* blob = NULL;
    filigree_container_settings settings = FILIGREE_CONTAINER_SETTINGS_INIT;
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    filigree_primitive primitive[1];
    size_t count = 0;
    settings.zstd = 1;
    CHECK_CODE(FILIGREE_OK, &error, filigree_squares_serialise(NULL, squares, &settings, &blob, &error));
    CHECK_CODE(
        FILIGREE_OK, &error,
        filigree_squares_parse(NULL, filigree_blob_data(blob), filigree_blob_size(blob), &parsed, &error));
    CHECK_CODE(FILIGREE_OK, &error, filigree_squares_get_primitives(parsed, primitive, 1, &count, &error));
    CHECK(count == 1 && primitive[0].triangles == leafTriangles);
    for (size_t t = 0; t < leafTriangles; ++t) {
        CHECK(filigree_squares_triangle_region(squares, t, 0.2F, 0.3F) ==
              filigree_squares_triangle_region(parsed, t, 0.2F, 0.3F));
    }
    checkKind(blob, FILIGREE_CONTAINER_SQUARES);
    checkDamage(blob);
    filigree_blob_destroy(blob);
    filigree_squares_destroy(parsed);
    filigree_squares_destroy(squares);
}

static void checkGrids(void) {
    filigree_grids* grids = gridsOfHills(NULL);
    filigree_grids* parsed = NULL;
    filigree_blob* blob = NULL;
    filigree_container_settings settings = FILIGREE_CONTAINER_SETTINGS_INIT;
    filigree_grids_info info = FILIGREE_GRIDS_INFO_INIT, parsedInfo = FILIGREE_GRIDS_INFO_INIT;
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    settings.asset_name = "hills";
    CHECK_CODE(FILIGREE_OK, &error, filigree_grids_serialise(NULL, grids, &settings, &blob, &error));
    CHECK_CODE(
        FILIGREE_OK, &error,
        filigree_grids_parse(NULL, filigree_blob_data(blob), filigree_blob_size(blob), &parsed, &error));
    filigree_grids_get_info(grids, &info, NULL);
    filigree_grids_get_info(parsed, &parsedInfo, NULL);
    CHECK(parsedInfo.rms_error == -1 && parsedInfo.geometry_bytes == info.geometry_bytes);
    CHECK(parsedInfo.triangle_count == info.triangle_count);
    checkKind(blob, FILIGREE_CONTAINER_GRIDS);
    checkDamage(blob);
    filigree_blob_destroy(blob);
    filigree_grids_destroy(parsed);
    filigree_grids_destroy(grids);
}

int containersSuite(void) {
    failedChecks = 0;
    checkSet(FILIGREE_ENCODING_FLAT);
    checkSet(FILIGREE_ENCODING_SDAG);
    checkBitmask();
    checkSquares();
    checkGrids();
    CHECK(filigree_blob_data(NULL) == NULL && filigree_blob_size(NULL) == 0);
    return failedChecks;
}
