// The any-hit test's sampler gives what the bake is proven against.
#include "trace/sampler.h"

#include "filigree/image/alpha_image.h"

#include "trace/random.h"

#include <gtest/gtest.h>

namespace filigree {
namespace {

image::AlphaTexture noise(uint32_t width, uint32_t height, uint32_t steps) {
    image::AlphaTexture texture{{width, height, {}, steps}};
    for (uint32_t k = 0; k < width * height; ++k) {
        const auto step = trace::hashed(k, steps) % (steps + 1);
        texture.image.texels.push_back(static_cast<uint16_t>(step * (65535 / steps)));
    }
    return texture;
}

TEST(Sampler, EqualsTheImagesOwnFilterToTheBit) {
    trace::RandomStream random(1, 2, 3);
    for (const uint32_t steps : {255u, 65535u}) {
        image::AlphaTexture texture = noise(13, 7, steps);
        for (const auto wrap : {image::Wrap::repeat, image::Wrap::mirroredRepeat, image::Wrap::clampToEdge}) {
            texture.wrapU = texture.wrapV = wrap;
            texture.filter = image::Filter::linear;
            const trace::Sampler linear(texture);
            texture.filter = image::Filter::nearest;
            const trace::Sampler nearest(texture);
            for (int k = 0; k < 2000; ++k) {
                const double u = 9 * random.next() - 4;
                const double v = 9 * random.next() - 4;
                EXPECT_EQ(linear.at(u, v), image::sampleBilinear(texture, u * 13, v * 7));
                EXPECT_EQ(nearest.at(u, v), image::sampleNearest(texture, u * 13, v * 7));
            }
        }
    }
}

TEST(Sampler, HoldsTheSourcesOwnBits) {
    EXPECT_EQ(trace::Sampler(noise(13, 7, 255)).bytes(), 13u * 7);
    EXPECT_EQ(trace::Sampler(noise(13, 7, 65535)).bytes(), 2 * 13u * 7);
}

}  // namespace
}  // namespace filigree
