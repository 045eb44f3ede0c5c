// Squares in a .fil: what is written is read, and nothing else is.
#include "filigree/io/fil_squares.h"

#include "filigree/core/bytes.h"
#include "filigree/core/file.h"

#include "io/fil_layout.h"
#include "io/sample_fil.h"
#include "io/temp_folder.h"

#include <numeric>

#include <gtest/gtest.h>

namespace filigree::io {
namespace {

using quadmap::Half;
using quadmap::SquareFormat;
using tests::TempFolder;

struct Sample {
    std::vector<int32_t> indices{-1, 0, 0, 2, -4, 1, -2};
    std::vector<quadmap::SquarePlace> places{
        {}, {Half::first, 2}, {Half::second, 5}, {Half::first, 0}, {}, {Half::second, 3}, {}};
    std::vector<uint8_t> blocks;
    FilSquares contents;

    explicit Sample(SquareFormat format) : blocks(3 * blockBytesOf(format)) {
        std::iota(blocks.begin(), blocks.end(), uint8_t{1});
        contents.meta.asset = {"leaf.glb", 1234, {1, 2}};
        contents.meta.groups = {{"leaf", image::AlphaTest{}}};
        contents.meta.primitives = {{0, 0, 4, 0}, {1, 0, 3, 0}};
        contents.format = format;
        contents.indices = indices;
        contents.places = places;
        contents.blocks = blocks;
    }
    [[nodiscard]] std::vector<uint8_t> bytes(bool zstd = false) const {
        const TempFolder folder;
        EXPECT_TRUE(writeFilSquares(folder / "x.fil", contents, zstd));
        auto read = readFile(folder / "x.fil");
        return read ? *read : std::vector<uint8_t>{};
    }
};

class FilSquaresFormats : public ::testing::TestWithParam<SquareFormat> {};

TEST_P(FilSquaresFormats, AreReadAsWritten) {
    const Sample sample(GetParam());
    for (const bool zstd : {false, true}) {
        const auto file = FilSquareFile::parse(sample.bytes(zstd), "x.fil");
        ASSERT_TRUE(file) << file.error().message;
        EXPECT_EQ(file->maps().format(), GetParam());
        EXPECT_EQ(file->maps().mapCount(), 3u);
        EXPECT_EQ(file->meta().asset, sample.contents.meta.asset);
        EXPECT_EQ(file->meta().primitives.size(), 2u);
        std::vector<int32_t> indices(5);
        file->readIndices(2, indices);
        EXPECT_TRUE(std::equal(indices.begin(), indices.end(), sample.indices.begin() + 2));
        for (uint64_t t = 0; t < 7; ++t) EXPECT_EQ(file->place(t), sample.places[t]);
    }
}

INSTANTIATE_TEST_SUITE_P(FilSquares, FilSquaresFormats,
                         ::testing::Values(SquareFormat::vq2, SquareFormat::vq2Plus, SquareFormat::vq4,
                                           SquareFormat::vq4Plus));

TEST(FilSquares, EveryPrefixIsRefused) {
    const std::vector<uint8_t> whole = Sample(SquareFormat::vq2).bytes();
    for (size_t size = 0; size < whole.size(); ++size) {
        std::vector<uint8_t> part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_FALSE(FilSquareFile::parse(std::move(part), "x.fil")) << size;
    }
    std::vector<uint8_t> longer = whole;
    longer.push_back(0);
    EXPECT_FALSE(FilSquareFile::parse(longer, "x.fil"));
}

TEST(FilSquares, EachKindOfFileIsRefusedAsTheOther) {
    const auto file = FilFile::parse(Sample(SquareFormat::vq4).bytes(), "x.fil");
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().message, "x.fil: holds opacity squares (vq4), expected micromaps");
}

TEST(FilSquares, PlacesAndIndicesAreChecked) {
    Sample sample(SquareFormat::vq2);
    sample.places[1].order = 6;
    EXPECT_FALSE(FilSquareFile::parse(sample.bytes(), "x.fil"));
    std::vector<uint8_t> more = Sample(SquareFormat::vq2).bytes();
    const auto indices = loadLe<uint64_t>(more.data() + filHeaderBytes + filEntryBytes + 8);
    more[indices] |= 7 << 3;  // triangle 1: map 3 of three, in three bits
    tests::resealFil(more);
    const auto file = FilSquareFile::parse(more, "x.fil");
    ASSERT_FALSE(file);
    EXPECT_NE(file.error().message.find("triangle 1 has map 3 of 3"), std::string::npos)
        << file.error().message;
}

TEST(FilSquares, OrdersAreAllPermutations) {
    for (uint8_t order = 0; order < 6; ++order) {
        const auto vertices = quadmap::verticesOf({Half::first, order});
        EXPECT_EQ(quadmap::orderOf(vertices), order);
        EXPECT_EQ(vertices[0] + vertices[1] + vertices[2], 3);
    }
}

}  // namespace
}  // namespace filigree::io
