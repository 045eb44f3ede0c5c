// Opacity squares from C.
#include "check.h"
#include "samples.h"
#include "suites.h"

static void checkSquares(filigree_square_format format, uint32_t side) {
    filigree_squares* squares = squaresOfLeaf(NULL, format);
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    filigree_squares_info info = FILIGREE_SQUARES_INFO_INIT;
    uint8_t blocks[leafTriangles * 64];
    int32_t indices[leafTriangles];
    uint8_t places[leafTriangles];
    size_t count = 0;
    CHECK_CODE(FILIGREE_OK, &error, filigree_squares_get_info(squares, &info, &error));
    CHECK(info.triangle_count == leafTriangles && info.side == side && info.format == (uint32_t)format);
    CHECK(info.block_count >= 1 && info.block_bytes == side * 2);
    CHECK_CODE(FILIGREE_OK, &error,
               filigree_squares_get_blocks(squares, blocks, sizeof blocks, &count, &error));
    CHECK(count == info.block_count * info.block_bytes);
    CHECK_CODE(FILIGREE_OK, &error,
               filigree_squares_get_indices(squares, indices, leafTriangles, &count, &error));
    CHECK_CODE(FILIGREE_OK, &error,
               filigree_squares_get_places(squares, places, leafTriangles, &count, &error));
    CHECK(count == leafTriangles);
    CHECK(indices[4] == -2 && indices[5] == -1);
    // The card's two triangles are one pair.
    CHECK(indices[0] >= 0 && indices[0] == indices[1] && (places[0] & 1) != (places[1] & 1));
    CHECK(filigree_squares_triangle_region(squares, 0, 0.01F, 0.01F) == FILIGREE_REGION_TRANSPARENT);
    CHECK(filigree_squares_triangle_region(squares, 4, 0.3F, 0.3F) == FILIGREE_REGION_OPAQUE);
    CHECK(filigree_squares_triangle_region(squares, 5, 0.3F, 0.3F) == FILIGREE_REGION_TRANSPARENT);
    CHECK(filigree_squares_triangle_region(squares, leafTriangles, 0, 0) == -1);
    CHECK(filigree_squares_triangle_region(NULL, 0, 0, 0) == -1);
    filigree_squares_destroy(squares);
}

static void checkBatch(void) {
    enum { queries = 2100 };
    static uint32_t blocks[queries];
    static uint8_t halves[queries], regions[queries];
    static float u[queries], v[queries];
    filigree_squares* squares = squaresOfLeaf(NULL, FILIGREE_SQUARE_VQ2_PLUS);
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    int32_t indices[leafTriangles];
    uint8_t places[leafTriangles];
    size_t count = 0;
    filigree_squares_get_indices(squares, indices, leafTriangles, &count, NULL);
    filigree_squares_get_places(squares, places, leafTriangles, &count, NULL);
    // Triangle 0 in the order in which it stands: its own weights are those of the half where that is 0 1 2.
    for (int k = 0; k < queries; ++k) {
        const float weights[3] = {1 - (float)(k % 50 + k / 50) / 100, (float)(k % 50) / 100,
                                  (float)(k / 50) / 100};
        static const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}};
        const int* order = orders[places[0] >> 1];
        blocks[k] = (uint32_t)indices[0];
        halves[k] = places[0] & 1;
        u[k] = weights[order[1]];
        v[k] = weights[order[2]];
    }
    CHECK_CODE(FILIGREE_OK, &error,
               filigree_squares_lookup(squares, queries, blocks, halves, u, v, regions, &error));
    int differing = 0;
    for (int k = 0; k < queries; ++k) {
        const float ownU = (float)(k % 50) / 100 + 0.001F, ownV = (float)(k / 50) / 100 + 0.001F;
        if (filigree_squares_triangle_region(squares, 0, ownU, ownV) != regions[k]) ++differing;
    }
    CHECK(differing < queries / 20);  // points near the regions' borders
    halves[2000] = 2;
    CHECK_CODE(FILIGREE_ERROR_ARGUMENT, &error,
               filigree_squares_lookup(squares, queries, blocks, halves, u, v, regions, &error));
    halves[2000] = 1;
    blocks[7] = 1000;
    CHECK_CODE(FILIGREE_ERROR_ARGUMENT, &error,
               filigree_squares_lookup(squares, queries, blocks, halves, u, v, regions, &error));
    filigree_squares_destroy(squares);
}

// Without positions texture coordinates tell which edges are shared.
static void checkWithoutPositions(void) {
    const filigree_image image = leafImage();
    filigree_triangles triangles = leafTriangleList();
    filigree_error_info error = FILIGREE_ERROR_INFO_INIT;
    filigree_squares* squares = NULL;
    int32_t indices[leafTriangles];
    size_t count = 0;
    triangles.positions = NULL;
    CHECK_CODE(
        FILIGREE_OK, &error,
        filigree_squares_encode(NULL, &triangles, &image, NULL, FILIGREE_SQUARE_VQ4, NULL, &squares, &error));
    filigree_squares_get_indices(squares, indices, leafTriangles, &count, NULL);
    CHECK(indices[0] >= 0 && indices[0] == indices[1]);
    filigree_squares_destroy(squares);
}

int squaresSuite(void) {
    failedChecks = 0;
    checkSquares(FILIGREE_SQUARE_VQ2, 16);
    checkSquares(FILIGREE_SQUARE_VQ2_PLUS, 16);
    checkSquares(FILIGREE_SQUARE_VQ4, 32);
    checkSquares(FILIGREE_SQUARE_VQ4_PLUS, 32);
    checkBatch();
    checkWithoutPositions();
    return failedChecks;
}
