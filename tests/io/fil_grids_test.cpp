// Grids in a .fil: what is written is read, and nothing else is.
#include "filigree/io/fil_grids.h"

#include "filigree/core/file.h"
#include "filigree/io/fil_squares.h"

#include "io/sample_fil.h"
#include "io/sample_fil_grids.h"
#include "io/temp_folder.h"

#include <cstring>

#include <gtest/gtest.h>

namespace filigree::io {
namespace {

using grid::Codec;
using tests::TempFolder;

struct GridSample {
    FilGrids contents;

    explicit GridSample(Codec codec, bool withAttributes = true)
        : contents(tests::sampleFilGrids(codec, withAttributes)) {}
    [[nodiscard]] std::vector<uint8_t> bytes(bool zstd = false) const {
        const TempFolder folder;
        const auto written = writeFilGrids(folder / "x.fil", contents, zstd);
        EXPECT_TRUE(written);
        auto read = readFile(folder / "x.fil");
        EXPECT_EQ(*written, read->size());
        return std::move(*read);
    }
};

class FilGridsCodecs : public ::testing::TestWithParam<Codec> {};
INSTANTIATE_TEST_SUITE_P(FilGrids, FilGridsCodecs, ::testing::Values(Codec::paper, Codec::lattice),
                         [](const auto& codec) { return std::string(nameOf(codec.param)); });

TEST_P(FilGridsCodecs, AreReadAsWritten) {
    for (const bool withAttributes : {false, true}) {
        const GridSample sample(GetParam(), withAttributes);
        for (const bool zstd : {false, true}) {
            const auto file = parseFilGrids(sample.bytes(zstd), "x.fil");
            ASSERT_TRUE(file) << file.error().message;
            const grid::EncodedGrids& grids = file->grids;
            const grid::EncodedGrids& wanted = sample.contents.grids;
            EXPECT_EQ(grids.codec, GetParam());
            EXPECT_EQ(grids.lattice, wanted.lattice);
            EXPECT_EQ(grids.paper, wanted.paper);
            EXPECT_EQ(grids.records, wanted.records);
            EXPECT_EQ(grids.offsets, wanted.offsets);
            ASSERT_EQ(grids.nodes.size(), wanted.nodes.size());
            EXPECT_EQ(std::memcmp(grids.nodes.data(), wanted.nodes.data(), 80 * wanted.nodes.size()), 0);
            EXPECT_EQ(file->table, sample.contents.table);
            EXPECT_EQ(file->looseTriangles, sample.contents.looseTriangles);
            EXPECT_EQ(file->asset, sample.contents.asset);
            EXPECT_EQ(file->attributes, sample.contents.attributes);
        }
    }
}

TEST_P(FilGridsCodecs, AreToldApart) {
    const TempFolder folder;
    const GridSample sample(GetParam());
    ASSERT_TRUE(writeFilGrids(folder / "x.fil", sample.contents, true));
    EXPECT_EQ(gridsIn(folder / "x.fil"), GetParam());
    EXPECT_EQ(squaresIn(folder / "x.fil"), std::nullopt);
    const auto micromaps = FilFile::read(folder / "x.fil");
    ASSERT_FALSE(micromaps);
    EXPECT_NE(micromaps.error().message.find("holds vertex grids"), std::string::npos);
    ASSERT_TRUE(writeFil(folder / "y.fil", tests::SampleFil().contents, false));
    EXPECT_EQ(gridsIn(folder / "y.fil"), std::nullopt);
    EXPECT_FALSE(readFilGrids(folder / "y.fil"));
}

TEST_P(FilGridsCodecs, EveryPrefixIsRefused) {
    const std::vector<uint8_t> whole = GridSample(GetParam()).bytes();
    for (size_t size = 0; size < whole.size(); size += size < 2000 ? 1 : 97) {
        std::vector<uint8_t> part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
        part.shrink_to_fit();
        EXPECT_FALSE(parseFilGrids(part, "x.fil")) << size;
        tests::resealFil(part);
        EXPECT_FALSE(parseFilGrids(part, "x.fil")) << size;
    }
    std::vector<uint8_t> longer = whole;
    longer.push_back(0);
    EXPECT_FALSE(parseFilGrids(longer, "x.fil"));
}

// What is accepted after a change stays in bounds; most is refused, by name.
TEST_P(FilGridsCodecs, ChangedBytesAreSurvived) {
    const std::vector<uint8_t> whole = GridSample(GetParam()).bytes();
    for (size_t at = 0; at < whole.size(); at += 23) {
        std::vector<uint8_t> changed = whole;
        changed[at] ^= static_cast<uint8_t>(1U << (at % 8));
        tests::resealFil(changed);
        const auto file = parseFilGrids(changed, "x.fil");
        if (file) continue;
        EXPECT_EQ(file.error().message.rfind("x.fil: ", 0), 0u);
    }
}

class FilGridsRefusals : public ::testing::Test {
  protected:
    // `change` alters the contents before they are written.
    template <class Change>
    void expectRefusal(const std::string& part, const Change& change) {
        GridSample sample(Codec::lattice);
        change(sample.contents);
        const auto file = parseFilGrids(sample.bytes(), "x.fil");
        ASSERT_FALSE(file);
        EXPECT_NE(file.error().message.find(part), std::string::npos) << file.error().message;
    }
};

TEST_F(FilGridsRefusals, NameTheSection) {
    expectRefusal("section grids: grid 0 has 0 x 8", [](FilGrids& f) { f.table[0] = {1, 9, 0, 0}; });
    expectRefusal("too many for", [](FilGrids& f) { f.table[0] = {65536, 65536, 0, 0}; });
    expectRefusal("too many for", [](FilGrids& f) { f.looseTriangles += 1U << 20; });
    expectRefusal("stands in no record", [](FilGrids& f) { ++f.looseTriangles; });
    expectRefusal("section corners: loose triangle 3 has vertex 4294967295",
                  [](FilGrids& f) { f.attributes.looseTriangles[3][1] = 0xffffffff; });
    expectRefusal("section corners", [](FilGrids& f) { f.attributes.looseTriangles.clear(); });
    expectRefusal("section normals", [](FilGrids& f) { f.attributes.normals.pop_back(); });
    expectRefusal("section sources", [](FilGrids& f) { f.attributes.looseSources.pop_back(); });
    expectRefusal("bytes without offsets", [](FilGrids& f) { f.grids.offsets.clear(); });
    expectRefusal("node", [](FilGrids& f) { f.grids.nodes.pop_back(); });
    expectRefusal("the step along x", [](FilGrids& f) { f.grids.lattice.step[0] = -1; });
}

TEST(FilGrids, CompressedSectionsAreLimited) {
    FilReadOptions options;
    options.maxBytes = 1000;
    const auto file = parseFilGrids(GridSample(Codec::paper).bytes(true), "x.fil", serialExecutor(), options);
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().kind, ErrorKind::limit);
}

}  // namespace
}  // namespace filigree::io
