// Format `vq2`: 16 x 16 regions in 256 bits (Fenney and Ozkan 2023, section 4). docs/spec/vq2.md.
#include "vq2_block.glsl"

// The region of a map at weights u and v of vertices 1 and 2 of one half: 0 transparent, 1 mixed, 2 opaque.
uint regionAt(uint map, uint half_, float u, float v) {
    return vq2State(vq2Region(map, regionIn(half_, u, v, 16u)));
}
