#include "jobs/vq_encoders.h"

#include "filigree/quadmap/vq2.h"
#include "filigree/quadmap/vq4.h"

namespace filigree::jobs {
namespace {

using quadmap::Prefer;
using quadmap::Square;

// The square that `region(block, x, y)` tells.
template <class Block, class Region>
Square decoded(const Block& block, unsigned side, Region region) {
    Square square(side);
    for (unsigned y = 0; y < side; ++y) {
        for (unsigned x = 0; x < side; ++x) square.at(x, y) = region(block, x, y);
    }
    return square;
}

template <class Transforms>
unsigned packed(const Transforms& transforms) {
    return transforms[1] | transforms[2] << 3 | transforms[3] << 6;
}

template <quadmap::Vq2Method method>
VqResult vq2(const Square& square, Prefer prefer) {
    const auto block = quadmap::encodeVq2(square, method, prefer);
    return {decoded(block, quadmap::vq2Side, quadmap::vq2Region),
            packed(quadmap::unpackVq2(block).transforms)};
}

VqResult vq2Plus(const Square& square, Prefer prefer) {
    const auto block = quadmap::encodeVq2Plus(square, prefer);
    return {decoded(block, quadmap::vq2Side, quadmap::vq2PlusRegion),
            packed(quadmap::unpackVq2(block).transforms)};
}

template <quadmap::Vq4Layout layout>
VqResult fromVq4(const quadmap::Vq4Block& block) {
    const auto region = [](const quadmap::Vq4Block& b, unsigned x, unsigned y) {
        return quadmap::vq4Region(b, layout, x, y);
    };
    return {decoded(block, quadmap::vq4Side, region), packed(quadmap::unpackVq4(block, layout).transforms)};
}

template <quadmap::Vq4Method method>
VqResult vq4(const Square& square, Prefer prefer) {
    return fromVq4<quadmap::Vq4Layout::vq4>(quadmap::encodeVq4(square, method, prefer));
}

VqResult vq4Plus(const Square& square, Prefer prefer) {
    return fromVq4<quadmap::Vq4Layout::vq4Plus>(
        quadmap::encodeVq4Plus(square, quadmap::Vq4Method::best, prefer));
}

constexpr VqEncoder encoders[] = {
    {VqMeasure::vq2Literal, VqMeasure::source16, 16, vq2<quadmap::Vq2Method::paperLiteral>},
    {VqMeasure::vq2Sensible, VqMeasure::source16, 16, vq2<quadmap::Vq2Method::paperSensible>},
    {VqMeasure::vq2Best, VqMeasure::source16, 16, vq2<quadmap::Vq2Method::best>},
    {VqMeasure::vq4Paper, VqMeasure::source32, 32, vq4<quadmap::Vq4Method::paper>},
    {VqMeasure::vq4Fast, VqMeasure::source32, 32, vq4<quadmap::Vq4Method::fast>},
    {VqMeasure::vq4Best, VqMeasure::source32, 32, vq4<quadmap::Vq4Method::best>},
    {VqMeasure::vq2Plus, VqMeasure::source16, 16, vq2Plus},
    {VqMeasure::vq4Plus, VqMeasure::source32, 32, vq4Plus},
};

struct Names {
    const char* name;
    const char* path;
};
constexpr PerMeasure<Names> names{{{"source 8x8", "source8"},
                                   {"source 16x16", "source16"},
                                   {"source 32x32", "source32"},
                                   {"source 64x64", "source64"},
                                   {"two 64-sub-triangle masks", "masks2x64"},
                                   {"raw 16x16", "raw16"},
                                   {"VQ2 paper, literal", "vq2/paper_literal"},
                                   {"VQ2 paper, sensible", "vq2/paper_sensible"},
                                   {"VQ2 best", "vq2/best"},
                                   {"VQ4 paper", "vq4/paper"},
                                   {"VQ4 fast", "vq4/fast"},
                                   {"VQ4 best", "vq4/best"},
                                   {"VQ2+", "vq2+"},
                                   {"VQ4+", "vq4+"}}};

}  // namespace

std::span<const VqEncoder> vqEncoders() {
    return encoders;
}

const char* nameOf(VqMeasure measure) {
    return names[indexOf(measure)].name;
}

const char* pathOf(VqMeasure measure) {
    return names[indexOf(measure)].path;
}

}  // namespace filigree::jobs
