// Threads, progress and cancelling from C, and structs of other versions.
#include "check.h"
#include "samples.h"
#include "suites.h"

#include <stdlib.h>
#include <string.h>

// A loop that runs backwards in ranges of three, and what it may do wrong.
typedef struct Loops {
    int calls;
    int fault;  // 1: leaves a range out, 2: goes too far
} Loops;

static void parallelFor(void* user, size_t count, size_t grain, filigree_range_body body, void* work) {
    Loops* loops = user;
    const size_t step = grain < 3 ? grain : 3;
    ++loops->calls;
    for (size_t end = count; end > 0;) {
        const size_t begin = end > step ? end - step : 0;
        if (!(loops->fault == 1 && begin == 0)) body(work, begin, loops->fault == 2 ? end + 1 : end);
        end = begin;
    }
}

static int sameSets(const filigree_set* a, const filigree_set* b) {
    filigree_set_blocks x = FILIGREE_SET_BLOCKS_INIT, y = FILIGREE_SET_BLOCKS_INIT;
    filigree_set_get_blocks(a, &x, NULL);
    filigree_set_get_blocks(b, &y, NULL);
    return x.payload_bytes == y.payload_bytes && x.descriptor_bytes == y.descriptor_bytes &&
           memcmp(x.payload, y.payload, x.payload_bytes) == 0 &&
           memcmp(x.descriptors, y.descriptors, x.descriptor_bytes) == 0;
}

static void checkThreads(void) {
    Loops loops = {0, 0};
    filigree_context_settings settings = FILIGREE_CONTEXT_SETTINGS_INIT;
    filigree_context* context = NULL;
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    filigree_set* serial = encodedLeaf(NULL, FILIGREE_ENCODING_SDAG);
    filigree_set* threaded = NULL;
    settings.threads = 2;
    CHECK_CODE(FILIGREE_OK, &error, filigree_context_create(&settings, &context, &error));
    threaded = encodedLeaf(context, FILIGREE_ENCODING_SDAG);
    filigree_context_destroy(context);
    CHECK(sameSets(serial, threaded));
    filigree_set_destroy(threaded);

    settings.parallel_for = parallelFor;
    settings.parallel_for_user = &loops;
    settings.concurrency = 3;
    CHECK_CODE(FILIGREE_OK, &error, filigree_context_create(&settings, &context, &error));
    threaded = encodedLeaf(context, FILIGREE_ENCODING_SDAG);
    CHECK(loops.calls > 0 && sameSets(serial, threaded));
    filigree_set_destroy(threaded);
    for (loops.fault = 1; loops.fault <= 2; ++loops.fault) {
        const filigree_error code = useEverything(context, &error);
        CHECK(code == FILIGREE_ERROR_ARGUMENT && strstr(error.message, "parallel_for") != NULL);
    }
    filigree_context_destroy(context);
    filigree_set_destroy(serial);

    settings.concurrency = 0;
    CHECK_CODE(FILIGREE_ERROR_ARGUMENT, &error, filigree_context_create(&settings, &context, &error));
    settings.parallel_for = NULL;
    settings.threads = 5000;
    CHECK_CODE(FILIGREE_ERROR_ARGUMENT, &error, filigree_context_create(&settings, &context, &error));
    settings.threads = 1;
    settings.allocate = meterAllocate;
    CHECK_CODE(FILIGREE_ERROR_ARGUMENT, &error, filigree_context_create(&settings, &context, &error));
    CHECK(context == NULL);
}

// Counts reports, and stops at one of them.
typedef struct Told {
    int reports;
    int stopAt;
    uint64_t done;
    uint64_t total;
    char stage[64];
} Told;

static int tell(void* user, const char* stage, uint64_t done, uint64_t total) {
    Told* told = user;
    strncpy(told->stage, stage, sizeof told->stage - 1);
    told->done = done;
    told->total = total;
    return ++told->reports == told->stopAt;
}

static void checkProgress(void) {
    const filigree_image image = leafImage();
    const filigree_triangles triangles = leafTriangleList();
    const filigree_heightfield heights = hillHeights();
    Told told = {0, 0, 0, 0, {0}};
    filigree_progress progress = FILIGREE_PROGRESS_INIT;
    filigree_micromaps* maps = NULL;
    filigree_set* set = NULL;
    filigree_squares* squares = NULL;
    filigree_grids* grids = NULL;
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    progress.callback = tell;
    progress.user = &told;
    CHECK_CODE(FILIGREE_OK, &error,
               filigree_bake(NULL, &triangles, &image, NULL, NULL, &progress, &maps, &error));
    CHECK(told.reports > 1 && told.done == told.total && strcmp(told.stage, "bake") == 0);
    told.stopAt = told.reports + 1;
    CHECK_CODE(FILIGREE_ERROR_CANCELLED, &error, filigree_encode(NULL, maps, NULL, &progress, &set, &error));
    CHECK(set == NULL);
    filigree_micromaps_destroy(maps);
    told.stopAt = told.reports + 1;
    CHECK_CODE(FILIGREE_ERROR_CANCELLED, &error,
               filigree_encode_bitmask(NULL, &image, NULL, 4, &progress, &set, &error));
    CHECK(set == NULL);
    told.stopAt = told.reports + 1;
    CHECK_CODE(FILIGREE_ERROR_CANCELLED, &error,
               filigree_bake(NULL, &triangles, &image, NULL, NULL, &progress, &maps, &error));
    CHECK(maps == NULL);
    told.stopAt = told.reports + 1;
    CHECK_CODE(FILIGREE_ERROR_CANCELLED, &error,
               filigree_squares_encode(NULL, &triangles, &image, NULL, FILIGREE_SQUARE_VQ2, &progress,
                                       &squares, &error));
    CHECK(squares == NULL);
    told.stopAt = told.reports + 1;
    CHECK_CODE(FILIGREE_ERROR_CANCELLED, &error,
               filigree_grids_create_from_heights(NULL, &heights, NULL, &progress, &grids, &error));
    CHECK(grids == NULL);
}

