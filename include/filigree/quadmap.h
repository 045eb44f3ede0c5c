// Opacity maps of squares for pairs of triangles: squares from textures, VQ2, VQ4 and their `+` forms.
//
//     const std::array<uint8_t, 4> texels{0, 255, 255, 0};
//     const image::AlphaTexture leaf{image::alphaImageFrom8Bit(2, 2, texels)};
//     const quadmap::Square square = quadmap::SquareMaker(leaf, {}).ofTexture(quadmap::vq2Side);
//     const quadmap::Vq2Block block = quadmap::encodeVq2Plus(square);
//     const auto reader = quadmap::SquareReader::open(quadmap::SquareFormat::vq2Plus, block);
//     const quadmap::Region region = reader->at(0, quadmap::Half::first, 0.25F, 0.5F);
#pragma once

#include "filigree/quadmap/encode.h"
#include "filigree/quadmap/pairs.h"
#include "filigree/quadmap/place.h"
#include "filigree/quadmap/reader.h"
#include "filigree/quadmap/square.h"
#include "filigree/quadmap/squares.h"
#include "filigree/quadmap/transform.h"
#include "filigree/quadmap/two_state.h"
#include "filigree/quadmap/vq2.h"
#include "filigree/quadmap/vq4.h"
