// Format `vq2`: 16 x 16 regions in 256 bits (Fenney and Ozkan 2023, section 4). docs/spec/vq2.md.
#include "vq2_block.glsl"

// The region of a map in a column and row: 0 transparent, 1 mixed, 2 opaque.
uint regionAt(uint map, uvec2 at) {
    return vq2State(vq2Region(map, at));
}