// A struct of a later version, a wrong one, and info structs of other sizes.
static void checkVersions(void) {
    const filigree_image image = leafImage();
    const filigree_triangles triangles = leafTriangleList();
    struct {
        filigree_bake_settings now;
        uint64_t later[2];
    } settings = {FILIGREE_BAKE_SETTINGS_INIT, {0, 0}};
    struct {
        filigree_micromaps_info now;
        uint64_t later;
    } info = {FILIGREE_MICROMAPS_INFO_INIT, 7};
    filigree_micromaps* maps = NULL;
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    settings.now.struct_size = sizeof settings;
    CHECK_CODE(FILIGREE_OK, &error,
               filigree_bake(NULL, &triangles, &image, NULL, &settings.now, NULL, &maps, &error));
    info.now.struct_size = sizeof info;
    CHECK_CODE(FILIGREE_OK, &error, filigree_micromaps_get_info(maps, &info.now, &error));
    CHECK(info.now.struct_size == sizeof info && info.now.triangle_count == leafTriangles && info.later == 0);
    filigree_micromaps_destroy(maps);
    settings.later[1] = 1;
    CHECK_CODE(FILIGREE_ERROR_STRUCT, &error,
               filigree_bake(NULL, &triangles, &image, NULL, &settings.now, NULL, &maps, &error));
    settings.now.struct_size = 8;
    CHECK_CODE(FILIGREE_ERROR_STRUCT, &error,
               filigree_bake(NULL, &triangles, &image, NULL, &settings.now, NULL, &maps, &error));
    settings.now.struct_size = (size_t)1 << 40;
    CHECK_CODE(FILIGREE_ERROR_STRUCT, &error,
               filigree_bake(NULL, &triangles, &image, NULL, &settings.now, NULL, &maps, &error));

    // A short info gets a short message; one that cannot be written to is an error itself.
    error.struct_size = 64;
    memset(error.message, 'x', sizeof error.message);
    CHECK(filigree_bake(NULL, NULL, &image, NULL, NULL, NULL, &maps, &error) == FILIGREE_ERROR_ARGUMENT);
    CHECK(strlen(error.message) < 64 && error.message[60] == 'x');
    error.struct_size = 8;
    CHECK(filigree_bake(NULL, &triangles, &image, NULL, NULL, NULL, &maps, &error) == FILIGREE_ERROR_STRUCT);
    CHECK(maps == NULL);
}

#define CHECK_INIT(type, init)                                             \
    do {                                                                   \
        const type expected = init;                                        \
        type found;                                                        \
        memset(&found, 0, sizeof found);                                   \
        CHECK(type##_init(&found, sizeof found) == FILIGREE_OK);           \
        CHECK(memcmp(&expected, &found, sizeof found) == 0);               \
        CHECK(type##_init(NULL, sizeof found) == FILIGREE_ERROR_ARGUMENT); \
        CHECK(type##_init(&found, 4) == FILIGREE_ERROR_STRUCT);            \
    } while (0)

static void checkDefaults(void) {
    CHECK_INIT(filigree_context_settings, FILIGREE_CONTEXT_SETTINGS_INIT);
    CHECK_INIT(filigree_image, FILIGREE_IMAGE_INIT);
    CHECK_INIT(filigree_alpha_test, FILIGREE_ALPHA_TEST_INIT);
    CHECK_INIT(filigree_triangles, FILIGREE_TRIANGLES_INIT);
    CHECK_INIT(filigree_bake_settings, FILIGREE_BAKE_SETTINGS_INIT);
    CHECK_INIT(filigree_flat_micromaps, FILIGREE_FLAT_MICROMAPS_INIT);
    CHECK_INIT(filigree_encode_settings, FILIGREE_ENCODE_SETTINGS_INIT);
    CHECK_INIT(filigree_set_blocks, FILIGREE_SET_BLOCKS_INIT);
    CHECK_INIT(filigree_mesh, FILIGREE_MESH_INIT);
    CHECK_INIT(filigree_heightfield, FILIGREE_HEIGHTFIELD_INIT);
    CHECK_INIT(filigree_grid_settings, FILIGREE_GRID_SETTINGS_INIT);
    CHECK_INIT(filigree_container_settings, FILIGREE_CONTAINER_SETTINGS_INIT);
    CHECK(filigree_version() == 100);
    CHECK(strcmp(filigree_error_name(FILIGREE_ERROR_CAPACITY), "FILIGREE_ERROR_CAPACITY") == 0);
    CHECK(strcmp(filigree_error_name(77), "unknown error") == 0);
}

int contextSuite(void) {
    failedChecks = 0;
    checkThreads();
    checkProgress();
    checkVersions();
    checkDefaults();
    return failedChecks;
}
