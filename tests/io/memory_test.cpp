// Files in memory: the bytes that the same calls with paths write and read.
#include "filigree/core/file.h"
#include "filigree/io/api_blob.h"
#include "filigree/io/fil_squares.h"
#include "filigree/io/image_file.h"

#include "io/sample_fil.h"
#include "io/sample_fil_grids.h"
#include "sample_gltf.h"
#include "temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::tests {
namespace {

using testing::HasSubstr;

TEST(Memory, FilOfMapsIsThatOfThePath) {
    const TempFolder folder;
    const SampleFil sample;
    for (const bool zstd : {false, true}) {
        ASSERT_TRUE(io::writeFil(folder / "x.fil", sample.contents, zstd));
        const auto bytes = io::encodeFil(sample.contents, zstd);
        ASSERT_TRUE(bytes);
        EXPECT_EQ(*bytes, readFile(folder / "x.fil").value());
        EXPECT_TRUE(io::isFil(*bytes));
        const auto file = io::FilFile::view(*bytes, "x.fil");
        ASSERT_TRUE(file) << file.error().message;
        std::vector<int32_t> indices(21);
        file->readIndices(0, indices);
        EXPECT_TRUE(std::ranges::equal(indices, sample.contents.indices));
        EXPECT_TRUE(std::ranges::equal(file->set().payload, sample.contents.set.payload));
    }
    EXPECT_EQ(io::identifyAsset(folder / "x.fil")->hash,
              io::identifyAsset(readFile(folder / "x.fil").value(), "x.fil").hash);
}

TEST(Memory, FilRefusesContentsThatDoNotAgree) {
    SampleFil sample;
    const std::vector<int32_t> indices(21, 6);
    sample.contents.indices = indices;
    EXPECT_EQ(io::encodeFil(sample.contents, false).error().message, "triangle 0: index 6, expected -4 to 5");
    sample.contents.indices = std::span(indices).first(20);
    const auto bytes = io::encodeFil(sample.contents, false);
    ASSERT_FALSE(bytes);
    EXPECT_EQ(bytes.error().kind, ErrorKind::usage);
    EXPECT_EQ(bytes.error().message, "20 micromap indices, expected 21");
}

TEST(Memory, FilOfGridsIsThatOfThePath) {
    const TempFolder folder;
    const io::FilGrids grids = sampleFilGrids(grid::Codec::lattice);
    ASSERT_TRUE(io::writeFilGrids(folder / "x.fil", grids, true));
    const std::vector<uint8_t> bytes = io::encodeFilGrids(grids, true);
    EXPECT_EQ(bytes, readFile(folder / "x.fil").value());
    EXPECT_EQ(io::gridsIn(bytes), grid::Codec::lattice);
    EXPECT_EQ(io::squaresIn(bytes), std::nullopt);
    EXPECT_TRUE(io::parseFilGrids(bytes, "x.fil"));
}

TEST(Memory, FilOfSquaresIsThatOfThePath) {
    const TempFolder folder;
    const std::vector<uint8_t> blocks(2 * blockBytesOf(quadmap::SquareFormat::vq2), 0x5a);
    const std::vector<int32_t> indices{1, -2, 0};
    const std::vector<quadmap::SquarePlace> places(3);
    io::FilSquares squares;
    squares.meta.groups = {{"leaf", image::AlphaTest{}}};
    squares.meta.primitives = {{0, 0, 3, 0}};
    squares.indices = indices;
    squares.places = places;
    squares.blocks = blocks;
    ASSERT_TRUE(io::writeFilSquares(folder / "x.fil", squares, false));
    const auto bytes = io::encodeFilSquares(squares, false);
    ASSERT_TRUE(bytes);
    EXPECT_EQ(*bytes, readFile(folder / "x.fil").value());
    EXPECT_EQ(io::squaresIn(*bytes), quadmap::SquareFormat::vq2);
    const auto file = io::FilSquareFile::view(*bytes, "x.fil");
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->maps().mapCount(), 2U);
    squares.blocks = std::span(blocks).first(33);
    EXPECT_THAT(io::encodeFilSquares(squares, false).error().message, HasSubstr("33 bytes"));
    squares.blocks = std::span(blocks).first(32);
    EXPECT_THAT(io::encodeFilSquares(squares, false).error().message, HasSubstr("index 1"));
}

