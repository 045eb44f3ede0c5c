#include "jobs/canvas.h"

#include "jobs/lettering.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace filigree::jobs {
namespace {

constexpr Colour white{255, 255, 255};
constexpr Colour black{0, 0, 0};

// Pixels that are darker than half.
size_t darkPixels(const Canvas& canvas) {
    size_t count = 0;
    for (uint32_t y = 0; y < canvas.height(); ++y) {
        for (uint32_t x = 0; x < canvas.width(); ++x) count += canvas.at(x, y).r < 128 ? 1 : 0;
    }
    return count;
}

TEST(Spans, trianglesThatShareAnEdgeCoverEachPixelOnce) {
    // A fan about an inner point of a square with odd corners.
    const std::vector<Pixel> rim = {{1.3, 2.1}, {17.9, 0.4}, {19.2, 18.6}, {0.7, 19.5}};
    const Pixel middle{8.37, 11.5};
    std::vector<int> hits(20 * 20);
    for (size_t k = 0; k < rim.size(); ++k) {
        forEachSpan({middle, rim[k], rim[(k + 1) % rim.size()]}, 20, 20,
                    [&](uint32_t y, uint32_t first, uint32_t end) {
                        for (uint32_t x = first; x < end; ++x) ++hits[y * 20 + x];
                    });
    }
    for (size_t y = 4; y < 16; ++y) {
        for (size_t x = 4; x < 16; ++x) EXPECT_EQ(hits[y * 20 + x], 1) << x << ", " << y;
    }
    for (const int n : hits) EXPECT_LE(n, 1);
}

TEST(Spans, stayInsideThePicture) {
    size_t pixels = 0;
    forEachSpan({Pixel{-1e9, -1e9}, Pixel{1e9, -1e9}, Pixel{0, 1e9}}, 7, 5,
                [&](uint32_t y, uint32_t first, uint32_t end) {
                    EXPECT_LT(y, 5U);
                    EXPECT_LE(end, 7U);
                    pixels += end - first;
                });
    EXPECT_EQ(pixels, 35U);
    forEachSpan({Pixel{3, 2}, Pixel{3, 2}, Pixel{3, 2}}, 7, 5, [](uint32_t, uint32_t, uint32_t) { FAIL(); });
}

TEST(Canvas, rectanglesHaveSmoothEdges) {
    Canvas canvas(4, 1, white);
    canvas.fillRect(0.5, 0, 2, 1, black);
    EXPECT_NEAR(canvas.at(0, 0).r, 128, 1);
    EXPECT_EQ(canvas.at(1, 0), black);
    EXPECT_NEAR(canvas.at(2, 0).r, 128, 1);
    EXPECT_EQ(canvas.at(3, 0), white);
}

TEST(Canvas, linesAreAsWideAsAskedInEveryDirection) {
    for (const Pixel to : {Pixel{90, 10}, Pixel{10, 90}, Pixel{90, 87}, Pixel{90, 40}}) {
        Canvas canvas(100, 100, white);
        canvas.strokeLine({10.2, 10.4}, to, 4, black);
        const double length = std::hypot(to.x - 10.2, to.y - 10.4);
        EXPECT_NEAR(static_cast<double>(darkPixels(canvas)), 4 * length + 12.6, 0.06 * 4 * length);
    }
}

TEST(Canvas, whatLiesOutsideIsCut) {
    Canvas canvas(5, 5, white);
    canvas.strokeLine({-100, 2.5}, {100, 2.5}, 1, black);
    canvas.fillRect(-10, -10, 5, 5, black);
    canvas.fillDot({50, 50}, 10, black);
    EXPECT_EQ(darkPixels(canvas), 5U);
}

TEST(Lettering, everyCharacterDrawsInsideItsWidth) {
    for (char c = '!'; c <= '~'; ++c) {
        Canvas canvas(80, 80, white);
        drawText(canvas, std::string(1, c), {20, 50}, 40, report::Anchor::start, black);
        EXPECT_GT(darkPixels(canvas), 5U) << c;
        for (uint32_t y = 0; y < 80; ++y) {
            EXPECT_EQ(canvas.at(17, y), white) << c;
            EXPECT_EQ(canvas.at(static_cast<uint32_t>(27 + letteringWidth(std::string(1, c), 40)), y), white)
                << c;
        }
    }
}

TEST(Lettering, charactersDiffer) {
    std::vector<std::vector<uint8_t>> pictures;
    for (char c = '!'; c <= '~'; ++c) {
        Canvas canvas(48, 64, white);
        drawText(canvas, std::string(1, c), {8, 44}, 40, report::Anchor::start, black);
        std::vector<uint8_t> pixels;
        for (uint32_t i = 0; i < 48 * 64; ++i) pixels.push_back(canvas.at(i % 48, i / 48).r);
        for (const auto& other : pictures) EXPECT_NE(pixels, other) << c;
        pictures.push_back(std::move(pixels));
    }
}

TEST(Lettering, anchorsMoveTheText) {
    const double width = letteringWidth("level", 20);
    EXPECT_GT(width, 30);
    Canvas start(200, 40, white);
    Canvas end(200, 40, white);
    drawText(start, "level", {100 - width, 30}, 20, report::Anchor::start, black);
    drawText(end, "level", {100, 30}, 20, report::Anchor::end, black);
    for (uint32_t i = 0; i < 200 * 40; ++i) {
        EXPECT_NEAR(start.at(i % 200, i / 200).r, end.at(i % 200, i / 200).r, 2);
    }
}

TEST(Lettering, charactersBeyondAsciiShowAsOneMark) {
    EXPECT_EQ(letteringWidth("\xC3\xA9", 20), letteringWidth("?", 20));
}

}  // namespace
}  // namespace filigree::jobs
