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
