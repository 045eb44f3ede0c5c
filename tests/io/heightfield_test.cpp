#include "filigree/io/heightfield.h"

#include "filigree/io/image_file.h"

#include "shared_data.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::io {
namespace {

using testing::HasSubstr;

std::vector<uint16_t> ramp(uint32_t width, uint32_t height) {
    std::vector<uint16_t> texels(size_t{width} * height);
    for (size_t k = 0; k < texels.size(); ++k) texels[k] = static_cast<uint16_t>(7919 * k);
    return texels;
}

std::string failureOf(std::span<const uint8_t> png, const HeightfieldOptions& options = {}) {
    const auto mesh = parseHeightfield(png, options);
    return mesh.ok() ? "no error" : mesh.error().message;
}

TEST(Heightfield, KeepsSixteenBits) {
    const std::vector<uint16_t> texels = ramp(5, 3);
    const auto mesh = parseHeightfield(*encodeGreyPng(5, 3, texels), {});
    ASSERT_TRUE(mesh.ok()) << mesh.error().message;
    ASSERT_EQ(mesh->grids.size(), 1U);
    EXPECT_EQ(mesh->grids[0], (grid::VertexGrid{5, 3, 0, 0}));
    EXPECT_TRUE(mesh->diagonals.empty());
    EXPECT_TRUE(mesh->quadSources.empty());
    EXPECT_EQ(mesh->triangleCount(), 16U);
    for (uint32_t row = 0; row < 3; ++row) {
        for (uint32_t column = 0; column < 5; ++column) {
            const Vec3 expected{static_cast<float>(column), static_cast<float>(texels[row * 5 + column]),
                                static_cast<float>(row)};
            EXPECT_EQ(mesh->vertices[row * 5 + column], expected);
        }
    }
}

TEST(Heightfield, EightBitsAreSteps) {
    const std::vector<uint8_t> texels{0, 1, 128, 255};
    const auto mesh = parseHeightfield(*encodeGreyPng(2, 2, texels), {2.5, -0.5});
    ASSERT_TRUE(mesh.ok()) << mesh.error().message;
    EXPECT_EQ(mesh->vertices[0], (Vec3{0, 0, 0}));
    EXPECT_EQ(mesh->vertices[1], (Vec3{2.5F, -0.5F, 0}));
    EXPECT_EQ(mesh->vertices[2], (Vec3{0, -64, 2.5F}));
    EXPECT_EQ(mesh->vertices[3], (Vec3{2.5F, -127.5F, 2.5F}));
}

TEST(Heightfield, RefusesWhatIsNoField) {
    EXPECT_EQ(failureOf(*encodeGreyPng(1, 9, ramp(1, 9))),
              "heightfield of 1 x 9 texels, expected at least 2 x 2");
    EXPECT_EQ(failureOf(*encodeGreyPng(9, 1, ramp(9, 1))),
              "heightfield of 9 x 1 texels, expected at least 2 x 2");
    EXPECT_EQ(failureOf(*encodePng({2, 2, std::vector<uint8_t>(16)})),
              "PNG: colour type 6 of 8 bits, expected grey of 8 or 16");
    EXPECT_THAT(failureOf({}), HasSubstr("PNG"));
}

TEST(Heightfield, RefusesOptionsOutOfRange) {
    const std::vector<uint8_t> png = *encodeGreyPng(4, 4, ramp(4, 4));
    for (const HeightfieldOptions& options :
         {HeightfieldOptions{0, 1}, HeightfieldOptions{-1, 1}, HeightfieldOptions{NAN, 1},
          HeightfieldOptions{1, 0}, HeightfieldOptions{1, INFINITY}, HeightfieldOptions{1e300, 1},
          HeightfieldOptions{1, 1e300}}) {
        const auto mesh = parseHeightfield(png, options);
        ASSERT_FALSE(mesh.ok());
        EXPECT_EQ(mesh.error().kind, ErrorKind::usage);
    }
}

TEST(Heightfield, EveryPrefixFails) {
    const std::vector<uint8_t> png = *encodeGreyPng(9, 7, ramp(9, 7));
    for (size_t length = 0; length + 16 < png.size(); ++length)  // behind the texels come their sum and IEND
        EXPECT_NE(failureOf(std::span(png).first(length)), "no error") << length;
}

TEST(Heightfield, ReadsRealOnes) {
    FILIGREE_NEEDS_SHARED_DATA();
    const auto meshes = tests::sharedData() / "data/meshes";
    const auto srtm = readHeightfield(meshes / "srtm_N51W001_1201.png", {});
    ASSERT_TRUE(srtm.ok()) << srtm.error().message;
    EXPECT_EQ(srtm->triangleCount(), 2880000U);
    float most = 0;
    for (const Vec3& vertex : srtm->vertices) most = std::max(most, vertex[1]);
    EXPECT_EQ(most, 326);
}

}  // namespace
}  // namespace filigree::io
