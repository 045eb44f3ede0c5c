#include "filigree/io/image_file.h"

#include "filigree/core/file.h"

#include "temp_folder.h"

#include <array>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spng.h>
#include <turbojpeg.h>

namespace filigree::tests {
namespace {

using testing::HasSubstr;

// A PNG of any kind, straight from libspng.
std::vector<uint8_t> png(uint8_t depth, uint8_t type, uint32_t width, uint32_t height,
                         const std::vector<uint8_t>& values, const spng_plte* palette = nullptr,
                         spng_trns* transparency = nullptr, uint8_t interlace = 0) {
    spng_ctx* context = spng_ctx_new(SPNG_CTX_ENCODER);
    spng_set_option(context, SPNG_ENCODE_TO_BUFFER, 1);
    spng_ihdr header{width, height, depth, type, 0, 0, interlace};
    EXPECT_EQ(spng_set_ihdr(context, &header), 0);
    spng_plte copy = palette != nullptr ? *palette : spng_plte{};
    if (palette != nullptr) spng_set_plte(context, &copy);
    if (transparency != nullptr) spng_set_trns(context, transparency);
    EXPECT_EQ(spng_encode_image(context, values.data(), values.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE),
              0);
    size_t size = 0;
    int error = 0;
    auto* bytes = static_cast<uint8_t*>(spng_get_png_buffer(context, &size, &error));
    std::vector<uint8_t> result(bytes, bytes + size);
    std::free(bytes);
    spng_ctx_free(context);
    return result;
}

std::vector<uint8_t> jpeg(int width, int height) {
    const std::vector<uint8_t> rgb(static_cast<size_t>(width) * static_cast<size_t>(height) * 3, 100);
    const tjhandle handle = tjInitCompress();
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    EXPECT_EQ(tjCompress2(handle, rgb.data(), width, 0, height, TJPF_RGB, &bytes, &size, TJSAMP_444, 90, 0),
              0);
    std::vector<uint8_t> result(bytes, bytes + size);
    tjFree(bytes);
    tjDestroy(handle);
    return result;
}

TEST(ImageFile, DecodesEveryAlphaOf8Bits) {
    scene::ColourImage image{16, 16, std::vector<uint8_t>(1024)};
    for (size_t i = 0; i < 256; ++i) image.rgba[4 * i + 3] = static_cast<uint8_t>(i);
    const Result<image::AlphaImage> alpha = io::decodeAlpha(io::encodePng(image).value());
    ASSERT_TRUE(alpha) << alpha.error().message;
    EXPECT_EQ(alpha->steps, 255U);
    for (size_t i = 0; i < 256; ++i) EXPECT_EQ(alpha->texels[i], i * 257);
}

TEST(ImageFile, DecodesEveryAlphaOf16Bits) {
    std::vector<uint16_t> values(256 * 256 * 4);
    for (size_t i = 0; i < 65536; ++i) values[4 * i + 3] = static_cast<uint16_t>(i);
    const auto* bytes = reinterpret_cast<const uint8_t*>(values.data());
    const Result<image::AlphaImage> alpha = io::decodeAlpha(
        png(16, SPNG_COLOR_TYPE_TRUECOLOR_ALPHA, 256, 256, {bytes, bytes + values.size() * 2}));
    ASSERT_TRUE(alpha) << alpha.error().message;
    EXPECT_EQ(alpha->steps, 65535U);
    for (size_t i = 0; i < 65536; ++i) ASSERT_EQ(alpha->texels[i], i);
}

TEST(ImageFile, DecodesGreyWithAlpha) {
    const Result<image::AlphaImage> alpha =
        io::decodeAlpha(png(8, SPNG_COLOR_TYPE_GRAYSCALE_ALPHA, 2, 1, {9, 77, 9, 200}));
    ASSERT_TRUE(alpha) << alpha.error().message;
    EXPECT_EQ(alpha->texels, (std::vector<uint16_t>{77 * 257, 200 * 257}));
}

TEST(ImageFile, DecodesPaletteTransparency) {
    spng_plte palette{};
    palette.n_entries = 3;
    spng_trns transparency{};
    transparency.n_type3_entries = 2;
    transparency.type3_alpha[0] = 0;
    transparency.type3_alpha[1] = 99;
    const Result<image::AlphaImage> alpha =
        io::decodeAlpha(png(8, SPNG_COLOR_TYPE_INDEXED, 3, 1, {0, 1, 2}, &palette, &transparency));
    ASSERT_TRUE(alpha) << alpha.error().message;
    EXPECT_EQ(alpha->texels, (std::vector<uint16_t>{0, 99 * 257, 65535}));
}

TEST(ImageFile, DecodesKeyColours) {
    spng_trns transparency{};
    transparency.gray = 5;
    const std::vector<uint8_t> file = png(8, SPNG_COLOR_TYPE_GRAYSCALE, 2, 1, {5, 6}, nullptr, &transparency);
    const Result<image::AlphaImage> alpha = io::decodeAlpha(file);
    ASSERT_TRUE(alpha) << alpha.error().message;
    EXPECT_EQ(alpha->texels, (std::vector<uint16_t>{0, 65535}));
}

TEST(ImageFile, IsOpaqueWithoutAlpha) {
    const std::vector<uint8_t> grey{1, 2, 3, 4};
    const Result<image::AlphaImage> alpha = io::decodeAlpha(io::encodeGreyPng(2, 2, grey).value());
    EXPECT_EQ(alpha->texels, std::vector<uint16_t>(4, 65535));
    const Result<image::AlphaImage> fromJpeg = io::decodeAlpha(jpeg(5, 3));
    ASSERT_TRUE(fromJpeg) << fromJpeg.error().message;
    EXPECT_EQ(fromJpeg->width, 5U);
    EXPECT_EQ(fromJpeg->texels, std::vector<uint16_t>(15, 65535));
}

TEST(ImageFile, DecodesJpegColour) {
    const Result<scene::ColourImage> image = io::decodeImage(jpeg(5, 3));
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->rgba.size(), 60U);
    EXPECT_NEAR(image->rgba[0], 100, 2);
    EXPECT_EQ(image->rgba[3], 255);
}

TEST(ImageFile, ReadsGreyFilesAsAlpha) {
    const TempFolder folder;
    std::vector<uint8_t> bytes(12);
    std::iota(bytes.begin(), bytes.end(), uint8_t{0});
    ASSERT_TRUE(writeFile(folder / "a.png", io::encodeGreyPng(4, 3, bytes).value()));
    const Result<image::AlphaImage> alpha = io::readAlphaImage(folder / "a.png");
    ASSERT_TRUE(alpha) << alpha.error().message;
    EXPECT_EQ(alpha->at(3, 2), 11 * 257);
    const std::vector<uint16_t> words{0, 1, 32768, 65535};
    ASSERT_TRUE(writeFile(folder / "b.png", io::encodeGreyPng(2, 2, words).value()));
    EXPECT_EQ(io::readAlphaImage(folder / "b.png")->texels, words);
    ASSERT_TRUE(writeFile(folder / "c.png", png(8, SPNG_COLOR_TYPE_TRUECOLOR, 1, 1, {1, 2, 3})));
    EXPECT_THAT(io::readAlphaImage(folder / "c.png").error().message,
                HasSubstr("c.png: PNG: colour without alpha"));
}

TEST(ImageFile, RefusesImagesThatTheirBytesCannotHold) {
    std::vector<uint8_t> file = png(8, SPNG_COLOR_TYPE_GRAYSCALE, 1, 1, {5});
    // Width and height of the header, then its checksum, for 65535 x 4096.
    const std::array<uint8_t, 8> size{0, 0, 0xFF, 0xFF, 0, 0, 0x10, 0};
    std::copy(size.begin(), size.end(), file.begin() + 16);
    EXPECT_FALSE(io::decodeAlpha(file));
}

TEST(ImageFile, FailsOnEveryPrefix) {
    const std::vector<uint8_t> grey(400, 7);
    const std::vector<uint8_t> file = io::encodeGreyPng(20, 20, grey).value();
    const size_t dataEnd = file.size() - 12;  // before IEND, which no decoder needs
    for (size_t size = 0; size + 4 < dataEnd; ++size) {
        const std::vector<uint8_t> cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_FALSE(io::decodePng(cut)) << size;
    }
}

TEST(ImageFile, NamesWhatItDoesNotRead) {
    const std::string webp = "RIFF....WEBPVP8 ";
    EXPECT_THAT(io::decodeAlpha(std::vector<uint8_t>(webp.begin(), webp.end())).error().message,
                HasSubstr("WebP"));
    const std::vector<uint8_t> ktx{0xAB, 'K', 'T', 'X', ' ', '2', '0', 0xBB, 13, 10, 26, 10};
    EXPECT_THAT(io::decodeAlpha(ktx).error().message, HasSubstr("KTX2"));
}

}  // namespace
}  // namespace filigree::tests
