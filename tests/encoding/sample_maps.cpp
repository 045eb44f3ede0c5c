#include "encoding/sample_maps.h"

#include "filigree/micromap/curve.h"

#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

namespace filigree::tests {

using encoding::Encoding;
using micromap::Format;
using micromap::Quadtree;
using micromap::State;

namespace {

SampleSet uniformMaps() {
    SampleSet set{"uniform", {}};
    for (const unsigned level : {0u, 1u, 2u, 3u, 4u, 5u, 8u}) {
        for (unsigned s = 0; s < 4; ++s) {
            const auto state = static_cast<State>(s);
            set.maps.push(oddOne(level, 0, state, state).view());
        }
    }
    return set;
}

SampleSet oddOnes() {
    SampleSet set{"odd ones", {}};
    for (const unsigned level : {0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u, 9u}) {
        const uint64_t last = micromap::microTriangleCount(level) - 1;
        for (const uint64_t index : {uint64_t{0}, last / 3, last / 2, last}) {
            set.maps.push(oddOne(level, index, State::transparent, State::opaque).view());
            set.maps.push(oddOne(level, index, State::opaque, State::unknownTransparent).view());
        }
    }
    set.maps.push(oddOne(12, 3'333'333, State::opaque, State::unknownOpaque).view());
    return set;
}

SampleSet checkerboards() {
    SampleSet set{"checkerboards", {}};
    for (unsigned level = 1; level <= 6; ++level) {
        set.maps.push(checkerboard(level, State::transparent, State::opaque).view());
        set.maps.push(checkerboard(level, State::unknownOpaque, State::opaque).view());
        set.maps.push(checkerboard(level, State::unknownTransparent, State::unknownOpaque).view());
    }
    return set;
}

SampleSet randomMaps() {
    SampleSet set{"random", {}};
    std::mt19937 random(7);
    for (unsigned round = 0; round < 3; ++round) {
        for (unsigned level = 0; level <= 6; ++level) {
            set.maps.push(noise(level, 0.0, random).view());
            set.maps.push(noise(level, 0.2, random).view());
            set.maps.push(noise(level, 0.4, random).view());
        }
    }
    return set;
}

SampleSet discs() {
    SampleSet set{"discs", {}};
    for (unsigned level = 0; level <= 6; ++level) {
        for (const double radius : {0.1, 0.5, 0.70710678, 0.9}) set.maps.push(disc(level, radius).view());
    }
    return set;
}

SampleSet deepMaps() {
    SampleSet set{"deep", {}};
    std::mt19937 random(9);
    set.maps.push(disc(9, 0.6).view());
    set.maps.push(noise(8, 0.05, random).view());
    set.maps.push(noise(8, 0.25, random).view());
    set.maps.push(disc(8, 0.3).view());
    return set;
}

}  // namespace

std::vector<micromap::QuadtreeView> SampleSet::views() const {
    std::vector<micromap::QuadtreeView> all;
    for (size_t k = 0; k < maps.size(); ++k) all.push_back(maps[k]);
    return all;
}

Quadtree oddOne(unsigned level, uint64_t index, State rest, State odd) {
    return build(level, [&](uint64_t first, unsigned height) {
        const bool holds = index - first < micromap::microTriangleCount(height) && rest != odd;
        if (holds && height > 0) return -1;
        return static_cast<int>(holds ? odd : rest);
    });
}

Quadtree checkerboard(unsigned level, State even, State odd) {
    return build(level, [&](uint64_t first, unsigned height) {
        return height > 0 ? -1 : static_cast<int>(first % 2 == 0 ? even : odd);
    });
}

Quadtree disc(unsigned level, double radius) {
    const double reach = radius * static_cast<double>(1u << level);
    return build(level, [&](uint64_t first, unsigned height) {
        if (height > 0) return -1;
        unsigned inside = 0;
        for (const auto& p : corners(micromap::latticeTriangle(static_cast<uint32_t>(first), level))) {
            inside += std::hypot(p.i, p.j) <= reach ? 1 : 0;
        }
        if (inside == 0 || inside == 3) return static_cast<int>(micromap::knownOf(inside == 3));
        return static_cast<int>(micromap::unknownOf(inside == 2));
    });
}

Quadtree noise(unsigned level, double stop, std::mt19937& random) {
    std::uniform_real_distribution<> unit(0, 1);
    return build(level, [&](uint64_t, unsigned height) {
        if (height > 0 && unit(random) >= stop) return -1;
        return static_cast<int>(random() % 4);
    });
}

std::vector<SampleSet> sampleSets() {
    std::vector<SampleSet> sets{SampleSet{"empty", {}}, uniformMaps(), oddOnes(), checkerboards(),
                                randomMaps(),           discs(),       deepMaps()};
    SampleSet mixed{"mixed", {}};
    for (const SampleSet& set : sets) {
        for (size_t k = 0; k < set.maps.size(); k += 3) mixed.maps.push(set.maps[k]);
    }
    sets.push_back(std::move(mixed));
    return sets;
}

SampleSet smallSet() {
    SampleSet set{"small", {}};
    std::mt19937 random(11);
    for (const unsigned level : {0u, 1u, 2u, 3u, 4u}) set.maps.push(noise(level, 0.3, random).view());
    set.maps.push(oddOne(6, 1234, State::opaque, State::unknownOpaque).view());
    set.maps.push(disc(4, 0.6).view());
    set.maps.push(disc(6, 0.4).view());
    set.maps.push(disc(5, 0.8).view());
    set.maps.push(oddOne(3, 0, State::opaque, State::opaque).view());
    return set;
}

std::unique_ptr<encoding::MapReader> openGood(const encoding::EncodedView& view) {
    auto reader = encoding::openReader(view);
    if (reader) return std::move(*reader);
    ADD_FAILURE() << reader.error().message;
    std::abort();
}

encoding::EncodedSet encodeGood(Encoding encoding, const SampleSet& set, Format format,
                                const Executor& executor) {
    const auto views = set.views();
    auto encoded = encoding::encode(encoding, views, format, {}, executor);
    if (encoded) return std::move(*encoded);
    ADD_FAILURE() << encoded.error().message;
    std::abort();
}

}  // namespace filigree::tests
