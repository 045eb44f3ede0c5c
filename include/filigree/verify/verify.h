// The independent judge of micromaps: shares no classification code with the baker.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/image/alpha_image.h"
#include "filigree/mesh/uv_triangle.h"
#include "filigree/micromap/set.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace filigree::verify {

// What is truly the case for one micro-triangle.
enum class Truth : uint8_t {
    transparent,  // every point passes as transparent, at every filter and level asked for
    opaque,       // every point passes as opaque
    mixed,        // both sides occur, or for blend a value between; also where a coordinate is not finite
    // A texel on the cutoff to within float rounding decides, or a product with a varying vertex alpha comes
    // too close to it, or the micro-triangle is too large to look at.
    uncertain,
};

// One finding, to show a person.
struct Finding {
    uint64_t triangle = 0;
    uint64_t microTriangle = 0;  // curve index
    unsigned level = 0;
    micromap::State state = micromap::State::transparent;
    Truth truth = Truth::mixed;
};

// What deepCheck() found.
struct DeepCounts {
    uint64_t microTriangles = 0;  // examined
    // 4-state: known, and for sure not that side throughout. 2-state: for sure the other side throughout.
    uint64_t wrong = 0;
    // 4-state: unknown, though for sure one side throughout. 2-state: 0.
    uint64_t overCautious = 0;
    uint64_t uncertain = 0;      // neither right nor wrong for sure: counted in none of the above
    std::vector<Finding> first;  // the first of the wrong ones, at most 16, in triangle order
};

// How much deepCheck() looks at.
struct DeepSettings {
    // Examine each micro-triangle with this probability, 0..1 (deterministic in triangle, micro-triangle and
    // seed); 1 examines all.
    double sample = 1.0;
    uint64_t seed = 1;
    // By which rule special indices are judged, which have no record that says so.
    micromap::Format specialFormat = micromap::Format::fourState;
};

// Judges micro-triangles over one texture under one test. Keeps a reference to `texture`. `test` must hold
// finite numbers >= 0. Calls may come from several threads at once.
class FILIGREE_API Judge {
  public:
    Judge(const image::AlphaTexture& texture, const image::AlphaTest& test);
    ~Judge();
    Judge(const Judge&) = delete;
    Judge& operator=(const Judge&) = delete;

    // The truth of micro-triangle `microTriangle` (curve index) of `triangle` at `level`, 0..maxLevel. Exact
    // where the vertex alpha is constant, touching included.
    [[nodiscard]] Truth truth(const mesh::UvTriangle& triangle, unsigned level, uint64_t microTriangle) const;

  private:
    std::unique_ptr<const class TextureJudge> judge_;
};

// Judge::truth for a single question: reads the whole texture first.
FILIGREE_API Truth truthOf(const mesh::UvTriangle& triangle, unsigned level, uint64_t microTriangle,
                           const image::AlphaTexture& texture, const image::AlphaTest& test);

// The share of the unwidened micro-triangle that is opaque at mip level 0, from samplesPerAxis^2 evenly
// spread samples; linear filtering unless the texture asks for nearest alone. For blend the share with alpha
// >= 1/2.
FILIGREE_API double opaqueShare(const mesh::UvTriangle& triangle, unsigned level, uint64_t microTriangle,
                                const image::AlphaTexture& texture, const image::AlphaTest& test,
                                unsigned samplesPerAxis);

// Checks every micro-triangle of every triangle against the texture. `set.indices` has one entry a triangle;
// special indices are checked as level-0 micromaps of that state. Triangles of non-finite coordinates must be
// unknown. ErrorKind::usage for settings or tests out of range, ErrorKind::format for indices and records
// that point outside, ErrorKind::cancelled.
FILIGREE_API Result<DeepCounts> deepCheck(std::span<const mesh::UvTriangle> triangles,
                                          const micromap::FlatSet& set, const image::AlphaTexture& texture,
                                          const image::AlphaTest& test, const DeepSettings& settings,
                                          const Executor& executor, ProgressSink& progress);

}  // namespace filigree::verify