class MicromapsInMemory : public testing::Test {
  protected:
    MicromapsInMemory() {
        output_.micromaps.push_back({"leaf", &set_, {}});
        output_.primitives.push_back({0, 0, 0, indices_, {}});
    }
    TempFolder folder_;
    micromap::FlatSet set_ = sampleSet(2, 3);
    std::vector<int32_t> indices_{2, -1};
    io::MicromapOutput output_;
};

TEST_F(MicromapsInMemory, GlbIsThatOfThePath) {
    const std::vector<uint8_t> glb = SampleGltf::maskedQuad().glb();
    const auto document = io::GltfDocument::view(glb, "", "leaf.glb");
    ASSERT_TRUE(document) << document.error().message;
    ASSERT_TRUE(io::writeWithMicromaps(*document, output_, folder_ / "x.glb"));
    const auto bytes = io::encodeWithMicromaps(*document, output_);
    ASSERT_TRUE(bytes) << bytes.error().message;
    EXPECT_EQ(*bytes, readFile(folder_ / "x.glb").value());
    const auto again = io::GltfDocument::view(*bytes, "", "x.glb");
    ASSERT_TRUE(again);
    const auto scene = io::readScene(*again);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->meshes[0].primitives[0].micromapIndices, indices_);
}

TEST_F(MicromapsInMemory, ATextDocumentNeedsItsBytesNoLonger) {
    Result<io::GltfDocument> document = Error{};
    {
        const std::string text = SampleGltf::maskedQuad().gltf();
        const std::vector<uint8_t> bytes(text.begin(), text.end());
        document = io::GltfDocument::parse(bytes, "", "leaf.gltf");
    }
    ASSERT_TRUE(document) << document.error().message;
    EXPECT_TRUE(io::readScene(*document));
}

TEST_F(MicromapsInMemory, RefuseOutputThatDoesNotAgree) {
    const auto document = SampleGltf::maskedQuad().parse();
    const auto message = [&] {
        const auto bytes = io::encodeWithMicromaps(*document, output_);
        EXPECT_FALSE(bytes);
        EXPECT_EQ(bytes.error().kind, ErrorKind::usage);
        return bytes.error().message;
    };
    indices_ = {3, 0};
    EXPECT_EQ(message(), "sample.glb: primitive 0 of mesh 0: triangle 0: index 3, expected -4 to 2");
    EXPECT_FALSE(io::encodeApiBlobs(output_, "leaf.glb"));
    indices_ = {0, 0};
    output_.primitives[0].mesh = 7;
    EXPECT_EQ(message(), "sample.glb: the document has no primitive 0 of mesh 7");
    output_.primitives[0].micromaps = 1;
    EXPECT_EQ(message(), "sample.glb: primitive 0 of mesh 7: micromaps 1 of 1");
    output_.micromaps[0].set = nullptr;
    EXPECT_EQ(message(), "sample.glb: micromaps 0: no record, expected at least one");
}

TEST_F(MicromapsInMemory, BlobsAreThoseOfTheFolder) {
    ASSERT_TRUE(io::writeApiBlobs(folder_ / "raw", output_, "leaf.glb"));
    auto blobs = io::encodeApiBlobs(output_, "leaf.glb");
    ASSERT_TRUE(blobs) << blobs.error().message;
    ASSERT_EQ(blobs->size(), 4U);
    for (const io::ApiBlob& blob : *blobs)
        EXPECT_EQ(blob.bytes, readFile(folder_ / "raw" / blob.name).value()) << blob.name;
    const auto whole = io::checkApiBlobs(*blobs);
    ASSERT_TRUE(whole);
    EXPECT_TRUE(whole->empty());
    blobs->erase(blobs->begin());
    const auto broken = io::checkApiBlobs(*blobs);
    ASSERT_TRUE(broken);
    ASSERT_FALSE(broken->empty());
    EXPECT_EQ(broken->front().rule, "raw-file");
    blobs->pop_back();
    EXPECT_FALSE(io::checkApiBlobs(*blobs));
}

TEST(Memory, AlphaImagesComeFromBytes) {
    const auto image = io::parseAlphaImage(samplePng());
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->width, 4U);
    EXPECT_EQ(image->at(0, 0), 0);
    EXPECT_FALSE(io::parseAlphaImage({}));
}

}  // namespace
}  // namespace filigree::tests
