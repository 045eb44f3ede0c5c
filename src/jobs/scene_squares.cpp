#include "jobs/scene_squares.h"

#include "jobs/one_stage.h"

#include <algorithm>

namespace filigree::jobs {
namespace {

using quadmap::EncodedPair;
using quadmap::SquareFormat;

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
        for (size_t k = 0; k < primitive.pairs.size(); ++k)
            blocks_.add(primitive.pairs[k], encoded[kinds[k]], part.indices, part.places);
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
        squares_.blocks = std::move(blocks_).take();
        return std::move(squares_);
    }

  private:
    struct Part {
        const scene::Primitive* source = nullptr;
        io::FilPrimitive primitive;
        std::vector<int32_t> indices;
        std::vector<quadmap::SquarePlace> places;
    };

    SceneSquares squares_;
    std::vector<Part> parts_;
    quadmap::BlockList blocks_;
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
                encoded[k] = quadmap::encodePair(maker, distinct[g].pairs[k], format);
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
