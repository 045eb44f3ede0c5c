// From textured triangles to opacity micromaps. docs/spec/bake.md defines every state this makes.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/image/alpha_image.h"
#include "filigree/mesh/uv_triangle.h"
#include "filigree/micromap/set.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace filigree::bake {

// How micromaps are baked.
struct Settings {
    micromap::Format format = micromap::Format::fourState;
    // The level of every micromap, 0..12. Without it each triangle gets its highest useful level (Waldemarson
    // and Doggett 2024, eq. 1): ceil(log2(longest edge in texels)), at most maxLevel.
    std::optional<unsigned> level{};
    unsigned maxLevel = 8;  // 0..12, used without `level`
    // Levels per triangle, [triangle_count], 0..12; overrides `level` where not empty.
    std::span<const uint8_t> levels{};
    // Lets a triangle's vertex order rotate (winding kept) where it then shares a micromap; see
    // Baked::rotations.
    bool rotate = false;
};

// What a bake did, for reports.
struct Statistics {
    uint64_t triangles = 0;
    uint64_t distinctTriangles = 0;                     // after equal UV triangles are merged
    uint64_t nonFiniteTriangles = 0;                    // NaN, infinite or too large UVs: unknown-opaque
    uint64_t microTriangles = 0;                        // of all triangles, shared or not
    micromap::StateCounts states;                       // of all triangles, shared or not
    uint64_t trianglesAt[micromap::maxLevel + 1] = {};  // how many triangles were baked at each level
};

// What a bake makes.
struct Baked {
    micromap::TreeSet set;
    std::vector<uint8_t> levels;  // [triangle_count], the level each triangle was baked at, special or not
    std::vector<uint8_t>
        rotations;  // [triangle_count] with Settings::rotate: new vertex k is old (k + r) % 3
    Statistics statistics;
};

// Bakes `triangles` over `texture` under `test`. A state is known only where it is certain (AlphaTest). The
// result does not depend on the executor or the instruction set. Fails on settings out of range and when
// cancelled.
FILIGREE_API Result<Baked> bake(std::span<const mesh::UvTriangle> triangles,
                                const image::AlphaTexture& texture, const image::AlphaTest& test,
                                const Settings& settings = {}, const Executor& executor = serialExecutor(),
                                ProgressSink& progress = silentProgress());

// The highest useful level of a triangle on a texture of width x height texels, clamped to `maxLevel`. 0 when
// a UV is not finite.
FILIGREE_API unsigned usefulLevel(const mesh::UvTriangle& triangle, uint32_t width, uint32_t height,
                                  unsigned maxLevel);

}  // namespace filigree::bake
