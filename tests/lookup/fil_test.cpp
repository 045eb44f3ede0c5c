// Files through filigree_lookup.h, against io's.
#include "filigree/io/fil.h"

#include "filigree/encoding/map_reader.h"
#include "filigree/io/fil_squares.h"

#include "encoding/sample_maps.h"
#include "exact_bytes.h"
#include "io/sample_fil.h"
#include "io/temp_folder.h"
#include "lookup/compilers.h"

#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

namespace filigree::tests {
namespace {

std::vector<uint8_t> bytesOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// A file with maps that can be looked up: the contents of SampleFil, but for the set.
std::vector<uint8_t> sampleFile(bool zstd) {
    const TempFolder folder;
    const auto set = encodeGood(encoding::Encoding::sdag, smallSet(), micromap::Format::twoState);
    SampleFil sample(set.mapCount);
    sample.contents.meta.level.reset();
    sample.contents.set = encoding::viewOf(set);
    const auto written = io::writeFil(folder.path() / "maps.fil", sample.contents, zstd);
    EXPECT_TRUE(written.ok()) << written.error().message;
    return bytesOf(folder.path() / "maps.fil");
}

TEST(LookupHeaderFil, findsMapsOfTriangles) {
    const std::vector<uint8_t> bytes = sampleFile(false);
    const auto file = io::FilFile::parse(bytes, "sample");
    ASSERT_TRUE(file.ok()) << file.error().message;
    std::vector<int32_t> indices(file->meta().triangleCount());
    file->readIndices(0, indices);
    const auto reader = openGood(file->set());
    const ExactBytes exact(bytes);
    for (const lookup_functions* lookup : lookupCompilers()) {
        SCOPED_TRACE(lookup->compiler);
        filigree_fil fil;
        ASSERT_EQ(lookup->fil_open(&fil, exact.view().data(), exact.view().size()), FILIGREE_LOOKUP_OK);
        filigree_view view;
        ASSERT_EQ(filigree_view_open_fil(&view, &fil), FILIGREE_LOOKUP_OK);
        ASSERT_EQ(fil.map_count, file->set().mapCount);
        for (size_t t = 0; t < indices.size(); ++t) {
            ASSERT_EQ(lookup->fil_index(&fil, t), indices[t]) << t;
            if (indices[t] < 0) {
                EXPECT_EQ(filigree_special_state(indices[t]),
                          static_cast<unsigned>(micromap::stateOfSpecialIndex(indices[t])));
                continue;
            }
            const auto map = static_cast<uint32_t>(indices[t]);
            EXPECT_EQ(lookup->view_at_point(&view, map, 0.25F, 0.5F),
                      static_cast<unsigned>(reader->at(map, 0.25F, 0.5F)));
        }
        EXPECT_EQ(lookup->fil_index(&fil, indices.size() + 64), -4);
        EXPECT_EQ(fil.pairs.size, file->pairs().size());
    }
}

TEST(LookupHeaderFil, findsPrimitives) {
    const std::vector<uint8_t> bytes = sampleFile(false);
    for (const lookup_functions* lookup : lookupCompilers()) {
        filigree_fil fil;
        ASSERT_EQ(lookup->fil_open(&fil, bytes.data(), bytes.size()), FILIGREE_LOOKUP_OK);
        uint64_t first = 0;
        uint32_t count = 0;
        EXPECT_EQ(lookup->fil_triangles(&fil, 0, 0, &first, &count), FILIGREE_LOOKUP_OK);
        EXPECT_EQ(first, 0u);
        EXPECT_EQ(count, 10u);
        EXPECT_EQ(lookup->fil_triangles(&fil, 1, 0, &first, &count), FILIGREE_LOOKUP_OK);
        EXPECT_EQ(first, 10u);
        EXPECT_EQ(count, 11u);
        EXPECT_EQ(lookup->fil_triangles(&fil, 1, 1, &first, &count), FILIGREE_LOOKUP_MISSING);
        // A meta section that ends anywhere.
        for (const size_t whole = fil.meta.size; fil.meta.size > 0;) {
            const ExactBytes meta({bytes.data() + (fil.meta.bytes - bytes.data()), --fil.meta.size});
            filigree_fil cut = fil;
            cut.meta.bytes = meta.view().data();
            EXPECT_EQ(lookup->fil_triangles(&cut, 1, 0, &first, &count), FILIGREE_LOOKUP_FILE)
                << fil.meta.size << " of " << whole;
        }
    }
}

TEST(LookupHeaderFil, refusesWhatItCannotRead) {
    const std::vector<uint8_t> bytes = sampleFile(false);
    filigree_fil fil;
    for (size_t cut = 0; cut < bytes.size(); cut += cut < 400 ? 1 : 61) {
        const ExactBytes exact({bytes.data(), cut});
        EXPECT_NE(filigree_fil_open(&fil, exact.view().data(), cut), FILIGREE_LOOKUP_OK) << cut;
    }
    const std::vector<uint8_t> packed = sampleFile(true);
    EXPECT_EQ(filigree_fil_open(&fil, packed.data(), packed.size()), FILIGREE_LOOKUP_COMPRESSED);
    filigree_section section;
    EXPECT_EQ(filigree_fil_find(bytes.data(), bytes.size(), 99, &section), FILIGREE_LOOKUP_MISSING);
}

TEST(LookupHeaderFil, findsSquaresOfTriangles) {
    const std::filesystem::path corpus =
        std::filesystem::path(__FILE__).parent_path() / "../fuzz/corpus/fil_read";
    for (const char* name : {"squares_vq2.fil", "squares_vq4_plus.fil"}) {
        const std::vector<uint8_t> bytes = bytesOf(corpus / name);
        const auto file = io::FilSquareFile::parse(bytes, name);
        ASSERT_TRUE(file.ok()) << file.error().message;
        std::vector<int32_t> indices(file->meta().triangleCount());
        file->readIndices(0, indices);
        for (const lookup_functions* lookup : lookupCompilers()) {
            filigree_fil fil;
            ASSERT_EQ(lookup->fil_open(&fil, bytes.data(), bytes.size()), FILIGREE_LOOKUP_OK);
            filigree_vq squares;
            ASSERT_EQ(filigree_vq_open_fil(&squares, &fil), FILIGREE_LOOKUP_OK);
            for (size_t t = 0; t < indices.size(); ++t) {
                const quadmap::SquarePlace place = file->place(t);
                ASSERT_EQ(lookup->fil_index(&fil, t), indices[t]);
                ASSERT_EQ(lookup->fil_place(&fil, t), 2U * place.order + static_cast<unsigned>(place.half));
            }
        }
    }
}

// What a pair of states makes of the bits of a map: docs/spec/one-bit.md.
TEST(LookupHeaderFil, knowsPairs) {
    const std::array<uint8_t, 2> pairs{0b10'01'00, 0b01};
    const std::array<unsigned, 3> ofZero{0, 0, 2};
    const std::array<unsigned, 3> ofOne{1, 3, 1};
    for (uint32_t map = 0; map < 3; ++map) {
        EXPECT_EQ(filigree_pair_state(pairs.data(), map, 0), ofZero[map]);
        EXPECT_EQ(filigree_pair_state(pairs.data(), map, 1), ofOne[map]);
    }
    EXPECT_EQ(filigree_pair_state(pairs.data(), 4, 1), 3u);
}

}  // namespace
}  // namespace filigree::tests
