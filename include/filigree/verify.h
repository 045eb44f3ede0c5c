// The independent judge of micromaps: is every state that is called known truly so?
//
//     const std::array<uint8_t, 4> texels{0, 255, 255, 0};
//     const image::AlphaTexture leaf{image::alphaImageFrom8Bit(2, 2, texels)};
//     const mesh::UvTriangle triangle{{{{0, 0}, {1, 0}, {0, 1}}}};
//     const bool mixed = verify::truthOf(triangle, 0, 0, leaf, {}) == verify::Truth::mixed;
#pragma once

#include "filigree/verify/verify.h"
