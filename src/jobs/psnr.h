// How far two pictures differ.
#pragma once

#include "filigree/scene/scene.h"

namespace filigree::jobs {

// Peak signal-to-noise ratio of two pictures of one size, in dB over red, green and blue; infinite where they
// are equal.
double psnr(const scene::ColourImage& a, const scene::ColourImage& b);

}  // namespace filigree::jobs
