// From pairs of textured triangles to encoded squares, and where each triangle stands in them.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/executor.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/image/alpha_image.h"
#include "filigree/mesh/pairing.h"
#include "filigree/mesh/uv_triangle.h"
#include "filigree/quadmap/place.h"
#include "filigree/quadmap/reader.h"
#include "filigree/quadmap/squares.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace filigree::quadmap {

// Two triangles, or one, in the order of their square (quadmap/place.h).
struct SquarePair {
    HalfTriangle first;
    std::optional<HalfTriangle> second;
};

// `triangle` with its vertices in the pair's order.
inline HalfTriangle inSquare(const mesh::UvTriangle& triangle, const mesh::PairedTriangle& paired) {
    return {mesh::inOrder(triangle.uv, paired), mesh::inOrder(triangle.alpha, paired)};
}

// Each kind of pair once, in the order of first use: equal coordinates and vertex alphas, bit for bit.
class FILIGREE_API DistinctPairs {
  public:
    // The number of the pair among pairs().
    uint32_t add(const SquarePair& pair);
    [[nodiscard]] const std::vector<SquarePair>& pairs() const { return pairs_; }

  private:
    std::vector<SquarePair> pairs_;
    std::map<std::array<uint32_t, 19>, uint32_t> numbers_;
};

// A pair's square, encoded.
struct EncodedPair {
    static constexpr int32_t needsBlock = 0;

    std::vector<uint8_t> block;  // empty where neither half needs one
    // What each half is throughout, as a special index (-1 transparent, -2 opaque, -4 mixed), or needsBlock.
    std::array<int32_t, 2> special{needsBlock, needsBlock};
};

// VQ2 and VQ2+ as small in loss as can be, VQ4 and VQ4+ by their fast encoders; no raw format. A half that is
// one state throughout needs no block.
FILIGREE_API EncodedPair encodePair(const SquareMaker& maker, const SquarePair& pair, SquareFormat format);

// Encoded squares of one format and how triangles find them.
struct SquareSet {
    SquareFormat format = SquareFormat::vq2;
    std::vector<uint8_t> blocks;      // equal ones once
    std::vector<int32_t> indices;     // [triangle_count], a block or special: -1 T, -2 O, -4 C
    std::vector<SquarePlace> places;  // [triangle_count], default where the index is special
};

// Gathers blocks, equal ones once.
class FILIGREE_API BlockList {
  public:
    // Writes index and place of the pair's triangles to indices[triangle] and places[triangle].
    void add(const mesh::TrianglePair& pair, const EncodedPair& encoded, std::span<int32_t> indices,
             std::span<SquarePlace> places);
    std::vector<uint8_t> take() && { return std::move(blocks_); }

  private:
    int32_t numberOf(const std::vector<uint8_t>& block);

    std::vector<uint8_t> blocks_;
    std::map<std::vector<uint8_t>, int32_t> numbers_;
};

// Squares of `triangles`, paired as mesh::pairTriangles pairs them, over one texture. The result does not
// depend on the executor. Fails with ErrorKind::cancelled, and with ErrorKind::usage for a raw format.
FILIGREE_API Result<SquareSet> encodeSquares(std::span<const mesh::UvTriangle> triangles,
                                             std::span<const mesh::TrianglePair> pairs,
                                             const image::AlphaTexture& texture, const image::AlphaTest& test,
                                             SquareFormat format, const Executor& executor = serialExecutor(),
                                             ProgressSink& progress = silentProgress());

}  // namespace filigree::quadmap
