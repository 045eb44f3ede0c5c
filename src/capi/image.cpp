#include "capi/image.h"

#include "capi/arguments.h"
#include "capi/sized.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace filigree::capi {
namespace {

constexpr filigree_image imageDefaults = FILIGREE_IMAGE_INIT;
constexpr filigree_alpha_test testDefaults = FILIGREE_ALPHA_TEST_INIT;
constexpr uint32_t mostMips = 32;

uint16_t texelOf(uint8_t value, uint32_t, uint32_t) {
    return static_cast<uint16_t>(value * 257U);
}
uint16_t texelOf(uint16_t value, uint32_t, uint32_t) {
    return value;
}
uint16_t texelOf(float value, uint32_t x, uint32_t y) {
    if (std::isnan(value)) fail(FILIGREE_ERROR_ARGUMENT, "image: texel ({}, {}) is not a number", x, y);
    return static_cast<uint16_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 65535.0));
}

template <class T>
void readTexels(const filigree_image& from, image::AlphaImage& to) {
    const size_t stride = from.texel_stride != 0 ? from.texel_stride : sizeof(T);
    const size_t rowStride = from.row_stride != 0 ? from.row_stride : stride * from.width;
    const auto* row = static_cast<const unsigned char*>(from.texels);
    uint16_t* out = to.texels.data();
    for (uint32_t y = 0; y < from.height; ++y) {
        for (uint32_t x = 0; x < from.width; ++x) {
            T value;
            std::memcpy(&value, row + y * rowStride + x * stride, sizeof value);
            *out++ = texelOf(value, x, y);
        }
    }
}

void readTexels(const filigree_image& from, filigree_texel texel, image::AlphaImage& to) {
    switch (texel) {
        case FILIGREE_TEXEL_U8:
            to.steps = 255;
            return readTexels<uint8_t>(from, to);
        case FILIGREE_TEXEL_U16:
            return readTexels<uint16_t>(from, to);
        default:
            return readTexels<float>(from, to);
    }
}

}  // namespace

image::AlphaTexture textureOf(const filigree_image* given) {
    const filigree_image from = takenOf(given, imageDefaults, "image");
    required(static_cast<const unsigned char*>(from.texels), "image.texels");
    image::AlphaTexture texture;
    texture.image.width = within(from.width, 1U, image::maxImageSide, "image.width");
    texture.image.height = within(from.height, 1U, image::maxImageSide, "image.height");
    texture.wrapU = enumerator(from.wrap_u, image::Wrap::clampToEdge, "image.wrap_u");
    texture.wrapV = enumerator(from.wrap_v, image::Wrap::clampToEdge, "image.wrap_v");
    texture.filter = enumerator(from.filter, image::Filter::both, "image.filter");
    const auto texel = enumerator(from.texel, FILIGREE_TEXEL_F32, "image.texel");
    texture.image.texels.resize(size_t{from.width} * from.height);
    readTexels(from, texel, texture.image);
    return texture;
}

image::AlphaTest testOf(const filigree_alpha_test* given) {
    const filigree_alpha_test from = taken(given, testDefaults, "test");
    image::AlphaTest test;
    test.mode = enumerator(from.mode, image::AlphaMode::blend, "test.mode");
    test.mips = within(from.mips, 0U, mostMips, "test.mips");
    test.cutoff = within(from.cutoff, 0.0, 1e300, "test.cutoff");
    test.factor = within(from.factor, 0.0, 1.0, "test.factor");
    test.guard = within(from.guard, 0.0, 1024.0, "test.guard");
    return test;
}

}  // namespace filigree::capi

filigree_error filigree_image_init(filigree_image* image, size_t struct_size) {
    return filigree::capi::initialise(image, struct_size, filigree::capi::imageDefaults);
}

filigree_error filigree_alpha_test_init(filigree_alpha_test* test, size_t struct_size) {
    return filigree::capi::initialise(test, struct_size, filigree::capi::testDefaults);
}
