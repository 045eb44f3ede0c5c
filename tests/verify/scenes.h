// Small textures and triangles for the judge's tests.
#pragma once

#include "filigree/image/alpha_image.h"
#include "filigree/mesh/uv_triangle.h"
#include "filigree/verify/verify.h"

#include <cstdint>
#include <functional>
#include <random>
#include <vector>

namespace filigree::verify::tests {

// A texture of 8-bit values from value(x, y), that repeats.
inline image::AlphaTexture texture8(uint32_t width, uint32_t height,
                                    const std::function<unsigned(uint32_t x, uint32_t y)>& value) {
    std::vector<uint8_t> texels;
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) texels.push_back(static_cast<uint8_t>(value(x, y)));
    }
    image::AlphaTexture texture;
    texture.image = image::alphaImageFrom8Bit(width, height, texels);
    return texture;
}

// A texture of 16-bit values from value(x, y), that repeats.
inline image::AlphaTexture texture16(uint32_t width, uint32_t height,
                                     const std::function<unsigned(uint32_t x, uint32_t y)>& value) {
    image::AlphaTexture texture;
    texture.image.width = width;
    texture.image.height = height;
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x)
            texture.image.texels.push_back(static_cast<uint16_t>(value(x, y)));
    }
    return texture;
}

inline mesh::UvTriangle triangleOf(mesh::Uv a, mesh::Uv b, mesh::Uv c) {
    mesh::UvTriangle triangle;
    triangle.uv = {a, b, c};
    return triangle;
}

// A triangle by texel coordinates on a texture of the given size.
inline mesh::UvTriangle triangleInTexels(const image::AlphaTexture& texture, mesh::Uv a, mesh::Uv b,
                                         mesh::Uv c) {
    const auto w = static_cast<float>(texture.image.width);
    const auto h = static_cast<float>(texture.image.height);
    return triangleOf({a.u / w, a.v / h}, {b.u / w, b.v / h}, {c.u / w, c.v / h});
}

inline image::AlphaTest maskTest(double cutoff = 0.5, double guard = 0) {
    image::AlphaTest test;
    test.cutoff = cutoff;
    test.guard = guard;
    return test;
}

inline image::AlphaTest blendTest(double guard = 0) {
    image::AlphaTest test;
    test.mode = image::AlphaMode::blend;
    test.guard = guard;
    return test;
}

// The truth of a whole triangle.
inline Truth wholeTruth(const mesh::UvTriangle& triangle, const image::AlphaTexture& texture,
                        const image::AlphaTest& test) {
    return truthOf(triangle, 0, 0, texture, test);
}

// Random textures and triangles, the same in every run.
class Random {
  public:
    explicit Random(uint32_t seed) : engine_(seed) {}
    uint32_t below(uint32_t count) { return engine_() % count; }
    float between(float lo, float hi) {
        return lo + (hi - lo) * static_cast<float>(engine_() >> 8) * 0x1p-24F;
    }

    image::AlphaTexture texture() {
        const unsigned kind = below(3);
        image::AlphaTexture result = texture8(1 + below(9), 1 + below(9), [&](uint32_t, uint32_t) {
            if (kind == 0) return below(2) * 255;
            if (kind == 1) return below(256);
            return below(5) < 4 ? 255U : 0U;
        });
        result.wrapU = static_cast<image::Wrap>(below(3));
        result.wrapV = static_cast<image::Wrap>(below(3));
        return result;
    }
    // Most of a few texels' size, near the image or some periods away.
    mesh::UvTriangle triangle(float size) {
        const mesh::Uv at{between(-3, 3), between(-3, 3)};
        const auto corner = [&] { return mesh::Uv{at.u + between(0, size), at.v + between(0, size)}; };
        return triangleOf(corner(), corner(), corner());
    }

  private:
    std::mt19937 engine_;
};

}  // namespace filigree::verify::tests
