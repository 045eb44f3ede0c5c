// Baking from C: lists, records, counts, and the way back.
#include "check.h"
#include "samples.h"
#include "suites.h"

#include <stdlib.h>
#include <string.h>

static void checkLists(const filigree_micromaps* maps) {
    filigree_micromaps_info info = FILIGREE_MICROMAPS_INFO_INIT;
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    uint8_t data[4096];
    filigree_record records[leafTriangles];
    filigree_usage usage[13];
    int32_t indices[leafTriangles];
    int8_t small[leafTriangles];
    size_t count = 0;
    CHECK_CODE(FILIGREE_OK, &error, filigree_micromaps_get_info(maps, &info, &error));
    CHECK(info.triangle_count == leafTriangles && info.states == 4 && info.map_count == 4);
    CHECK(info.record_count == 4 && info.index_bytes == 1);

    CHECK_CODE(FILIGREE_OK, &error, filigree_micromaps_get_data(maps, NULL, 0, &count, &error));
    CHECK(count == info.data_bytes && count <= sizeof data);
    CHECK_CODE(FILIGREE_ERROR_CAPACITY, &error,
               filigree_micromaps_get_data(maps, data, count - 1, &count, &error));
    CHECK(count == info.data_bytes);
    CHECK_CODE(FILIGREE_OK, &error, filigree_micromaps_get_data(maps, data, count, &count, &error));

    CHECK_CODE(FILIGREE_OK, &error,
               filigree_micromaps_get_records(maps, records, leafTriangles, &count, &error));
    CHECK(count == 4 && records[0].byte_offset == 0 && records[0].format == 2);
    CHECK(records[3].byte_offset + (((size_t)1 << (2 * records[3].level)) + 3) / 4 == info.data_bytes);

    CHECK_CODE(FILIGREE_OK, &error,
               filigree_micromaps_get_usage(maps, FILIGREE_USAGE_OF_RECORDS, usage, 13, &count, &error));
    CHECK(count == info.usage_count && usage[0].format == 2);
    CHECK_CODE(FILIGREE_OK, &error,
               filigree_micromaps_get_usage(maps, FILIGREE_USAGE_OF_TRIANGLES, usage, 13, &count, &error));
    CHECK(count == 1 || count == 2);

    CHECK_CODE(FILIGREE_OK, &error,
               filigree_micromaps_get_indices(maps, 4, indices, leafTriangles, &count, &error));
    CHECK(count == leafTriangles && indices[0] == 0);
    CHECK(indices[4] == FILIGREE_SPECIAL_INDEX(FILIGREE_STATE_OPAQUE));
    CHECK(indices[5] == FILIGREE_SPECIAL_INDEX(FILIGREE_STATE_TRANSPARENT));
    CHECK_CODE(FILIGREE_OK, &error,
               filigree_micromaps_get_indices(maps, 1, small, leafTriangles, &count, &error));
    for (size_t t = 0; t < leafTriangles; ++t) CHECK(small[t] == indices[t]);
    CHECK_CODE(FILIGREE_OK, &error, filigree_micromaps_get_levels(maps, data, sizeof data, &count, &error));
    CHECK(count == leafTriangles && data[0] == records[0].level);
    CHECK_CODE(FILIGREE_OK, &error, filigree_micromaps_get_rotations(maps, NULL, 0, &count, &error));
    CHECK(count == 0);
}

// Flat lists to micromaps and back are the same lists.
static void checkFlatRoundTrip(const filigree_micromaps* maps) {
    uint8_t data[4096];
    uint8_t again[4096];
    filigree_record records[leafTriangles];
    int32_t indices[leafTriangles];
    filigree_flat_micromaps flat = FILIGREE_FLAT_MICROMAPS_INIT;
    filigree_micromaps* read = NULL;
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    size_t count = 0;
    flat.data = data;
    flat.records = records;
    flat.indices = indices;
    filigree_micromaps_get_data(maps, data, sizeof data, &flat.data_bytes, NULL);
    filigree_micromaps_get_records(maps, records, leafTriangles, &flat.record_count, NULL);
    filigree_micromaps_get_indices(maps, 4, indices, leafTriangles, &flat.triangle_count, NULL);
    CHECK_CODE(FILIGREE_OK, &error, filigree_micromaps_from_flat(NULL, &flat, &read, &error));
    CHECK_CODE(FILIGREE_OK, &error, filigree_micromaps_get_data(read, again, sizeof again, &count, &error));
    CHECK(count == flat.data_bytes && memcmp(data, again, count) == 0);
    filigree_micromaps_destroy(read);

    records[1].level = 13;
    CHECK_CODE(FILIGREE_ERROR_FORMAT, &error, filigree_micromaps_from_flat(NULL, &flat, &read, &error));
    CHECK(read == NULL);
    records[1].level = 12;
    CHECK_CODE(FILIGREE_ERROR_FORMAT, &error, filigree_micromaps_from_flat(NULL, &flat, &read, &error));
    records[1].level = 0;
    records[1].format = 3;
    CHECK_CODE(FILIGREE_ERROR_FORMAT, &error, filigree_micromaps_from_flat(NULL, &flat, &read, &error));
    records[1].format = 2;
    indices[2] = -5;
    CHECK_CODE(FILIGREE_ERROR_FORMAT, &error, filigree_micromaps_from_flat(NULL, &flat, &read, &error));
    indices[2] = (int32_t)flat.record_count;
    CHECK_CODE(FILIGREE_ERROR_FORMAT, &error, filigree_micromaps_from_flat(NULL, &flat, &read, &error));
}

// The APIs allow no empty lists: a triangle without a map gets a record that nobody names.
static void checkOneRecord(void) {
    const float uvs[6] = {0.5F, 0.45F, 0.55F, 0.5F, 0.45F, 0.5F};
    const filigree_image image = leafImage();
    filigree_triangles triangles = FILIGREE_TRIANGLES_INIT;
    filigree_micromaps* maps = NULL;
    filigree_micromaps_info info = FILIGREE_MICROMAPS_INFO_INIT;
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    filigree_usage usage[1];
    uint8_t data[1];
    size_t count = 0;
    triangles.triangle_count = 1;
    triangles.uvs = uvs;
    CHECK_CODE(FILIGREE_OK, &error, filigree_bake(NULL, &triangles, &image, NULL, NULL, NULL, &maps, &error));
    CHECK_CODE(FILIGREE_OK, &error, filigree_micromaps_get_info(maps, &info, &error));
    CHECK(info.map_count == 0 && info.record_count == 1 && info.data_bytes == 1 && info.usage_count == 1);
    CHECK_CODE(FILIGREE_OK, &error, filigree_micromaps_get_data(maps, data, 1, &count, &error));
    CHECK(count == 1 && data[0] == FILIGREE_STATE_UNKNOWN_OPAQUE);
    CHECK_CODE(FILIGREE_OK, &error,
               filigree_micromaps_get_usage(maps, FILIGREE_USAGE_OF_TRIANGLES, usage, 1, &count, &error));
    CHECK(count == 0);
    filigree_micromaps_destroy(maps);
}

int micromapsSuite(void) {
    filigree_micromaps* maps = bakedLeaf(NULL);
    failedChecks = 0;
    checkLists(maps);
    checkFlatRoundTrip(maps);
    checkOneRecord();
    filigree_micromaps_destroy(maps);
    return failedChecks;
}
