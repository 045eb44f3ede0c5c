// Lookups of filigree_lookup.h, as C99, C99 with portable loads and C++11 make them, against the readers.
#include "filigree/encoding/bitmask.h"
#include "filigree/micromap/curve.h"

#include "encoding/encoding_name.h"
#include "encoding/sample_maps.h"
#include "exact_bytes.h"
#include "lookup/compilers.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace filigree::tests {
namespace {

using encoding::EncodedSet;
using encoding::EncodedView;
using encoding::Encoding;
using encoding::MapReader;
using micromap::Format;

// Points of all sorts: inside, on lattice lines, on the border, outside, and no numbers.
std::vector<std::array<float, 2>> somePoints(unsigned count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0, 1);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<std::array<float, 2>> points{{0, 0}, {1, 0}, {0, 1}, {0.5F, 0.5F}, {-1, 2}, {nan, 0.25F}};
    while (points.size() < count) {
        float u = unit(random);
        float v = unit(random);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        if (random() % 2 == 0) u = std::floor(u * 64) / 64, v = std::floor(v * 64) / 64;
        points.push_back({u, v});
    }
    return points;
}

void expectMapAgrees(const lookup_functions& lookup, const filigree_view& view, const MapReader& reader,
                     uint32_t map) {
    const unsigned level = reader.level(map);
    ASSERT_EQ(lookup.view_level(&view, map), level);
    const uint64_t count = micromap::microTriangleCount(level);
    const uint64_t step = count <= 1024 ? 1 : count / 509;
    for (uint64_t index = 0; index < count; index += step) {
        const auto k = static_cast<uint32_t>(index);
        ASSERT_EQ(lookup.view_at(&view, map, k), static_cast<unsigned>(reader.at(map, k))) << map << " " << k;
    }
    for (const auto& [u, v] : somePoints(200)) {
        ASSERT_EQ(lookup.view_at_point(&view, map, u, v), static_cast<unsigned>(reader.at(map, u, v)))
            << map << " " << u << " " << v;
    }
}

class LookupHeader : public testing::TestWithParam<std::tuple<Encoding, Format>> {};

// Mixed levels and empty sets are among the samples.
TEST_P(LookupHeader, findsWhatTheReaderFinds) {
    const auto [encoding, format] = GetParam();
    for (const SampleSet& sample : sampleSets()) {
        const EncodedSet set = encodeGood(encoding, sample, format);
        const ExactBytes descriptors(set.descriptors);
        const ExactBytes payload(set.payload);
        const EncodedView view{encoding, format, set.mapCount, descriptors.view(), payload.view()};
        const auto reader = openGood(view);
        ASSERT_NE(reader, nullptr);
        for (const lookup_functions* lookup : lookupCompilers()) {
            SCOPED_TRACE(sample.name + ", " + lookup->compiler);
            filigree_view plain;
            ASSERT_EQ(openView(*lookup, plain, view), FILIGREE_LOOKUP_OK);
            for (uint32_t map = 0; map < set.mapCount; map += 1 + set.mapCount / 24)
                ASSERT_NO_FATAL_FAILURE(expectMapAgrees(*lookup, plain, *reader, map));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(AllEncodings, LookupHeader,
                         testing::Combine(testing::ValuesIn(testedEncodings),
                                          testing::Values(Format::twoState, Format::fourState)),
                         EncodingName());

TEST(LookupHeader, readsMaybeOpaqueMasks) {
    encoding::EncodeOptions options;
    options.maybeOpaque = true;
    const SampleSet sample = smallSet();
    const auto set = encoding::encode(Encoding::gruen, sample.views(), Format::twoState, options);
    ASSERT_TRUE(set.ok());
    const auto reader = openGood(encoding::viewOf(*set));
    for (const lookup_functions* lookup : lookupCompilers()) {
        filigree_view plain;
        ASSERT_EQ(openView(*lookup, plain, encoding::viewOf(*set)), FILIGREE_LOOKUP_OK);
        for (uint32_t map = 0; map < set->mapCount; ++map) expectMapAgrees(*lookup, plain, *reader, map);
    }
}

TEST(LookupHeader, hasTheCurveOfTheLibrary) {
    for (const lookup_functions* lookup : lookupCompilers()) {
        for (unsigned level = 0; level <= 15; ++level) {
            for (const auto& [u, v] : somePoints(500)) {
                ASSERT_EQ(lookup->curve_index_at(u, v, level), micromap::barycentricsToIndex(u, v, level));
            }
        }
    }
}

TEST(LookupHeader, readsBitmasks) {
    std::mt19937 random(3);
    std::vector<uint8_t> texels(size_t{21} * 13);
    for (uint8_t& texel : texels) texel = random() % 3 == 0 ? 255 : 0;
    std::vector<image::AlphaTexture> textures;
    for (const auto wrap : {image::Wrap::repeat, image::Wrap::mirroredRepeat, image::Wrap::clampToEdge}) {
        for (const auto filter : {image::Filter::linear, image::Filter::nearest}) {
            textures.push_back(
                {image::alphaImageFrom8Bit(21, 13, texels), wrap, image::Wrap::repeat, filter});
        }
    }
    std::vector<encoding::BitmaskSource> sources;
    for (const auto& texture : textures) sources.push_back({&texture, {}});
    for (const Format format : {Format::twoState, Format::fourState}) {
        const auto set = encoding::encodeBitmasks(sources, format, serialExecutor());
        ASSERT_TRUE(set.ok());
        const auto reader = encoding::BitmaskReader::open(encoding::viewOf(*set));
        ASSERT_TRUE(reader.ok());
        for (const lookup_functions* lookup : lookupCompilers()) {
            filigree_view plain;
            ASSERT_EQ(openView(*lookup, plain, encoding::viewOf(*set)), FILIGREE_LOOKUP_OK);
            for (auto [u, v] : somePoints(400)) {
                for (uint32_t texture = 0; texture < set->mapCount; ++texture, u = 5 * u - 2) {
                    ASSERT_EQ(lookup->view_at_point(&plain, texture, u, v),
                              static_cast<unsigned>(reader->at(texture, u, v)))
                        << texture << " " << u << " " << v;
                }
            }
        }
    }
}

// Reading a bit leaves three more subtrees to skip where it is 1 and one fewer where it is 0.
TEST(LookupHeader, skipsSubtrees) {
    for (unsigned byte = 0; byte < 256; ++byte) {
        const uint64_t entry = filigree_skip_table_[byte];
        for (unsigned skip = 1; skip <= 8; ++skip) {
            unsigned left = skip;
            unsigned bit = 0;
            for (; bit < 8 && left > 0; ++bit) left += (byte >> bit & 1U) != 0 ? 3 : -1;
            ASSERT_EQ(filigree_skip_length_(entry, skip), left == 0 ? bit : 0) << byte << " " << skip;
            if (left > 0) {
                ASSERT_EQ(skip + static_cast<uint32_t>(entry >> 40) - 8, left) << byte;
            }
        }
    }
}

TEST(LookupHeader, spreadsBits) {
    for (uint32_t bits = 0; bits < 65536; ++bits) {
        uint32_t expected = 0;
        for (unsigned k = 0; k < 16; ++k) expected |= (bits >> k & 1) << (2 * k);
        ASSERT_EQ(filigree_spread_(bits), expected);
        ASSERT_EQ(filigree_gather_(expected | ~0x55555555U), bits);
    }
}

}  // namespace
}  // namespace filigree::tests
