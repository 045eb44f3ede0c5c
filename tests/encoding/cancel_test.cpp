// Encoders show where they are, and stop when they are told to.
#include "filigree/encoding/bitmask.h"

#include "encoding/encoding_name.h"
#include "encoding/sample_maps.h"

#include <gtest/gtest.h>

namespace filigree::encoding {
namespace {

using micromap::Format;

class Cancel : public testing::TestWithParam<Encoding> {};

TEST_P(Cancel, CountsAllMaps) {
    const tests::SampleSet set = tests::smallSet();
    uint64_t done = 0;
    FunctionProgress progress([&](const ProgressReport& report) {
        EXPECT_EQ(report.stage, "encode");
        done = report.done;
    });
    ASSERT_TRUE(encode(GetParam(), set.views(), Format::fourState, {}, serialExecutor(), progress));
    EXPECT_EQ(done, set.maps.size());
}

TEST_P(Cancel, StopsBetweenMaps) {
    const tests::SampleSet set = tests::smallSet();
    const std::vector<micromap::QuadtreeView> one = set.views();
    std::vector<micromap::QuadtreeView> maps;
    while (maps.size() < 1000) maps.insert(maps.end(), one.begin(), one.end());
    const auto executor = makeThreadedExecutor(2);
    for (const bool late : {false, true}) {
        FunctionProgress* self = nullptr;
        FunctionProgress progress([&](const ProgressReport& report) {
            if (!late || report.done > 0) self->cancel();
        });
        self = &progress;
        const auto encoded = encode(GetParam(), maps, Format::fourState, {}, *executor, progress);
        if (late && encoded) continue;  // it had done all
        ASSERT_FALSE(encoded);
        EXPECT_EQ(encoded.error().kind, ErrorKind::cancelled);
    }
}

INSTANTIATE_TEST_SUITE_P(Encodings, Cancel,
                         testing::Values(Encoding::flat, Encoding::gruen, Encoding::tree,
                                         Encoding::indexedTree, Encoding::dag, Encoding::sdag),
                         tests::EncodingName());

TEST(CancelBitmasks, StopsBetweenRows) {
    const image::AlphaTexture texture{image::AlphaImage{64, 64, std::vector<uint16_t>(64 * 64)}};
    const std::vector<BitmaskSource> sources{{&texture, {}}};
    const std::atomic<bool> stop = true;
    FunctionProgress progress(stop);
    const auto set = encodeBitmasks(sources, Format::fourState, serialExecutor(), progress);
    ASSERT_FALSE(set);
    EXPECT_EQ(set.error().kind, ErrorKind::cancelled);
}

TEST(CancelBitmasks, RefusesAnImageWithoutItsTexels) {
    const image::AlphaTexture texture{image::AlphaImage{64, 64, {}}};
    const std::vector<BitmaskSource> sources{{&texture, {}}};
    const auto set = encodeBitmasks(sources, Format::fourState, serialExecutor());
    ASSERT_FALSE(set);
    EXPECT_EQ(set.error().kind, ErrorKind::usage);
}

}  // namespace
}  // namespace filigree::encoding
