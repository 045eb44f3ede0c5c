// Looks up states of opacity micromaps with filigree_lookup.h alone: no library behind it.
//
//     lookup                         a leaf that this program carries
//     lookup scene.fil [TRIANGLE]    a file of `filigree compress`; triangles of all its primitives count
//
// Draws the triangle: '#' opaque, '.' transparent, '+' and '-' ask the alpha test (mostly opaque, or not).
#include "filigree_lookup.h"

#include <stdio.h>
#include <stdlib.h>

// One map of level 5 as `sdag`, four states; flat it takes 256 bytes.
static const uint8_t leaf_descriptors[57] = {
    0x00, 0x01, 0x00, 0x00, 0x20, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x04, 0x00, 0x00,
    0x00, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x75, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00};
static const uint8_t leaf_payload[162] = {
    0x80, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x02, 0x9c, 0x00, 0x00, 0x00, 0x02, 0x31, 0x00, 0x00, 0xd6,
    0x6f, 0x21, 0x00, 0xc4, 0x23, 0x33, 0xcc, 0x33, 0x00, 0x00, 0x00, 0x00, 0x04, 0x23, 0x34, 0x45, 0x03,
    0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x52, 0xb5, 0x0e, 0x0e, 0x55, 0x52, 0x7b, 0x80, 0x00, 0xd5, 0x55,
    0x55, 0x08, 0x2d, 0xd5, 0x08, 0x0d, 0x25, 0x55, 0x57, 0x5e, 0x7b, 0x60, 0xc0, 0x01, 0x00, 0xff, 0xff,
    0xff, 0x53, 0xd5, 0x07, 0x5d, 0x60, 0x80, 0x55, 0x55, 0x55, 0x2e, 0xb5, 0xd5, 0x00, 0xff, 0xff, 0x01,
    0xff, 0x07, 0x55, 0x5b, 0x0c, 0x25, 0x95, 0x55, 0x55, 0x57, 0x5d, 0x78, 0xe0, 0x02, 0xff, 0xff, 0xff,
    0xff, 0x01, 0xff, 0xff, 0xff, 0xff, 0x00, 0xff, 0x08, 0x80, 0xf0, 0xb5, 0x00, 0x5d, 0x02, 0x00, 0xe0,
    0x00, 0x23, 0xbf, 0x80, 0x00, 0x00, 0xc2, 0xe0, 0x80, 0x97, 0xd5, 0xd5, 0x00, 0x00, 0x0a, 0x55, 0x57,
    0xfa, 0x00, 0xb0, 0xe0, 0x00, 0x02, 0x03, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00};

static void draw(const filigree_view* maps, uint32_t map) {
    static const char marks[] = ".#-+";
    const int rows = 32;
    int row;
    int column;
    for (row = 0; row < rows; ++row) {
        for (column = 0; row + column / 2 < rows; ++column) {
            const float u = ((float)column + 0.25f) / (float)(2 * rows);
            const float v = ((float)row + 0.25f) / (float)rows;
            putchar(marks[filigree_view_at_point(maps, map, u, v)]);
        }
        putchar('\n');
    }
}

static int fail(const char* what, const char* why) {
    fprintf(stderr, "lookup: %s: %s\n", what, why);
    return 1;
}

static int draw_leaf(void) {
    filigree_view maps;
    const filigree_lookup_error error =
        filigree_view_open(&maps, FILIGREE_SDAG, FILIGREE_FOUR_STATE, 1, leaf_descriptors,
                           sizeof leaf_descriptors, leaf_payload, sizeof leaf_payload);
    if (error != FILIGREE_LOOKUP_OK) return fail("the leaf", filigree_lookup_error_text(error));
    draw(&maps, 0);
    return 0;
}

// The whole file, to be freed; null where it cannot be read.
static uint8_t* read_file(const char* path, size_t* size) {
    FILE* file = fopen(path, "rb");
    uint8_t* bytes = NULL;
    long end = -1;
    if (file == NULL) return NULL;
    if (fseek(file, 0, SEEK_END) == 0) end = ftell(file);
    if (end > 0 && fseek(file, 0, SEEK_SET) == 0) bytes = (uint8_t*)malloc((size_t)end);
    if (bytes != NULL && fread(bytes, 1, (size_t)end, file) != (size_t)end) {
        free(bytes);
        bytes = NULL;
    }
    fclose(file);
    *size = end > 0 ? (size_t)end : 0;
    return bytes;
}

static int draw_triangle(const filigree_fil* file, const char* path, unsigned long triangle) {
    filigree_view maps;
    const filigree_lookup_error error = filigree_view_open_fil(&maps, file);
    int32_t map;
    if (error != FILIGREE_LOOKUP_OK) return fail(path, filigree_lookup_error_text(error));
    map = filigree_fil_index(file, triangle);
    printf("%s: encoding %u, %lu maps\n", path, file->encoding, (unsigned long)file->map_count);
    if (map < 0) {
        printf("triangle %lu: state %u throughout\n", triangle, filigree_special_state(map));
        return 0;
    }
    printf("triangle %lu: map %ld, level %u\n", triangle, (long)map,
           filigree_view_level(&maps, (uint32_t)map));
    draw(&maps, (uint32_t)map);
    return 0;
}

int main(int argc, char** argv) {
    filigree_fil file;
    filigree_lookup_error error;
    size_t size;
    uint8_t* bytes;
    int result;

    if (argc < 2) return draw_leaf();
    bytes = read_file(argv[1], &size);
    if (bytes == NULL) return fail(argv[1], "cannot be read");
    error = filigree_fil_open(&file, bytes, size);
    result = error != FILIGREE_LOOKUP_OK
                 ? fail(argv[1], filigree_lookup_error_text(error))
                 : draw_triangle(&file, argv[1], argc > 2 ? strtoul(argv[2], NULL, 10) : 0);
    free(bytes);
    return result;
}
