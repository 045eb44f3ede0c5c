#include "jobs/scene_squares.h"

#include "filigree/quadmap/encode.h"

#include "jobs/one_stage.h"

#include <algorithm>
#include <array>
#include <map>

namespace filigree::jobs {
namespace {

using quadmap::Half;
using quadmap::Region;
using quadmap::Square;
using quadmap::SquareFormat;

constexpr int32_t needsBlock = 0;

// A distinct pair: its block, empty where neither half needs one, and what each half is throughout.
struct EncodedPair {
    std::vector<uint8_t> block;
    std::array<int32_t, 2> special{needsBlock, needsBlock};
};

bool isIn(Half half, const Square& square, unsigned x, unsigned y) {
    return half == Half::first ? x + y < square.side : x + y + 1 >= square.side;
}

// The special index of a half that is one state throughout, else needsBlock.
int32_t specialOf(const Square& square, Half half) {
    const unsigned last = square.side - 1;
    const Region first = half == Half::first ? square.at(0, 0) : square.at(last, last);
    for (unsigned y = 0; y < square.side; ++y) {
        for (unsigned x = 0; x < square.side; ++x) {
            if (isIn(half, square, x, y) && square.at(x, y) != first) return needsBlock;
        }
    }
    return first == Region::transparent ? -1 : first == Region::opaque ? -2 : -4;
}

template <class Block>
std::vector<uint8_t> bytesOf(const Block& block) {
    return {block.begin(), block.end()};
}

std::vector<uint8_t> blockOf(const Square& square, SquareFormat format) {
    switch (format) {
        case SquareFormat::vq2:
            return bytesOf(quadmap::encodeVq2(square, quadmap::Vq2Method::best));
        case SquareFormat::vq2Plus:
            return bytesOf(quadmap::encodeVq2Plus(square));
        case SquareFormat::vq4:
            return bytesOf(quadmap::encodeVq4(square, quadmap::Vq4Method::fast));
        default:
            return bytesOf(quadmap::encodeVq4Plus(square, quadmap::Vq4Method::fast));
    }
}

EncodedPair encode(const quadmap::SquareMaker& maker, const SquarePair& pair, SquareFormat format) {
    const unsigned side = sideOf(format);
    const Square square =
        pair.second ? maker.ofPair(pair.first, *pair.second, side) : maker.ofSingle(pair.first, side);
    EncodedPair encoded;
    encoded.special[0] = specialOf(square, Half::first);
    encoded.special[1] = pair.second ? specialOf(square, Half::second) : -4;
    const bool isNeeded = encoded.special[0] == needsBlock || encoded.special[1] == needsBlock;
    if (isNeeded) encoded.block = blockOf(square, format);
    return encoded;
}

// Gathers the blocks of all groups, equal ones once, and the triangles' indices.
class Gatherer {
  public:
    explicit Gatherer(SquareFormat format) { squares_.format = format; }

    void add(const PairedPrimitive& primitive, size_t group, const std::vector<uint32_t>& kinds,
             const std::vector<EncodedPair>& encoded) {
        const size_t triangles = primitive.primitive->triangleCount();
        Part& part = parts_.emplace_back();
        part.source = primitive.primitive;
        part.primitive = {primitive.primitive->meshIndex, primitive.primitive->primitiveIndex,
                          static_cast<uint32_t>(triangles), static_cast<uint32_t>(group)};
        part.indices.resize(triangles);
        part.places.resize(triangles);
        for (size_t k = 0; k < primitive.pairs.size(); ++k) {
            const mesh::TrianglePair& pair = primitive.pairs[k];
            place(pair.first, Half::first, encoded[kinds[k]], part);
            if (pair.second) place(*pair.second, Half::second, encoded[kinds[k]], part);
        }
    }

    SceneSquares take() && {
        std::ranges::sort(parts_, [](const Part& a, const Part& b) {
            return std::pair(a.primitive.mesh, a.primitive.primitive) <
                   std::pair(b.primitive.mesh, b.primitive.primitive);
        });
        for (const Part& part : parts_) {
            squares_.meta.primitives.push_back(part.primitive);
            squares_.primitives.push_back(part.source);
            squares_.indices.insert(squares_.indices.end(), part.indices.begin(), part.indices.end());
            squares_.places.insert(squares_.places.end(), part.places.begin(), part.places.end());
        }
        return std::move(squares_);
    }

  private:
    struct Part {
        const scene::Primitive* source = nullptr;
        io::FilPrimitive primitive;
        std::vector<int32_t> indices;
        std::vector<quadmap::SquarePlace> places;
    };

    void place(const mesh::PairedTriangle& triangle, Half half, const EncodedPair& encoded, Part& part) {
        const int32_t special = encoded.special[static_cast<size_t>(half)];
        if (special != needsBlock) {
            part.indices[triangle.triangle] = special;
            return;
        }
        part.indices[triangle.triangle] = blockNumber(encoded.block);
        part.places[triangle.triangle] = {half, quadmap::orderOf(triangle.order)};
    }

    int32_t blockNumber(const std::vector<uint8_t>& block) {
        const auto [found, isNew] = numbers_.try_emplace(block, static_cast<int32_t>(numbers_.size()));
        if (isNew) squares_.blocks.insert(squares_.blocks.end(), block.begin(), block.end());
        return found->second;
    }

    SceneSquares squares_;
    std::vector<Part> parts_;
    std::map<std::vector<uint8_t>, int32_t> numbers_;
};

}  // namespace

std::optional<SquareFormat> squareFormatNamed(std::string_view name) {
    for (const SquareFormat format :
         {SquareFormat::vq2, SquareFormat::vq2Plus, SquareFormat::vq4, SquareFormat::vq4Plus}) {
        if (nameOf(format) == name) return format;
    }
    return std::nullopt;
}

Result<SceneSquares> encodeSquares(const scene::Scene& scene, const std::vector<PairGroup>& groups,
                                   SquareFormat format, const Executor& executor, ProgressSink& progress) {
    std::vector<DistinctPairs> distinct;
    size_t count = 0;
    for (const PairGroup& group : groups) count += distinct.emplace_back(distinctPairs(group)).pairs.size();
    OneStage stage(progress, "encode", count, "maps");
    Gatherer gatherer(format);
    std::vector<io::FilGroup> named;
    for (size_t g = 0; g < groups.size(); ++g) {
        const image::AlphaTexture texture = textureOf(scene, groups[g].source);
        const image::AlphaTest test = testFor(groups[g].source, texture);
        const quadmap::SquareMaker maker(texture, test);
        std::vector<EncodedPair> encoded(distinct[g].pairs.size());
        executor.parallelFor(encoded.size(), 4, [&](size_t begin, size_t end) {
            for (size_t k = begin; k < end && !stage.cancelled(); ++k) {
                encoded[k] = encode(maker, distinct[g].pairs[k], format);
                stage.advance(1);
            }
        });
        if (stage.cancelled()) return Error{ErrorKind::cancelled, "stopped"};
        for (size_t p = 0; p < groups[g].primitives.size(); ++p)
            gatherer.add(groups[g].primitives[p], g, distinct[g].of[p], encoded);
        named.push_back({nameOf(scene, groups[g].source), test});
    }
    SceneSquares squares = std::move(gatherer).take();
    squares.meta.groups = std::move(named);
    return squares;
}

}  // namespace filigree::jobs
