#include "samples.h"

#include "check.h"

filigree_image leafImage(void) {
    static uint8_t pixels[leafSide * leafSide * 4];
    filigree_image image = FILIGREE_IMAGE_INIT;
    for (int y = 0; y < leafSide; ++y) {
        for (int x = 0; x < leafSide; ++x) {
            const int dx = 2 * x + 5 - leafSide;
            const int dy = 2 * y + 1 - leafSide;
            pixels[4 * (y * leafSide + x) + 3] = dx * dx + dy * dy < 500 ? 255 : 0;
        }
    }
    image.texels = pixels + 3;
    image.width = leafSide;
    image.height = leafSide;
    image.texel_stride = 4;
    return image;
}

filigree_triangles leafTriangleList(void) {
    static const float uvs[][2] = {{0, 0},         {1, 0},         {0, 1},        {1, 1},
                                   {1.5F, 0.25F},  {0.5F, 0.45F},  {0.55F, 0.5F}, {0.45F, 0.5F},
                                   {0.01F, 0.01F}, {0.05F, 0.01F}, {0.01F, 0.05F}};
    static const float positions[][3] = {
        {0, 0, 0},        {1, 0, 0},        {0, 1, 0}, {1, 1, 0}, {1.5F, 0.25F, 0}, {0.5F, 0.45F, 1},
        {0.55F, 0.5F, 1}, {0.45F, 0.5F, 1}, {0, 0, 2}, {1, 0, 2}, {0, 1, 2}};
    static const uint16_t indices[] = {0, 1, 2, 3, 2, 1, 1, 4, 3, 2, 3, 4, 5, 6, 7, 8, 9, 10};
    filigree_triangles triangles = FILIGREE_TRIANGLES_INIT;
    triangles.triangle_count = leafTriangles;
    triangles.uvs = uvs[0];
    triangles.positions = positions[0];
    triangles.vertex_count = sizeof uvs / sizeof uvs[0];
    triangles.indices = indices;
    triangles.index_bytes = 2;
    return triangles;
}

filigree_micromaps* bakedLeaf(const filigree_context* context) {
    const filigree_image image = leafImage();
    const filigree_triangles triangles = leafTriangleList();
    filigree_error_info info = FILIGREE_ERROR_INFO_INIT;
    filigree_micromaps* maps = NULL;
    CHECK_CODE(FILIGREE_OK, &info,
               filigree_bake(context, &triangles, &image, NULL, NULL, NULL, &maps, &info));
    return maps;
}

filigree_set* encodedLeaf(const filigree_context* context, filigree_encoding encoding) {
    filigree_error_info info = FILIGREE_ERROR_INFO_INIT;
    filigree_encode_settings settings = FILIGREE_ENCODE_SETTINGS_INIT;
    filigree_micromaps* maps = bakedLeaf(context);
    filigree_set* set = NULL;
    settings.encoding = encoding;
    CHECK_CODE(FILIGREE_OK, &info, filigree_encode(context, maps, &settings, NULL, &set, &info));
    filigree_micromaps_destroy(maps);
    return set;
}

filigree_squares* squaresOfLeaf(const filigree_context* context, filigree_square_format format) {
    const filigree_image image = leafImage();
    const filigree_triangles triangles = leafTriangleList();
    filigree_error_info info = FILIGREE_ERROR_INFO_INIT;
    filigree_squares* squares = NULL;
    CHECK_CODE(FILIGREE_OK, &info,
               filigree_squares_encode(context, &triangles, &image, NULL, format, NULL, &squares, &info));
    return squares;
}

filigree_heightfield hillHeights(void) {
    static uint16_t heights[hillSide * hillSide * 2];
    filigree_heightfield field = FILIGREE_HEIGHTFIELD_INIT;
    for (int row = 0; row < hillSide; ++row) {
        for (int column = 0; column < hillSide; ++column)
            heights[2 * (row * hillSide + column)] =
                (uint16_t)(1000 + 37 * ((column * column + 3 * row * column) % 50));
    }
    field.heights = heights;
    field.columns = hillSide;
    field.rows = hillSide;
    field.type = FILIGREE_TEXEL_U16;
    field.height_stride = 4;
    field.height_scale = 1.0 / 1024;
    return field;
}

filigree_grids* gridsOfHills(const filigree_context* context) {
    const filigree_heightfield heights = hillHeights();
    filigree_error_info info = FILIGREE_ERROR_INFO_INIT;
    filigree_grids* grids = NULL;
    CHECK_CODE(FILIGREE_OK, &info,
               filigree_grids_create_from_heights(context, &heights, NULL, NULL, &grids, &info));
    return grids;
}

// What useEverything() makes; NULL where it is not made yet.
typedef struct Handles {
    filigree_micromaps* maps;
    filigree_micromaps* decoded;
    filigree_set* set;
    filigree_set* lossy;
    filigree_set* bitmask;
    filigree_set* parsedSet;
    filigree_squares* squares;
    filigree_squares* parsedSquares;
    filigree_grids* grids;
    filigree_grids* meshGrids;
    filigree_grids* parsedGrids;
    filigree_tracer* tracer;
    filigree_blob* blobs[3];
} Handles;

