// The encoders of squares, as one list.
#pragma once

#include "filigree/jobs/vq.h"
#include "filigree/quadmap/encode.h"
#include "filigree/quadmap/square.h"

#include <array>
#include <span>

namespace filigree::jobs {

// A square after an encoder, and the transforms of its quadrants that it chose, three bits each.
struct VqResult {
    quadmap::Square square;
    unsigned transforms = 0;
};

struct VqEncoder {
    VqMeasure measure;
    VqMeasure source;  // the square that it encodes
    unsigned side;
    VqResult (*run)(const quadmap::Square& square, quadmap::Prefer prefer);
};

// All encoders of this version, in the order of their measures.
std::span<const VqEncoder> vqEncoders();

// The name of a measure for people, and its place in the JSON result ("vq2/best").
const char* nameOf(VqMeasure measure);
const char* pathOf(VqMeasure measure);

inline size_t indexOf(VqMeasure measure) {
    return static_cast<size_t>(measure);
}

}  // namespace filigree::jobs
