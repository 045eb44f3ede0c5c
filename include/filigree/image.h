// Alpha images, and the alpha that a shader gets from them: filters, wrap modes, mip levels.
//
//     const std::array<uint8_t, 4> texels{0, 255, 255, 0};  // the caller's
//     const image::AlphaTexture leaf{image::alphaImageFrom8Bit(2, 2, texels)};
//     const double alpha = image::sampleBilinear(leaf, 1, 1);  // 0.5
#pragma once

#include "filigree/image/alpha_image.h"
#include "filigree/image/alpha_sides.h"
#include "filigree/image/extremes.h"
#include "filigree/image/mip_chain.h"
#include "filigree/image/outline.h"
#include "filigree/image/patch.h"
#include "filigree/image/placement.h"
#include "filigree/image/threshold.h"
#include "filigree/image/widened.h"
