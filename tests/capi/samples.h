// Small inputs for tests of the C API.
#ifndef FILIGREE_TESTS_CAPI_SAMPLES_H
#define FILIGREE_TESTS_CAPI_SAMPLES_H

#include "filigree.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { leafSide = 32, leafTriangles = 6, hillSide = 21 };

// The alpha of a disc over 32 x 32 texels, as the fourth of four bytes a texel.
filigree_image leafImage(void);

// A card of two triangles over the disc, two beside it that reach over the border, one within it, one
// outside.
filigree_triangles leafTriangleList(void);

// The card baked with the defaults, encoded with the defaults, and as squares. NULL is a failed check.
filigree_micromaps* bakedLeaf(const filigree_context* context);
filigree_set* encodedLeaf(const filigree_context* context, filigree_encoding encoding);
filigree_squares* squaresOfLeaf(const filigree_context* context, filigree_square_format format);

// Hills of 21 x 21 vertices, 16-bit, two bytes apart from each other.
filigree_heightfield hillHeights(void);
filigree_grids* gridsOfHills(const filigree_context* context);

// Every kind of handle made from samples and used; the first error, with all handles destroyed.
filigree_error useEverything(const filigree_context* context, filigree_error_info* error);

#ifdef __cplusplus
}
#endif

#endif
