#include "filigree/encoding/bitmask.h"

#include "filigree/core/target.h"

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace filigree::encoding {
namespace {

using image::AlphaMode;
using image::AlphaTest;
using image::AlphaTexture;
using image::Filter;
using image::Wrap;
using micromap::Format;
using micromap::State;

constexpr std::array wraps{Wrap::repeat, Wrap::mirroredRepeat, Wrap::clampToEdge};
constexpr std::array filters{Filter::linear, Filter::nearest, Filter::both};

// Blotches of 0, 255 and values between.
AlphaTexture blotches(uint32_t width, uint32_t height, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<uint8_t> texels(size_t{width} * height);
    for (size_t k = 0; k < texels.size(); ++k) {
        const unsigned kind = random() % 8;
        texels[k] = static_cast<uint8_t>(kind < 3 && k > 0 ? texels[k - 1]
                                         : kind < 5        ? 255
                                         : kind < 6        ? 0
                                                           : random());
    }
    return {image::alphaImageFrom8Bit(width, height, texels), Wrap::repeat, Wrap::repeat, Filter::linear};
}

EncodedSet encodeGood(std::span<const BitmaskSource> sources, Format format,
                      const Executor& executor = serialExecutor()) {
    auto set = encodeBitmasks(sources, format, executor);
    EXPECT_TRUE(set.ok()) << set.error().message;
    return set.ok() ? std::move(*set) : EncodedSet{};
}

BitmaskReader openGood(const EncodedSet& set) {
    auto reader = BitmaskReader::open(viewOf(set));
    EXPECT_TRUE(reader.ok()) << reader.error().message;
    return *reader;
}

// What a shader may see at (u, v): the least and greatest filtered alpha over filters and mip levels.
struct Seen {
    double least = 1;
    double most = 0;
    void add(double alpha) {
        least = std::min(least, alpha);
        most = std::max(most, alpha);
    }
};

Seen seenAt(const std::vector<AlphaTexture>& chain, float u, float v) {
    Seen seen;
    for (const AlphaTexture& level : chain) {
        const double x = double{u} * level.image.width;
        const double y = double{v} * level.image.height;
        if (level.filter != Filter::nearest) seen.add(sampleBilinear(level, x, y));
        if (level.filter != Filter::linear) seen.add(sampleNearest(level, x, y));
    }
    return seen;
}

std::vector<AlphaTexture> chainOf(const AlphaTexture& texture, unsigned mips) {
    std::vector<AlphaTexture> chain{texture};
    for (unsigned k = 0; k < mips; ++k) {
        chain.push_back(texture);
        chain.back().image = halve(chain[k].image);
    }
    return chain;
}

// Points all over three periods, many of them on borders of cells.
std::vector<std::array<float, 2>> pointsOver(const AlphaTexture& texture, unsigned count) {
    std::mt19937 random(17);
    std::uniform_real_distribution<float> unit(-1.5f, 2.5f);
    const auto coordinate = [&](uint32_t size) {
        const float any = unit(random);
        const float grid = std::round(any * 4 * static_cast<float>(size)) / (4 * static_cast<float>(size));
        return random() % 3 == 0 ? grid : any;
    };
    std::vector<std::array<float, 2>> points;
    for (unsigned k = 0; k < count; ++k) {
        const float u = coordinate(texture.image.width);
        points.push_back({u, coordinate(texture.image.height)});
    }
    return points;
}

void expectNoKnownStateIsWrong(const AlphaTexture& texture, const AlphaTest& test) {
    const std::array sources{BitmaskSource{&texture, test}};
    const EncodedSet set = encodeGood(sources, Format::fourState);
    const BitmaskReader reader = openGood(set);
    const auto chain = chainOf(texture, test.mips);
    const double opaqueFrom = test.mode == AlphaMode::mask ? test.cutoff : 1;
    const double transparentBelow = test.mode == AlphaMode::mask ? test.cutoff : 1e-12;
    for (const auto& [u, v] : pointsOver(texture, 1500)) {
        const State state = reader.at(0, u, v);
        const Seen seen = seenAt(chain, u, v);
        if (state == State::opaque) {
            ASSERT_GE(seen.least * test.factor, opaqueFrom - 1e-9) << u << " " << v;
        }
        if (state == State::transparent) {
            ASSERT_LT(seen.most * test.factor, transparentBelow + 1e-9) << u << " " << v;
        }
    }
}

TEST(Bitmask, NoKnownStateIsWrong) {
    for (const auto& [width, height] : {std::array{16u, 8u}, std::array{7u, 5u}, std::array{1u, 9u}}) {
        AlphaTexture texture = blotches(width, height, width);
        for (const Wrap wrapU : wraps) {
            for (const Wrap wrapV : wraps) {
                for (const Filter filter : filters) {
                    texture.wrapU = wrapU;
                    texture.wrapV = wrapV;
                    texture.filter = filter;
                    SCOPED_TRACE(testing::Message()
                                 << width << " " << int(wrapU) << int(wrapV) << int(filter));
                    for (const double guard : {0.0, 1.0 / 256, 0.3, 1.7}) {
                        expectNoKnownStateIsWrong(texture, {AlphaMode::mask, 0.5, 1, 0, guard});
                        expectNoKnownStateIsWrong(texture, {AlphaMode::mask, 0.3, 0.8, 2, guard});
                        expectNoKnownStateIsWrong(texture, {AlphaMode::blend, 0, 1, 1, guard});
                        if (HasFailure()) return;
                    }
                }
            }
        }
    }
}

// Over a cell without guard the extremes are its four texels.
TEST(Bitmask, KnowsAllThatCanBeKnown) {
    AlphaTexture texture = blotches(24, 16, 3);
    for (const Wrap wrap : wraps) {
        texture.wrapU = texture.wrapV = wrap;
        const std::array sources{BitmaskSource{&texture, {AlphaMode::mask, 0.5, 1, 0, 0}}};
        const EncodedSet set = encodeGood(sources, Format::fourState);
        const EncodedSet sides = encodeGood(sources, Format::twoState);
        const BitmaskReader reader = openGood(set);
        for (int y = -20; y < 40; ++y) {
            for (int x = -30; x < 60; ++x) {
                unsigned opaque = 0;
                unsigned sum = 0;
                for (const auto& [dx, dy] :
                     {std::array{0, 0}, std::array{1, 0}, std::array{0, 1}, std::array{1, 1}}) {
                    const unsigned texel = texture.image.at(image::wrapTexel(x + dx, 24, wrap),
                                                            image::wrapTexel(y + dy, 16, wrap));
                    opaque += 2 * texel >= 65535 ? 1 : 0;
                    sum += texel;
                }
                const bool side = sum >= 2 * 65535;
                const State expected =
                    opaque == 0 || opaque == 4 ? micromap::knownOf(side) : micromap::unknownOf(side);
                const float u = (static_cast<float>(x) + 1) / 24;
                const float v = (static_cast<float>(y) + 1) / 16;
                ASSERT_EQ(reader.at(0, u, v), expected) << x << " " << y;
                ASSERT_EQ(openGood(sides).at(0, u, v), micromap::knownOf(side)) << x << " " << y;
            }
        }
    }
}

TEST(Bitmask, GuardWidensCells) {
    // Texel 4 of 8 is transparent: without a guard the cells beside it know nothing, the next ones do.
    std::vector<uint8_t> texels(8, 255);
    texels[4] = 0;
    AlphaTexture texture{image::alphaImageFrom8Bit(8, 1, texels), Wrap::clampToEdge, Wrap::clampToEdge,
                         Filter::linear};
    const auto statesWith = [&](double guard) {
        const std::array sources{BitmaskSource{&texture, {AlphaMode::mask, 0.5, 1, 0, guard}}};
        const EncodedSet set = encodeGood(sources, Format::fourState);
        std::string states;
        for (unsigned k = 0; k < 8; ++k) {
            states += micromap::isKnown(openGood(set).at(0, static_cast<float>(k) / 8, 0.5f)) ? 'k' : '-';
        }
        return states;
    };
    EXPECT_EQ(statesWith(0), "kkkk--kk");
    EXPECT_EQ(statesWith(0.49), "kkkk--kk");
    EXPECT_EQ(statesWith(0.51), "kkk----k");
    texture.filter = Filter::nearest;
    EXPECT_EQ(statesWith(0), "kkkkkkkk");
    EXPECT_EQ(statesWith(0.01), "kkk---kk");
    texture.filter = Filter::both;
    EXPECT_EQ(statesWith(0), "kkkk--kk");
}

struct Fixture {
    std::vector<AlphaTexture> textures;
    std::vector<BitmaskSource> sources;
    Fixture() {
        for (unsigned k = 0; k < 9; ++k) {
            textures.push_back(blotches(3 + 2 * k, 4 + k, k));
            textures.back().wrapU = wraps[k % 3];
            textures.back().wrapV = wraps[k / 3];
            textures.back().filter = filters[(k + k / 3) % 3];
        }
        for (const AlphaTexture& texture : textures) sources.push_back({&texture, {}});
    }
};

TEST(Bitmask, BatchesFindTheSameOnEveryTarget) {
    const Fixture fixture;
    std::vector<uint32_t> textures;
    std::vector<float> u, v;
    for (size_t k = 0; k < fixture.sources.size(); ++k) {
        for (const auto& point : pointsOver(fixture.textures[k], 200)) {
            textures.push_back(static_cast<uint32_t>(k));
            u.push_back(point[0]);
            v.push_back(point[1]);
        }
    }
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const std::array far{1e6f,   -123456.7f, 1e10f,     -1e11f,        3e11f,  1e20f,
                         -1e30f, infinity,   -infinity, std::nanf(""), 1e-30f, -1e-30f};
    for (size_t k = 0; k < 3 * far.size(); ++k) {
        textures.push_back(static_cast<uint32_t>(k % 9));
        u.push_back(far[k % far.size()]);
        v.push_back(k < far.size() ? 0.3f : far[(k / 2) % far.size()]);
    }
    for (const Format format : {Format::twoState, Format::fourState}) {
        const EncodedSet set = encodeGood(fixture.sources, format);
        const BitmaskReader reader = openGood(set);
        for (const char* target : {"scalar", "sse4", "avx2", "avx3"}) {
            if (!forceTarget(target)) continue;
            std::vector<State> states(textures.size());
            reader.lookup(textures, u, v, states);
            for (size_t k = 0; k < states.size(); ++k) {
                ASSERT_EQ(states[k], reader.at(textures[k], u[k], v[k]))
                    << target << " " << u[k] << " " << v[k];
            }
        }
    }
    ASSERT_TRUE(forceTarget("best"));
    ASSERT_TRUE(forceTargetFromEnvironment());
}

TEST(Bitmask, ThreadsDoNotChangeABit) {
    const Fixture fixture;
    const auto two = makeThreadedExecutor(2);
    for (const Format format : {Format::twoState, Format::fourState}) {
        const EncodedSet once = encodeGood(fixture.sources, format);
        const EncodedSet again = encodeGood(fixture.sources, format, *two);
        EXPECT_EQ(once.payload, again.payload);
        EXPECT_EQ(once.descriptors, again.descriptors);
    }
}

TEST(Bitmask, PartsAddUp) {
    const Fixture fixture;
    for (const Format format : {Format::twoState, Format::fourState}) {
        const EncodedSet set = encodeGood(fixture.sources, format);
        uint64_t bits = 0;
        for (const Part& part : openGood(set).parts()) bits += part.bits;
        EXPECT_EQ(bits, 8 * (set.payload.size() + set.descriptors.size()));
    }
    EXPECT_TRUE(BitmaskReader::open(viewOf(encodeGood({}, Format::twoState))).ok());
}

// Opens copies in memory of their own and looks all over them; true when they were refused.
bool refused(const EncodedView& set) {
    auto descriptors = std::make_unique<uint8_t[]>(set.descriptors.size());
    auto payload = std::make_unique<uint8_t[]>(set.payload.size());
    std::ranges::copy(set.descriptors, descriptors.get());
    std::ranges::copy(set.payload, payload.get());
    EncodedView copy = set;
    copy.descriptors = {descriptors.get(), set.descriptors.size()};
    copy.payload = {payload.get(), set.payload.size()};
    const auto reader = BitmaskReader::open(copy);
    if (!reader) return true;
    std::vector<uint32_t> textures;
    std::vector<float> u, v;
    for (uint32_t k = 0; k < std::min(reader->textureCount(), 20u); ++k) {
        for (const float a : {-2.5f, -0.01f, 0.0f, 0.5f, 0.999f, 1.0f, 1.7f, 1e9f}) {
            textures.push_back(k);
            u.push_back(a);
            v.push_back(1 - a);
        }
    }
    std::vector<State> states(textures.size());
    reader->lookup(textures, u, v, states);
    for (size_t k = 0; k < states.size(); ++k) EXPECT_EQ(states[k], reader->at(textures[k], u[k], v[k]));
    return false;
}

TEST(Bitmask, BadInputIsRefusedOrStaysInside) {
    ASSERT_TRUE(forceTarget("scalar"));
    const Fixture fixture;
    for (const Format format : {Format::twoState, Format::fourState}) {
        EncodedSet set = encodeGood(fixture.sources, format);
        EXPECT_FALSE(refused(viewOf(set)));
        for (size_t size = 0; size < set.descriptors.size(); ++size) {
            EncodedView cut = viewOf(set);
            cut.descriptors = cut.descriptors.first(size);
            EXPECT_TRUE(refused(cut));
        }
        for (size_t size = 0; size < set.payload.size(); ++size) {
            EncodedView cut = viewOf(set);
            cut.payload = cut.payload.first(size);
            EXPECT_TRUE(refused(cut));
        }
        for (std::vector<uint8_t>* block : {&set.descriptors, &set.payload}) {
            block->push_back(0);
            EXPECT_TRUE(refused(viewOf(set)));
            block->pop_back();
            for (size_t bit = 0; bit < 8 * block->size(); ++bit) {
                const auto mask = static_cast<uint8_t>(1u << (bit % 8));
                (*block)[bit / 8] ^= mask;
                static_cast<void>(refused(viewOf(set)));
                (*block)[bit / 8] ^= mask;
                ASSERT_FALSE(HasFailure());
            }
        }
        for (const uint32_t count : {0u, 8u, 10u, 1u << 30, 0xffffffffu}) {
            EncodedView wrong = viewOf(set);
            wrong.mapCount = count;
            EXPECT_TRUE(refused(wrong));
        }
    }
    ASSERT_TRUE(forceTarget("best"));
    ASSERT_TRUE(forceTargetFromEnvironment());
}

TEST(Bitmask, RefusesTestsOutOfRange) {
    const AlphaTexture texture = blotches(4, 4, 1);
    for (const AlphaTest& test :
         {AlphaTest{AlphaMode::mask, 0.5, 1, 0, 9}, AlphaTest{AlphaMode::mask, -1, 1, 0, 0},
          AlphaTest{AlphaMode::mask, 0.5, std::nan(""), 0, 0}}) {
        const std::array sources{BitmaskSource{&texture, test}};
        const auto set = encodeBitmasks(sources, Format::fourState, serialExecutor());
        ASSERT_FALSE(set.ok());
        EXPECT_EQ(set.error().kind, ErrorKind::usage);
    }
}

}  // namespace
}  // namespace filigree::encoding
