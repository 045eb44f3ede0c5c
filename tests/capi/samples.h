// Small inputs for tests of the C API.
#ifndef FILIGREE_TESTS_CAPI_SAMPLES_H
#define FILIGREE_TESTS_CAPI_SAMPLES_H

#include "filigree.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { leafSide = 32, leafTriangles = 6 };

// The alpha of a disc over 32 x 32 texels, as the fourth of four bytes a texel.
filigree_image leafImage(void);

// A card of two triangles over the disc, two beside it that reach over the border, one within it, one
// outside.
filigree_triangles leafTriangleList(void);

// The card baked with the defaults, the defaults encoded. NULL is a failed check.
filigree_micromaps* bakedLeaf(const filigree_context* context);
filigree_set* encodedLeaf(const filigree_context* context, filigree_encoding encoding);

#ifdef __cplusplus
}
#endif

#endif
