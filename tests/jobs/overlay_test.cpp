#include "jobs/overlay.h"

#include "jobs/small_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

namespace filigree::jobs {
namespace {

using micromap::Format;
using micromap::State;

image::AlphaTexture halvesTexture(image::Wrap wrap) {
    return {*tests::halves().alpha, wrap, wrap, image::Filter::linear};
}

// Lower left and upper right half of the unit square, moved by (u, v).
OverlayTriangle lower(float u, float v, int32_t index, const micromap::FlatSet* set = nullptr) {
    return {{mesh::Uv{u, v}, mesh::Uv{u + 1, v + 1}, mesh::Uv{u, v + 1}}, set, index};
}

int32_t special(State state) {
    return micromap::specialIndex(state);
}

// Which state's colour a pixel is nearest to, whatever the alpha below.
State stateAt(const Canvas& canvas, double u, double v) {
    const Colour c = canvas.at(static_cast<uint32_t>(u * 1024), static_cast<uint32_t>(v * 1024));
    State best = State::transparent;
    int least = std::numeric_limits<int>::max();
    for (const State s :
         {State::transparent, State::opaque, State::unknownTransparent, State::unknownOpaque}) {
        for (const uint8_t grey : {uint8_t{40}, uint8_t{255}}) {
            const Colour k = mixed({grey, grey, grey}, stateColour(s), 0.72);
            const int distance = std::abs(k.r - c.r) + std::abs(k.g - c.g) + std::abs(k.b - c.b);
            if (distance < least) best = s;
            least = std::min(least, distance);
        }
    }
    return best;
}

bool isGrey(const Canvas& canvas, double u, double v) {
    const Colour c = canvas.at(static_cast<uint32_t>(u * 1024), static_cast<uint32_t>(v * 1024));
    return c.r == c.g && c.g == c.b;
}

Overlay draw(const std::vector<OverlayTriangle>& triangles, image::Wrap wrap = image::Wrap::repeat) {
    return drawOverlay(halvesTexture(wrap), 1, triangles, {"halves", {0.25, 0.25, 0.25, 0.25}});
}

TEST(Overlay, showsTheAlphaInGrey) {
    const Overlay overlay = draw({});
    EXPECT_EQ(overlay.canvas.width(), 1024U);
    EXPECT_GT(overlay.canvas.height(), 1024U) << "the legend stands below";
    EXPECT_EQ(overlay.canvas.at(256, 512).r, 255);
    EXPECT_EQ(overlay.canvas.at(768, 512).r, 40);
    EXPECT_TRUE(isGrey(overlay.canvas, 0.75, 0.5));
}

TEST(Overlay, specialIndicesFillTheTriangle) {
    for (const State s :
         {State::transparent, State::opaque, State::unknownTransparent, State::unknownOpaque}) {
        const Overlay overlay = draw({lower(0, 0, special(s))});
        EXPECT_EQ(overlay.drawn, 1U);
        EXPECT_EQ(stateAt(overlay.canvas, 0.3, 0.8), s);
        EXPECT_TRUE(isGrey(overlay.canvas, 0.8, 0.3)) << "the other half stays bare";
    }
}

TEST(Overlay, microTrianglesLieWhereTheCurvePutsThem) {
    // Level 1: children 0, 1 (middle), 2, 3 are T, O, UT, UO.
    micromap::FlatSet set;
    set.data = {0b11'10'01'00};
    set.records = {{0, 1, Format::fourState}};
    const Overlay overlay = draw({lower(0, 0, 0, &set)});
    EXPECT_EQ(stateAt(overlay.canvas, 0.1, 0.3), State::transparent) << "at vertex 0";
    EXPECT_EQ(stateAt(overlay.canvas, 0.35, 0.68), State::opaque) << "in the middle";
    EXPECT_EQ(stateAt(overlay.canvas, 0.7, 0.9), State::unknownTransparent) << "at vertex 1";
    EXPECT_EQ(stateAt(overlay.canvas, 0.1, 0.8), State::unknownOpaque) << "at vertex 2";
}

TEST(Overlay, repeatBringsTrianglesBackIntoTheTile) {
    const Overlay overlay = draw({lower(-7, 12, special(State::opaque))});
    EXPECT_EQ(stateAt(overlay.canvas, 0.3, 0.8), State::opaque);
    EXPECT_TRUE(isGrey(overlay.canvas, 0.8, 0.3));
}

TEST(Overlay, mirroredRepeatTurnsEverySecondTile) {
    const Overlay overlay = draw({lower(1, 0, special(State::opaque))}, image::Wrap::mirroredRepeat);
    EXPECT_EQ(stateAt(overlay.canvas, 0.7, 0.8), State::opaque);
    EXPECT_TRUE(isGrey(overlay.canvas, 0.2, 0.3));
}

TEST(Overlay, clampToEdgeCutsAtTheTile) {
    const Overlay overlay = draw({lower(1, 0, special(State::opaque))}, image::Wrap::clampToEdge);
    EXPECT_TRUE(isGrey(overlay.canvas, 0.3, 0.8));
}

TEST(Overlay, laterTrianglesLieOnTop) {
    const Overlay overlay =
        draw({lower(0, 0, special(State::opaque)), lower(0, 0, special(State::unknownTransparent))});
    EXPECT_EQ(stateAt(overlay.canvas, 0.3, 0.8), State::unknownTransparent);
}

TEST(Overlay, badTrianglesArePassedOver) {
    OverlayTriangle nan = lower(0, 0, special(State::opaque));
    nan.uv[0].u = NAN;
    OverlayTriangle infinite = lower(0, 0, special(State::opaque));
    infinite.uv[1].v = INFINITY;
    const Overlay overlay = draw({nan, infinite, lower(3e30F, 0, special(State::opaque))});
    EXPECT_EQ(overlay.drawn, 3U);
    EXPECT_TRUE(isGrey(overlay.canvas, 0.3, 0.8));
}

TEST(Overlay, hugeScenesStopEarly) {
    // Each covers 64 x 64 tiles, so that all of them would take minutes.
    const OverlayTriangle large{
        {mesh::Uv{0, 0}, mesh::Uv{500, 0}, mesh::Uv{0, 500}}, nullptr, special(State::opaque)};
    const Overlay overlay = draw(std::vector<OverlayTriangle>(1000, large));
    EXPECT_LT(overlay.drawn, 1000U);
}

TEST(Overlay, tinyAndOddTexturesHaveAPicture) {
    for (const auto& [width, height] : {std::pair{1U, 1U}, std::pair{3U, 700U}, std::pair{5000U, 2U}}) {
        image::AlphaTexture texture = halvesTexture(image::Wrap::repeat);
        texture.image =
            image::AlphaImage{width, height, std::vector<uint16_t>(size_t{width} * height, 65535), 255};
        const Overlay overlay = drawOverlay(texture, 1, {lower(0, 0, special(State::opaque))}, {"odd", {}});
        EXPECT_LE(overlay.canvas.width(), 2500U);
        EXPECT_TRUE(overlay.canvas.png().ok());
    }
}

}  // namespace
}  // namespace filigree::jobs
