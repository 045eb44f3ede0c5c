#include "filigree/micromap/curve.h"
#include "filigree/verify/verify.h"

#include "verify/arithmetic.h"
#include "verify/layer.h"

#include <cassert>

namespace filigree::verify {
namespace {

struct Sample {
    double u = 0;
    double v = 0;
    double alpha = 0;
};

// The triangle's attributes at lattice coordinates (i, j) of a lattice with n steps an edge.
Sample interpolated(const mesh::UvTriangle& triangle, double i, double j, double n) {
    const std::array<double, 3> weights{(n - i - j) / n, i / n, j / n};
    Sample sample;
    for (size_t k = 0; k < 3; ++k) {
        sample.u += weights[k] * double{triangle.uv[k].u};
        sample.v += weights[k] * double{triangle.uv[k].v};
        sample.alpha += weights[k] * double{triangle.alpha[k]};
    }
    return sample;
}

double filtered(const Layer& layer, image::Filter filter, const Sample& at) {
    const double x = at.u * layer.width();
    const double y = at.v * layer.height();
    if (filter == image::Filter::nearest) return layer.texel(floorInt(x), floorInt(y)) / 65535.0;
    const int64_t column = floorInt(x - 0.5);
    const int64_t row = floorInt(y - 0.5);
    return bilinear(layer.cell(column, row), x - 0.5 - static_cast<double>(column),
                    y - 0.5 - static_cast<double>(row)) /
           65535.0;
}

}  // namespace

double opaqueShare(const mesh::UvTriangle& triangle, unsigned level, uint64_t microTriangle,
                   const image::AlphaTexture& texture, const image::AlphaTest& test,
                   unsigned samplesPerAxis) {
    assert(samplesPerAxis > 0);
    const Layer layer(texture.image, texture.wrapU, texture.wrapV);
    const auto corners =
        micromap::corners(micromap::latticeTriangle(static_cast<uint32_t>(microTriangle), level));
    const double n = static_cast<double>(uint32_t{1} << level);
    const double direction =
        corners[1].i > corners[0].i ? 1 : -1;  // flipped micro-triangles run the other way
    const double step = direction / samplesPerAxis;
    const double threshold = test.mode == image::AlphaMode::blend ? 0.5 : test.cutoff;
    uint64_t opaque = 0;
    const auto look = [&](double i, double j) {
        const Sample sample = interpolated(triangle, corners[0].i + i * step, corners[0].j + j * step, n);
        if (filtered(layer, texture.filter, sample) * sample.alpha * test.factor >= threshold) ++opaque;
    };
    // The centroids of the small triangles that samplesPerAxis cuts an edge make.
    for (unsigned j = 0; j < samplesPerAxis; ++j) {
        for (unsigned i = 0; i + j < samplesPerAxis; ++i) {
            look(i + 1 / 3.0, j + 1 / 3.0);
            if (i + j + 1 < samplesPerAxis) look(i + 2 / 3.0, j + 2 / 3.0);
        }
    }
    return static_cast<double>(opaque) / (static_cast<double>(samplesPerAxis) * samplesPerAxis);
}

}  // namespace filigree::verify
