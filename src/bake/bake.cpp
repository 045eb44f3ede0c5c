#include "filigree/bake/bake.h"

#include "bake/classify.h"
#include "bake/distinct.h"
#include "bake/share.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace filigree::bake {
namespace {

constexpr size_t chunkTriangles = 64;  // one unit of parallel work

Status checkSettings(std::span<const mesh::UvTriangle> triangles, const image::AlphaTest& test,
                     const Settings& settings) {
    const auto outOfRange = [](std::string_view what, double value, std::string_view range) {
        return Error{ErrorKind::usage, fmt::format("{} {}: expected {}", what, value, range)};
    };
    if (settings.level.value_or(0) > micromap::maxLevel)
        return outOfRange("level", *settings.level, "0 to 12");
    if (settings.maxLevel > micromap::maxLevel)
        return outOfRange("maximum level", settings.maxLevel, "0 to 12");
    if (!(test.cutoff >= 0)) return outOfRange("cutoff", test.cutoff, "at least 0");
    if (!(test.factor >= 0 && test.factor <= 1)) return outOfRange("alpha factor", test.factor, "0 to 1");
    if (!(test.guard >= 0 && test.guard <= 1024)) return outOfRange("guard", test.guard, "0 to 1024 texels");
    if (!settings.levels.empty() && settings.levels.size() != triangles.size()) {
        return Error{ErrorKind::usage,
                     fmt::format("{} levels for {} triangles", settings.levels.size(), triangles.size())};
    }
    for (const uint8_t level : settings.levels) {
        if (level > micromap::maxLevel) return outOfRange("level", level, "0 to 12");
    }
    return {};
}

std::vector<uint8_t> chooseLevels(std::span<const mesh::UvTriangle> triangles,
                                  const image::AlphaTexture& texture, const Settings& settings) {
    if (!settings.levels.empty()) return {settings.levels.begin(), settings.levels.end()};
    std::vector<uint8_t> levels(triangles.size());
    for (size_t t = 0; t < triangles.size(); ++t) {
        const unsigned level = settings.level.value_or(
            usefulLevel(triangles[t], texture.image.width, texture.image.height, settings.maxLevel));
        levels[t] = static_cast<uint8_t>(level);
    }
    return levels;
}

// The fields of all constant vertex alphas that occur.
class Fields {
  public:
    Fields(const image::AlphaTexture& texture, const image::AlphaTest& test)
        : chain_(texture, test.mips), test_(test) {}

    void prepare(float vertexAlpha) {
        if (!fields_.contains(vertexAlpha))
            fields_.try_emplace(vertexAlpha, chain_.levels(), test_, vertexAlpha);
    }
    [[nodiscard]] const Field& of(float vertexAlpha) const { return fields_.at(vertexAlpha); }

  private:
    MipChain chain_;
    image::AlphaTest test_;
    std::map<float, Field> fields_;
};

// What a chunk of distinct triangles came to.
struct Chunk {
    micromap::QuadtreeList trees;
};

}  // namespace

unsigned usefulLevel(const mesh::UvTriangle& triangle, uint32_t width, uint32_t height, unsigned maxLevel) {
    double longest = 0;
    for (size_t k = 0; k < 3; ++k) {
        const mesh::Uv& p = triangle.uv[k];
        const mesh::Uv& q = triangle.uv[(k + 1) % 3];
        const double edge = std::hypot((double{q.u} - p.u) * width, (double{q.v} - p.v) * height);
        if (!std::isfinite(edge)) return 0;
        longest = std::max(longest, edge);
    }
    unsigned level = 0;
    while (level < maxLevel && longest > static_cast<double>(1u << level)) ++level;
    return level;
}

Result<Baked> bake(std::span<const mesh::UvTriangle> triangles, const image::AlphaTexture& texture,
                   const image::AlphaTest& test, const Settings& settings, const Executor& executor,
                   ProgressSink& progress) {
    if (Status status = checkSettings(triangles, test, settings); !status) return status.error();
    Baked baked;
    baked.levels = chooseLevels(triangles, texture, settings);
    const DistinctTriangles distinct = findDistinct(triangles, baked.levels);
    Fields fields(texture, test);
    for (const uint32_t t : distinct.representative) fields.prepare(triangles[t].alpha[0]);

    const size_t count = distinct.representative.size();
    std::vector<Chunk> chunks((count + chunkTriangles - 1) / chunkTriangles);
    progress.begin("bake", count, "triangles");
    executor.parallelFor(chunks.size(), 1, [&](size_t begin, size_t end) {
        BitWriter stream;
        for (size_t c = begin; c < end && !progress.cancelled(); ++c) {
            const size_t first = c * chunkTriangles;
            const size_t last = std::min(count, first + chunkTriangles);
            for (size_t d = first; d < last; ++d) {
                const uint32_t t = distinct.representative[d];
                stream.clear();
                if (isPlaceable(triangles[t], texture.image.width, texture.image.height)) {
                    classify(triangles[t], fields.of(triangles[t].alpha[0]), baked.levels[t],
                             settings.format == micromap::Format::twoState, executor, stream);
                } else {
                    stream.append(baked.levels[t] > 0 ? 6 : 3, baked.levels[t] > 0 ? 3 : 2);
                }
                chunks[c].trees.push({stream.words(), stream.size(), baked.levels[t]});
            }
            progress.advance(last - first);
        }
    });
    progress.end();
    if (progress.cancelled()) return Error{ErrorKind::cancelled, "the bake was cancelled"};

    Sharer sharer;
    std::vector<int32_t> index(count);
    for (size_t d = 0; d < count; ++d) {
        index[d] = sharer.add(chunks[d / chunkTriangles].trees[d % chunkTriangles]);
    }
    baked.set.format = settings.format;
    baked.set.trees = std::move(sharer).take();
    baked.set.indices.resize(triangles.size());
    for (size_t t = 0; t < triangles.size(); ++t) baked.set.indices[t] = index[distinct.number[t]];
    baked.statistics.triangles = triangles.size();
    baked.statistics.distinctTriangles = count;
    return baked;
}

}  // namespace filigree::bake
