#include "filigree/bake/bake.h"

#include "bake/distinct.h"
#include "bake/fields.h"
#include "bake/share.h"

#include <algorithm>
#include <cmath>

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

// What a chunk of distinct triangles came to.
struct Chunk {
    micromap::QuadtreeList trees;
    std::vector<uint64_t> hashes;
    std::vector<micromap::StateCounts> states;
};

// One bake's work, stage by stage.
class Bake {
  public:
    Bake(std::span<const mesh::UvTriangle> triangles, const image::AlphaTexture& texture,
         const image::AlphaTest& test, const Settings& settings)
        : triangles_(triangles),
          settings_(settings),
          levels_(chooseLevels(triangles, texture, settings)),
          distinct_(findDistinct(triangles, levels_)),
          fields_(texture, test, triangles) {}

    Status classify(const Executor& executor, ProgressSink& progress) {
        const size_t count = distinct_.representative.size();
        chunks_.resize((count + chunkTriangles - 1) / chunkTriangles);
        progress.begin("bake", count, "triangles");
        executor.parallelFor(chunks_.size(), 1, [&](size_t begin, size_t end) {
            Classified scratch;
            for (size_t c = begin; c < end && !progress.cancelled(); ++c) {
                const size_t first = c * chunkTriangles;
                const size_t last = std::min(count, first + chunkTriangles);
                for (size_t d = first; d < last; ++d) classifyOne(d, executor, scratch, chunks_[c]);
                progress.advance(last - first);
            }
        });
        progress.end();
        if (progress.cancelled()) return Error{ErrorKind::cancelled, "the bake was cancelled"};
        return {};
    }

    Baked share() && {
        Sharer sharer(settings_.rotate);
        std::vector<Shared> shared(distinct_.representative.size());
        for (size_t d = 0; d < shared.size(); ++d) {
            const Chunk& chunk = chunks_[d / chunkTriangles];
            shared[d] = sharer.add(chunk.trees[d % chunkTriangles], chunk.hashes[d % chunkTriangles]);
        }
        Baked baked;
        baked.set.format = settings_.format;
        baked.set.trees = std::move(sharer).take();
        baked.set.indices.resize(triangles_.size());
        if (settings_.rotate) baked.rotations.resize(triangles_.size());
        for (size_t t = 0; t < triangles_.size(); ++t) {
            const Shared& found = shared[distinct_.number[t]];
            baked.set.indices[t] = found.index;
            if (settings_.rotate) baked.rotations[t] = found.rotation;
        }
        baked.statistics = statistics();
        baked.levels = std::move(levels_);
        return baked;
    }

  private:
    void classifyOne(size_t d, const Executor& executor, Classified& scratch, Chunk& chunk) const {
        const uint32_t t = distinct_.representative[d];
        scratch.clear();
        fields_.classify(triangles_[t], levels_[t], settings_.format == micromap::Format::twoState, executor,
                         scratch);
        const micromap::QuadtreeView tree{scratch.stream.words(), scratch.stream.size(), levels_[t]};
        chunk.trees.push(tree);
        chunk.hashes.push_back(micromap::hash(tree));
        chunk.states.push_back(scratch.states);
    }

    [[nodiscard]] Statistics statistics() const {
        Statistics statistics;
        statistics.triangles = triangles_.size();
        statistics.distinctTriangles = distinct_.representative.size();
        for (size_t t = 0; t < triangles_.size(); ++t) {
            const uint32_t d = distinct_.number[t];
            const micromap::StateCounts& states = chunks_[d / chunkTriangles].states[d % chunkTriangles];
            statistics.states.add(states);
            statistics.microTriangles += states.total();
            ++statistics.trianglesAt[levels_[t]];
            if (!fields_.canPlace(triangles_[t])) ++statistics.nonFiniteTriangles;
        }
        return statistics;
    }

    std::span<const mesh::UvTriangle> triangles_;
    const Settings& settings_;
    std::vector<uint8_t> levels_;
    DistinctTriangles distinct_;
    Fields fields_;
    std::vector<Chunk> chunks_;
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
    if (Status status = image::check(texture.image); !status) return status.error();
    if (Status status = checkSettings(triangles, test, settings); !status) return status.error();
    Bake work(triangles, texture, test, settings);
    if (Status status = work.classify(executor, progress); !status) return status.error();
    return std::move(work).share();
}

}  // namespace filigree::bake
