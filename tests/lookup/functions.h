// The functions of filigree_lookup.h as one compiler makes them, so that a test may compare compilers.
#pragma once

// Both at once: no name of one may clash with the other.
#include "filigree.h"
#include "filigree_lookup.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lookup_functions {
    const char* compiler;
    uint32_t (*curve_index_at)(float, float, unsigned);
    filigree_lookup_error (*view_open)(filigree_view*, unsigned, unsigned, uint32_t, const void*, size_t,
                                       const void*, size_t);
    unsigned (*view_level)(const filigree_view*, uint32_t);
    unsigned (*view_at)(const filigree_view*, uint32_t, uint32_t);
    unsigned (*view_at_point)(const filigree_view*, uint32_t, float, float);
    filigree_lookup_error (*vq_open)(filigree_vq*, unsigned, uint32_t, const void*, size_t);
    unsigned (*vq_at)(const filigree_vq*, uint32_t, unsigned, unsigned);
    unsigned (*vq_at_point)(const filigree_vq*, uint32_t, unsigned, float, float);
    unsigned (*vq_at_triangle)(const filigree_vq*, uint32_t, unsigned, float, float);
    filigree_lookup_error (*fil_open)(filigree_fil*, const void*, size_t);
    int32_t (*fil_index)(const filigree_fil*, uint64_t);
    unsigned (*fil_place)(const filigree_fil*, uint64_t);
    filigree_lookup_error (*fil_triangles)(const filigree_fil*, uint32_t, uint32_t, uint64_t*, uint32_t*);
} lookup_functions;

const lookup_functions* lookup_functions_c99(void);
const lookup_functions* lookup_functions_portable(void);
const lookup_functions* lookup_functions_cxx11(void);

#ifdef __cplusplus
}
#endif
