// Where the squares of one texture come from: a crop of it, or the pairs of a scene's triangles.
#pragma once

#include "filigree/core/executor.h"
#include "filigree/core/result.h"
#include "filigree/image/alpha_image.h"
#include "filigree/jobs/vq.h"
#include "filigree/quadmap/squares.h"

#include "jobs/scene_pairs.h"

#include <cstdint>
#include <string>
#include <vector>

namespace filigree::jobs {

// A texture and the squares to make over it.
struct VqInput {
    std::string name;
    image::AlphaTexture texture;
    image::AlphaTest test;
    quadmap::Crop crop;             // what a picture shows; the square's, where there are no pairs
    std::vector<SquarePair> pairs;  // distinct ones; empty for one square over `crop`
    uint64_t pairCount = 1;         // before those that are alike
    uint64_t singles = 0;

    [[nodiscard]] size_t maps() const { return pairs.empty() ? 1 : pairs.size(); }
};

// A PNG as one square. ErrorKind::format where no texel is visible.
Result<VqInput> readVqTexture(const std::filesystem::path& path, const VqOptions& options);

// The masked triangles of a scene, paired within each primitive, by alpha source.
Result<std::vector<VqInput>> readVqScene(const std::filesystem::path& path, const VqOptions& options,
                                         std::vector<std::string>& notes);

// Map k of the input, `side` regions a side.
quadmap::Square squareOf(const VqInput& input, const quadmap::SquareMaker& maker, size_t k, unsigned side);

// The known share of the 64 micro-triangles of each of a map's triangles, for every map.
Result<std::vector<double>> maskSavings(const VqInput& input, const Executor& executor);

}  // namespace filigree::jobs
