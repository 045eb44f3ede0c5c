// The caller's images and alpha tests as the rooms take them.
#pragma once

#include "filigree/image/alpha_image.h"

#include "filigree.h"

namespace filigree::capi {

image::AlphaTexture textureOf(const filigree_image* given);
image::AlphaTest testOf(const filigree_alpha_test* given);

}  // namespace filigree::capi
