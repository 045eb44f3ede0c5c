// Lookups of the CPU's plain readers, replayed on the device.
#include "filigree/vulkan/lookup.h"

#include "filigree/encoding/bitmask.h"
#include "filigree/quadmap/reader.h"

#include "encoding/encoding_name.h"
#include "encoding/sample_maps.h"
#include "vulkan/test_device.h"

#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace filigree::vulkan {
namespace {

using encoding::EncodedSet;
using encoding::Encoding;
using micromap::Format;
using quadmap::SquareFormat;

// Sanitizers make the readers many times slower.
#if defined(__SANITIZE_ADDRESS__)
constexpr size_t lookupCount = 20'000;
#else
constexpr size_t lookupCount = 500'000;  // of each of two formats
#endif

struct Points {
    std::vector<uint32_t> maps;
    std::vector<float> u;
    std::vector<float> v;
    void add(uint32_t map, float atU, float atV) {
        maps.push_back(map);
        u.push_back(atU);
        v.push_back(atV);
    }
};

// A weight: anywhere, on the lattice of some level, beside it, or nonsense.
float someWeight(std::mt19937& random) {
    const float anywhere = std::uniform_real_distribution<float>(0, 1)(random);
    if (random() % 4 != 0) return anywhere;
    const auto steps = static_cast<float>(1u << (random() % 13));
    const float onLattice = std::floor(anywhere * steps) / steps;
    switch (random() % 8) {
        case 0:
            return std::nextafter(onLattice, 2.0F);
        case 1:
            return std::nextafter(onLattice, -1.0F);
        case 2:
            return 4 * anywhere - 2;
        case 3:
            return std::numeric_limits<float>::quiet_NaN();
        default:
            return onLattice;
    }
}

Points pointsIn(uint32_t mapCount, size_t count) {
    std::mt19937 random(5);
    Points points;
    for (size_t k = 0; k < count; ++k) {
        const float u = someWeight(random);
        const float v = someWeight(random);
        const bool folded = random() % 16 != 0 && u + v > 1;
        points.add(static_cast<uint32_t>(random() % mapCount), folded ? 1 - u : u, folded ? 1 - v : v);
    }
    return points;
}

template <class State, class Expected>
void expectEqual(const std::vector<State>& found, const Points& points, const Expected& expected) {
    ASSERT_EQ(found.size(), points.maps.size());
    size_t wrong = 0;
    for (size_t k = 0; k < found.size(); ++k) {
        const State right = expected(k);
        if (found[k] == right) continue;
        if (++wrong > 4) continue;
        ADD_FAILURE() << "map " << points.maps[k] << " at " << points.u[k] << ", " << points.v[k]
                      << ": device " << int(found[k]) << ", CPU " << int(right);
    }
    EXPECT_EQ(wrong, 0u) << "of " << found.size();
}

// Maps of all levels and kinds; without the deepest where a lookup reads all of a map.
tests::SampleSet mapsFor(Encoding encoding) {
    tests::SampleSet all{"all", {}};
    const unsigned deepest = encoding == Encoding::tree ? 6 : micromap::maxLevel;
    for (const tests::SampleSet& set : tests::sampleSets()) {
        for (size_t k = 0; k < set.maps.size(); ++k) {
            if (set.maps[k].level <= deepest) all.maps.push(set.maps[k]);
        }
    }
    return all;
}

class VulkanLookup : public tests::VulkanTest {};
class VulkanMapLookup : public VulkanLookup, public testing::WithParamInterface<Encoding> {};
class VulkanSquareLookup : public VulkanLookup, public testing::WithParamInterface<SquareFormat> {};

TEST_P(VulkanMapLookup, FindsWhatTheReadersFind) {
    const tests::SampleSet maps = mapsFor(GetParam());
    for (const Format format : {Format::twoState, Format::fourState}) {
        const EncodedSet set = tests::encodeGood(GetParam(), maps, format);
        const auto reader = tests::openGood(viewOf(set));
        const Points points = pointsIn(set.mapCount, lookupCount);
        const auto found = lookup(*device_, viewOf(set), points.maps, points.u, points.v);
        ASSERT_TRUE(found.ok()) << found.error().message;
        expectEqual(*found, points,
                    [&](size_t k) { return reader->at(points.maps[k], points.u[k], points.v[k]); });
    }
}

INSTANTIATE_TEST_SUITE_P(Encodings, VulkanMapLookup, testing::ValuesIn(tests::testedEncodings),
                         tests::EncodingName());

// Form 3, where a set bit reads as unknown-opaque.
TEST_F(VulkanLookup, FindsWhatMaybeOpaqueMasksSay) {
    const tests::SampleSet maps = tests::smallSet();
    const auto views = maps.views();
    const auto set =
        encoding::encode(Encoding::gruen, views, Format::twoState, {.maybeOpaque = true}, serialExecutor());
    ASSERT_TRUE(set.ok());
    const auto reader = tests::openGood(viewOf(*set));
    const Points points = pointsIn(set->mapCount, 2'000);
    const auto found = lookup(*device_, viewOf(*set), points.maps, points.u, points.v);
    ASSERT_TRUE(found.ok()) << found.error().message;
    expectEqual(*found, points,
                [&](size_t k) { return reader->at(points.maps[k], points.u[k], points.v[k]); });
}

// A texture of noise in one of the ways to store cells.
image::AlphaTexture noiseTexture(uint32_t width, uint32_t height, image::Wrap wrapU, image::Wrap wrapV,
                                 image::Filter filter, std::mt19937& random) {
    std::vector<uint8_t> texels(size_t{width} * height);
    for (uint8_t& texel : texels)
        texel = static_cast<uint8_t>(random() % 3 == 0 ? random() : 255 * (random() % 2));
    return {image::alphaImageFrom8Bit(width, height, texels), wrapU, wrapV, filter};
}

std::vector<image::AlphaTexture> noiseTextures() {
    using image::Wrap;
    std::mt19937 random(3);
    std::vector<image::AlphaTexture> textures;
    for (const Wrap wrapU : {Wrap::repeat, Wrap::mirroredRepeat, Wrap::clampToEdge}) {
        for (const Wrap wrapV : {Wrap::repeat, Wrap::mirroredRepeat, Wrap::clampToEdge}) {
            textures.push_back(noiseTexture(32, 9, wrapU, wrapV, image::Filter::linear, random));
            textures.push_back(noiseTexture(7, 64, wrapU, wrapV, image::Filter::nearest, random));
            textures.push_back(noiseTexture(1, 3, wrapU, wrapV, image::Filter::linear, random));
        }
    }
    return textures;
}

// Of every size, near the borders of cells, and nonsense.
float someCoordinate(std::mt19937& random) {
    const float anywhere = std::uniform_real_distribution<float>(-3, 4)(random);
    switch (random() % 8) {
        case 0:
            return std::floor(anywhere * 64) / 64;
        case 1:
            return std::nextafter(std::floor(anywhere * 64) / 64, anywhere);
        case 2:
            return std::ldexp(anywhere, static_cast<int>(random() % 60) - 10);
        case 3:
            return std::ldexp(anywhere, -static_cast<int>(random() % 150));
        case 4:
            return random() % 64 == 0 ? std::numeric_limits<float>::quiet_NaN() : -0.0F;
        default:
            return anywhere;
    }
}

TEST_F(VulkanLookup, FindsTheCellsOfBitmasks) {
    const auto textures = noiseTextures();
    std::vector<encoding::BitmaskSource> sources;
    for (const auto& texture : textures) sources.push_back({&texture, {}});
    std::mt19937 random(4);
    for (const Format format : {Format::twoState, Format::fourState}) {
        const auto set = encoding::encodeBitmasks(sources, format, serialExecutor());
        ASSERT_TRUE(set.ok()) << set.error().message;
        const auto reader = encoding::BitmaskReader::open(viewOf(*set));
        ASSERT_TRUE(reader.ok());
        Points points;
        for (size_t k = 0; k < lookupCount; ++k) {
            points.add(static_cast<uint32_t>(random() % set->mapCount), someCoordinate(random),
                       someCoordinate(random));
        }
        const auto found = lookup(*device_, viewOf(*set), points.maps, points.u, points.v);
        ASSERT_TRUE(found.ok()) << found.error().message;
        expectEqual(*found, points,
                    [&](size_t k) { return reader->at(points.maps[k], points.u[k], points.v[k]); });
    }
}

// All patterns of bits are maps.
TEST_P(VulkanSquareLookup, FindsWhatTheReaderFinds) {
    std::mt19937 random(6);
    std::vector<uint8_t> bytes(4096 * quadmap::blockBytesOf(GetParam()));
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random());
    const auto reader = quadmap::SquareReader::open(GetParam(), bytes);
    ASSERT_TRUE(reader.ok());
    const Points points = pointsIn(static_cast<uint32_t>(reader->mapCount()), 2 * lookupCount);
    std::vector<quadmap::Half> halves;
    for (size_t k = 0; k < points.maps.size(); ++k)
        halves.push_back(static_cast<quadmap::Half>(random() % 2));
    const auto found = lookup(*device_, *reader, points.maps, halves, points.u, points.v);
    ASSERT_TRUE(found.ok()) << found.error().message;
    expectEqual(*found, points,
                [&](size_t k) { return reader->at(points.maps[k], halves[k], points.u[k], points.v[k]); });
}

INSTANTIATE_TEST_SUITE_P(Formats, VulkanSquareLookup,
                         testing::Values(SquareFormat::vq2, SquareFormat::vq2Plus, SquareFormat::vq4,
                                         SquareFormat::vq4Plus),
                         [](const auto& test) {
                             std::string name(quadmap::nameOf(test.param));
                             if (name.back() == '+') name.replace(name.size() - 1, 1, "Plus");
                             return name;
                         });

TEST_F(VulkanLookup, RefusesWhatHasNoShader) {
    const std::vector<uint8_t> bytes(64, 0);
    const auto reader = quadmap::SquareReader::open(SquareFormat::raw16, bytes);
    const auto found = lookup(*device_, *reader, std::vector<uint32_t>{0}, std::vector{quadmap::Half::first},
                              std::vector{0.5F}, std::vector{0.5F});
    ASSERT_FALSE(found.ok());
    EXPECT_EQ(found.error().kind, ErrorKind::unsupported);
}

TEST_F(VulkanLookup, ChecksTheSet) {
    EncodedSet set = tests::encodeGood(Encoding::flat, tests::smallSet(), Format::fourState);
    set.payload.pop_back();
    const auto found = lookup(*device_, viewOf(set), {}, {}, {});
    ASSERT_FALSE(found.ok());
    EXPECT_EQ(found.error().kind, ErrorKind::format);
}

TEST_F(VulkanLookup, LeavesNothingBehind) {
    const EncodedSet set = tests::encodeGood(Encoding::gruen, tests::smallSet(), Format::fourState);
    const Points points = pointsIn(set.mapCount, 100);
    for (unsigned k = 0; k < 20; ++k) {
        ASSERT_TRUE(lookup(*device_, viewOf(set), points.maps, points.u, points.v).ok());
        ASSERT_EQ(device_->allocatedBytes(), 0u);
    }
}

}  // namespace
}  // namespace filigree::vulkan
