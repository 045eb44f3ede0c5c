// The independent judge of micromaps: shares no classification code with the baker.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/image/alpha_image.h"
#include "filigree/mesh/uv_triangle.h"
#include "filigree/micromap/set.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filigree::verify {

// What is truly the case for one micro-triangle.
enum class Truth : uint8_t {
    transparent,  // every point passes as transparent, at every filter and level asked for
    opaque,       // every point passes as opaque
    mixed,        // both sides occur
    uncertain,    // closer to the cutoff than the arithmetic can tell
};

// One finding, to show a person.
struct Finding {
    uint64_t triangle = 0;
    uint64_t microTriangle = 0;  // curve index
    unsigned level = 0;
    micromap::State state = micromap::State::transparent;
    Truth truth = Truth::mixed;
};

struct DeepCounts {
    uint64_t microTriangles = 0;  // examined
    // 4-state: known, and the truth is not that side throughout. 2-state: the truth is the other side throughout.
    uint64_t wrong = 0;
    // 4-state: unknown, though the truth is one side throughout. 2-state: 0.
    uint64_t overCautious = 0;
    uint64_t uncertain = 0;       // truth uncertain: counted in neither of the above
    std::vector<Finding> first;   // some of the wrong ones, at most 16, in triangle order
};

struct DeepSettings {
    // Examine each micro-triangle with this probability (deterministic in triangle, micro-triangle and seed); 1
    // examines all.
    double sample = 1.0;
    uint64_t seed = 1;
};

// The truth of one micro-triangle: corners in texel space of mip level 0 would lose exactness, so it takes the
// triangle, the level and the curve index.
Truth truthOf(const mesh::UvTriangle& triangle, unsigned level, uint64_t microTriangle,
              const image::AlphaTexture& texture, const image::AlphaTest& test);

// Checks every micro-triangle of every triangle against the texture. `set.indices` has one entry a triangle;
// special indices are checked as level-0 micromaps of that state.
Result<DeepCounts> deepCheck(std::span<const mesh::UvTriangle> triangles, const micromap::FlatSet& set,
                             const image::AlphaTexture& texture, const image::AlphaTest& test,
                             const DeepSettings& settings, const Executor& executor, ProgressSink& progress);

}  // namespace filigree::verify
