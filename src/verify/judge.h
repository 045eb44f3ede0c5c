// From a triangle and a texture to verdicts on micro-triangles.
#pragma once

#include "filigree/mesh/uv_triangle.h"
#include "filigree/micromap/curve.h"
#include "filigree/verify/verify.h"

#include "verify/limits.h"
#include "verify/rounded.h"

#include <deque>
#include <optional>
#include <vector>

namespace filigree::verify {

// All that a verdict needs of a texture and a test: the mip levels, the filters, the limits.
class TextureJudge {
  public:
    TextureJudge(const image::AlphaTexture& texture, const image::AlphaTest& test);

    [[nodiscard]] const std::vector<Layer>& layers() const { return layers_; }
    [[nodiscard]] const std::vector<Filtering>& filterings() const { return filterings_; }
    [[nodiscard]] const image::AlphaTest& test() const { return test_; }
    // For vertex alpha 1.
    [[nodiscard]] const Limits& limits() const { return limits_; }

  private:
    image::AlphaTest test_;
    std::deque<image::AlphaImage> coarser_;
    std::vector<Layer> layers_;
    std::vector<Filtering> filterings_;
    Limits limits_;
};

// Judges the micro-triangles of one triangle.
class TriangleJudge {
  public:
    TriangleJudge(const TextureJudge& judge, const mesh::UvTriangle& triangle);

    [[nodiscard]] Verdict verdict(unsigned level, uint64_t microTriangle) const;

  private:
    // The triangle's vertices in the texels of one layer.
    struct Frame {
        std::array<Point<double>, 3> vertices;
        double margin;
    };

    void place();
    [[nodiscard]] RoundedShape shape(const Frame& frame, Filtering filtering, unsigned level,
                                     const micromap::LatticeTriangle& place) const;
    [[nodiscard]] Verdict verdictOn(size_t layer, Filtering filtering, unsigned level,
                                    const micromap::LatticeTriangle& place) const;
    [[nodiscard]] Verdict shadedVerdict(const Layer& layer, Filtering filtering, const RoundedShape& shape,
                                        unsigned level, const micromap::LatticeTriangle& place) const;

    const TextureJudge& judge_;
    const mesh::UvTriangle& triangle_;
    std::optional<Verdict> always_;  // where no closer look is needed or possible
    bool shaded_ = false;            // the vertex alpha varies
    std::optional<Limits> own_;      // for a constant vertex alpha other than 1
    std::vector<Frame> frames_;      // by layer
};

// The truth that a verdict amounts to.
Truth truthOf(const Verdict& verdict);

}  // namespace filigree::verify