static void destroyAll(Handles* h) {
    filigree_micromaps_destroy(h->maps);
    filigree_micromaps_destroy(h->decoded);
    filigree_set_destroy(h->set);
    filigree_set_destroy(h->lossy);
    filigree_set_destroy(h->bitmask);
    filigree_set_destroy(h->parsedSet);
    filigree_squares_destroy(h->squares);
    filigree_squares_destroy(h->parsedSquares);
    filigree_tracer_destroy(h->tracer);
    filigree_grids_destroy(h->grids);
    filigree_grids_destroy(h->meshGrids);
    filigree_grids_destroy(h->parsedGrids);
    for (int k = 0; k < 3; ++k) filigree_blob_destroy(h->blobs[k]);
}

#define TRY(call)                             \
    do {                                      \
        const filigree_error code = (call);   \
        if (code != FILIGREE_OK) return code; \
    } while (0)

static filigree_error useMaps(const filigree_context* context, Handles* h, filigree_error_info* error) {
    const filigree_image image = leafImage();
    const filigree_triangles triangles = leafTriangleList();
    filigree_encode_settings settings = FILIGREE_ENCODE_SETTINGS_INIT;
    filigree_container_settings container = FILIGREE_CONTAINER_SETTINGS_INIT;
    uint8_t data[4096];
    size_t count = 0;
    settings.encoding = FILIGREE_ENCODING_DAG;
    settings.max_cost = 1;
    container.asset_name = "an asset with a long enough name.glb";
    TRY(filigree_bake(context, &triangles, &image, NULL, NULL, NULL, &h->maps, error));
    TRY(filigree_micromaps_get_data(h->maps, data, sizeof data, &count, error));
    TRY(filigree_encode(context, h->maps, NULL, NULL, &h->set, error));
    TRY(filigree_encode(context, h->maps, &settings, NULL, &h->lossy, error));
    TRY(filigree_encode_bitmask(context, &image, NULL, 4, NULL, &h->bitmask, error));
    TRY(filigree_decode(context, h->set, &h->decoded, error));
    TRY(filigree_set_serialise(context, h->set, &container, &h->blobs[0], error));
    return filigree_set_parse(context, filigree_blob_data(h->blobs[0]), filigree_blob_size(h->blobs[0]),
                              &h->parsedSet, error);
}

// Of triangles that share no edge: LEMON, which pairs triangles, loses memory where it runs out of it.
static filigree_error useSquares(const filigree_context* context, Handles* h, filigree_error_info* error) {
    static const uint16_t indices[] = {0, 1, 2, 5, 6, 7};
    const filigree_image image = leafImage();
    filigree_triangles triangles = leafTriangleList();
    filigree_container_settings settings = FILIGREE_CONTAINER_SETTINGS_INIT;
    settings.zstd = 1;
    triangles.indices = indices;
    triangles.triangle_count = 2;
    TRY(filigree_squares_encode(context, &triangles, &image, NULL, FILIGREE_SQUARE_VQ2, NULL, &h->squares,
                                error));
    TRY(filigree_squares_serialise(context, h->squares, &settings, &h->blobs[1], error));
    return filigree_squares_parse(context, filigree_blob_data(h->blobs[1]), filigree_blob_size(h->blobs[1]),
                                  &h->parsedSquares, error);
}

static filigree_error useGrids(const filigree_context* context, Handles* h, filigree_error_info* error) {
    static const float positions[][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}};
    static const uint8_t indices[] = {0, 1, 2, 0, 2, 3, 0, 1, 4};
    const filigree_heightfield heights = hillHeights();
    const filigree_ray ray = {{3, 100, 3}, {0.1F, -1, 0.1F}, 0, 1000};
    filigree_mesh mesh = FILIGREE_MESH_INIT;
    filigree_hit hit;
    filigree_grid_triangle triangle[2 * hillSide * hillSide];
    size_t count = 0;
    mesh.positions = positions[0];
    mesh.vertex_count = 5;
    mesh.indices = indices;
    mesh.index_bytes = 1;
    mesh.face_count = 3;
    TRY(filigree_grids_create_from_heights(context, &heights, NULL, NULL, &h->grids, error));
    TRY(filigree_grids_create(context, &mesh, NULL, NULL, &h->meshGrids, error));
    TRY(filigree_grids_serialise(context, h->meshGrids, NULL, &h->blobs[2], error));
    TRY(filigree_grids_parse(context, filigree_blob_data(h->blobs[2]), filigree_blob_size(h->blobs[2]),
                             &h->parsedGrids, error));
    TRY(filigree_grids_get_triangles(h->grids, triangle, 2 * hillSide * hillSide, &count, error));
    TRY(filigree_tracer_create(context, h->grids, &h->tracer, error));
    return filigree_tracer_closest(h->tracer, 1, &ray, 0, &hit, 0, error);
}

filigree_error useEverything(const filigree_context* context, filigree_error_info* error) {
    Handles handles = {0};
    filigree_error code = useMaps(context, &handles, error);
    if (code == FILIGREE_OK) code = useSquares(context, &handles, error);
    if (code == FILIGREE_OK) code = useGrids(context, &handles, error);
    destroyAll(&handles);
    return code;
}
