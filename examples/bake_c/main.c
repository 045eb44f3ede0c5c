#include <filigree.h>
#include <stdio.h>

int main(void) {
    static uint8_t rgba[64 * 64 * 4];  // a picture of yours; here opaque right of its diagonal
    for (int k = 0; k < 64 * 64; ++k) rgba[4 * k + 3] = k % 64 > k / 64 ? 255 : 0;
    const float uvs[] = {0, 0, 1, 0, 0, 1, 1, 0, 1, 1, 0, 1};  // two triangles
    filigree_image image = FILIGREE_IMAGE_INIT;
    image.texels = rgba + 3;
    image.width = image.height = 64;
    image.texel_stride = 4;
    filigree_triangles triangles = FILIGREE_TRIANGLES_INIT;
    triangles.triangle_count = 2;
    triangles.uvs = uvs;
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    filigree_micromaps* maps;
    if (filigree_bake(NULL, &triangles, &image, NULL, NULL, NULL, &maps, &error) != FILIGREE_OK)
        return fprintf(stderr, "%s\n", error.message), 1;
    filigree_micromaps_info info = FILIGREE_MICROMAPS_INFO_INIT;
    filigree_micromaps_get_info(maps, &info, NULL);
    printf("%u micromaps, %u bytes\n", info.record_count, (unsigned)info.data_bytes);
    filigree_micromaps_destroy(maps);
}
