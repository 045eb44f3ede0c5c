// The opacity squares of a scene, encoded.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/io/fil_squares.h"
#include "filigree/quadmap/reader.h"
#include "filigree/scene/scene.h"

#include "jobs/scene_pairs.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace filigree::jobs {

// Squares over all triangles of the groups' primitives, these in scene order. Equal blocks stand once.
struct SceneSquares {
    quadmap::SquareFormat format = quadmap::SquareFormat::vq2;
    std::vector<uint8_t> blocks;
    io::FilMeta meta;  // groups and primitives; the asset is left to the caller
    std::vector<const scene::Primitive*> primitives;  // [meta.primitives], of the scene
    std::vector<int32_t> indices;              // [triangle_count], a block or special: -1 T, -2 O, -4 C
    std::vector<quadmap::SquarePlace> places;  // [triangle_count]

    [[nodiscard]] size_t maps() const { return blocks.size() / blockBytesOf(format); }
};

// "vq2", "vq2+", "vq4" or "vq4+".
std::optional<quadmap::SquareFormat> squareFormatNamed(std::string_view name);

// VQ2 and VQ2+ as small in loss as can be, VQ4 and VQ4+ by their fast encoders. A triangle whose half is one
// state throughout needs no block.
Result<SceneSquares> encodeSquares(const scene::Scene& scene, const std::vector<PairGroup>& groups,
                                   quadmap::SquareFormat format, const Executor& executor,
                                   ProgressSink& progress);

}  // namespace filigree::jobs
