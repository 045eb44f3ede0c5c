// What the baker's tests share: bake in one call, and compare with the independent judge.
#pragma once

#include "filigree/bake/bake.h"
#include "filigree/micromap/set.h"
#include "filigree/verify/verify.h"

#include "verify/scenes.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace filigree::bake::tests {

using micromap::State;
using verify::tests::blendTest;
using verify::tests::maskTest;
using verify::tests::Random;
using verify::tests::texture16;
using verify::tests::texture8;
using verify::tests::triangleInTexels;
using verify::tests::triangleOf;

inline Settings atLevel(unsigned level) {
    Settings settings;
    settings.level = level;
    return settings;
}

inline Baked bakeAll(std::span<const mesh::UvTriangle> triangles, const image::AlphaTexture& texture,
                     const image::AlphaTest& test, const Settings& settings,
                     const Executor& executor = serialExecutor()) {
    auto baked = bake(triangles, texture, test, settings, executor, silentProgress());
    if (!baked) {
        ADD_FAILURE() << baked.error().message;
        return {};
    }
    return std::move(*baked);
}

// The states of one triangle in curve order.
inline std::vector<State> statesOf(const Baked& baked, size_t triangle) {
    const int32_t index = baked.set.indices[triangle];
    const uint64_t count = micromap::microTriangleCount(baked.levels[triangle]);
    if (micromap::isSpecialIndex(index)) return std::vector(count, micromap::stateOfSpecialIndex(index));
    std::vector<State> states(count);
    micromap::forEachLeaf(
        baked.set.trees[static_cast<size_t>(index)], [&](uint64_t first, unsigned depth, State state) {
            const uint64_t end = first + micromap::microTriangleCount(baked.levels[triangle] - depth);
            for (uint64_t k = first; k < end; ++k) states[k] = state;
        });
    return states;
}

inline std::vector<State> bakeOne(const mesh::UvTriangle& triangle, const image::AlphaTexture& texture,
                                  const image::AlphaTest& test, unsigned level) {
    return statesOf(bakeAll({&triangle, 1}, texture, test, atLevel(level)), 0);
}

// What the judge says of a bake.
inline verify::DeepCounts judged(const Baked& baked, std::span<const mesh::UvTriangle> triangles,
                                 const image::AlphaTexture& texture, const image::AlphaTest& test) {
    const auto flat = micromap::flatten(baked.set);
    EXPECT_TRUE(flat.ok());
    verify::DeepSettings settings;
    settings.specialFormat = baked.set.format;
    auto counts =
        verify::deepCheck(triangles, *flat, texture, test, settings, serialExecutor(), silentProgress());
    EXPECT_TRUE(counts.ok());
    return counts.ok() ? *counts : verify::DeepCounts{};
}

// One line for a failed comparison.
inline std::string describe(const verify::DeepCounts& counts, std::span<const mesh::UvTriangle> triangles) {
    std::string text;
    for (const verify::Finding& f : counts.first) {
        const mesh::UvTriangle& t = triangles[f.triangle];
        char line[400];
        std::snprintf(line, sizeof line, "micro %llu of level %u is %d, truth %d; uv",
                      static_cast<unsigned long long>(f.microTriangle), f.level, static_cast<int>(f.state),
                      static_cast<int>(f.truth));
        text += line;
        for (size_t k = 0; k < 3; ++k) {
            std::snprintf(line, sizeof line, " (%a, %a; %a)", double{t.uv[k].u}, double{t.uv[k].v},
                          double{t.alpha[k]});
            text += line;
        }
        text += "\n";
    }
    return text;
}

inline std::string describe(const image::AlphaTexture& t, const image::AlphaTest& test) {
    char line[300];
    std::snprintf(line, sizeof line,
                  "%u x %u texels, wrap %d %d, filter %d, mode %d, cutoff %a, factor %a, mips %u, guard %a\n",
                  t.image.width, t.image.height, static_cast<int>(t.wrapU), static_cast<int>(t.wrapV),
                  static_cast<int>(t.filter), static_cast<int>(test.mode), test.cutoff, test.factor,
                  test.mips, test.guard);
    return line;
}

}  // namespace filigree::bake::tests
