#include "filigree/image/extremes.h"

#include "textures.h"

#include <gtest/gtest.h>

namespace filigree::image {
namespace {

TexelRange plainly(const AlphaTexture& t, int64_t x0, int64_t x1, int64_t y0, int64_t y1) {
    TexelRange range;
    for (int64_t y = y0; y <= y1; ++y) {
        for (int64_t x = x0; x <= x1; ++x) {
            const uint16_t texel =
                t.image.at(wrapTexel(x, t.image.width, t.wrapU), wrapTexel(y, t.image.height, t.wrapV));
            range.add({texel, texel});
        }
    }
    return range;
}

// Encloses the texels of the rectangle; and is no wider than those of the rectangle made a little larger.
TEST(TexelExtremes, EncloseEveryRectangle) {
    tests::Random random(1);
    for (int round = 0; round < 400; ++round) {
        const AlphaTexture t = random.texture(1 + random.below(40), 1 + random.below(40));
        const TexelExtremes extremes(t);
        for (int k = 0; k < 20; ++k) {
            const auto x0 = static_cast<int64_t>(random.below(120)) - 60;
            const auto y0 = static_cast<int64_t>(random.below(120)) - 60;
            const int64_t x1 = x0 + random.below(k % 2 == 0 ? 3 : 60);
            const int64_t y1 = y0 + random.below(k % 2 == 0 ? 3 : 60);
            const TexelRange found = extremes.over(x0, x1, y0, y1);
            const TexelRange inside = plainly(t, x0, x1, y0, y1);
            EXPECT_LE(found.least, inside.least);
            EXPECT_GE(found.most, inside.most);
            if (x1 - x0 < 3 && y1 - y0 < 3 && x0 >= 0 && y0 >= 0 && x1 < t.image.width &&
                y1 < t.image.height) {
                EXPECT_EQ(found.least, inside.least);
                EXPECT_EQ(found.most, inside.most);
            }
        }
    }
}

TEST(TexelExtremes, FarAwayCopies) {
    tests::Random random(2);
    for (const Wrap wrap : tests::wraps) {
        AlphaTexture t = random.texture(13, 9);
        t.wrapU = t.wrapV = wrap;
        const TexelExtremes extremes(t);
        const int64_t far = int64_t{26 * 18} << 30;
        for (const int64_t x : {-far - 3, far + 5}) {
            const TexelRange found = extremes.over(x, x + 2, x, x + 2);
            const TexelRange inside = plainly(t, x, x + 2, x, x + 2);
            EXPECT_LE(found.least, inside.least);
            EXPECT_GE(found.most, inside.most);
        }
    }
}

}  // namespace
}  // namespace filigree::image
