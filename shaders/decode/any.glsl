// The decoder that ENCODING names: one of the numbers below. Shaders are compiled once for each.
#define FLAT 0
#define GRUEN 1
#define BITMASK 2
#define TREE 3
#define INDEXED_TREE 4
#define DAG 5
#define SDAG 6
#define VQ2 7
#define VQ2_PLUS 8
#define VQ4 9
#define VQ4_PLUS 10
#define NO_MAPS 11

#if ENCODING == FLAT
#include "flat.glsl"
#elif ENCODING == GRUEN
#include "gruen.glsl"
#elif ENCODING == BITMASK
#include "bitmask.glsl"
#elif ENCODING == TREE
#include "tree.glsl"
#elif ENCODING == INDEXED_TREE
#include "indexed_tree.glsl"
#elif ENCODING == DAG
#include "dag.glsl"
#elif ENCODING == SDAG
#include "sdag.glsl"
#elif ENCODING == VQ2
#include "vq2.glsl"
#elif ENCODING == VQ2_PLUS
#include "vq2_plus.glsl"
#elif ENCODING == VQ4
#include "vq4.glsl"
#elif ENCODING == VQ4_PLUS
#include "vq4_plus.glsl"
#else
#include "blocks.glsl"
#endif
