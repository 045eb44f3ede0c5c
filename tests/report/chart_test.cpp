#include "filigree/report/chart.h"

#include "filigree/report/colour_scale.h"

#include "report/scale.h"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

template <class T>
std::vector<T> shapesOf(const Drawing& drawing) {
    std::vector<T> found;
    for (const Shape& shape : drawing.shapes) {
        if (const T* s = std::get_if<T>(&shape)) found.push_back(*s);
    }
    return found;
}

BarChart levels() {
    BarChart chart;
    chart.title = "Micromaps by level";
    chart.x = {"level", ""};
    chart.y = {"micromaps", ""};
    chart.categories = {"0", "1", "2"};
    chart.series = {{"", {10, 40, 0}}};
    return chart;
}

// Bars and texts stay inside the picture, with the widths that textWidth promises.
void expectInside(const Drawing& drawing) {
    for (const Rect& r : shapesOf<Rect>(drawing)) {
        EXPECT_GE(r.x, 0);
        EXPECT_GE(r.y, 0);
        EXPECT_LE(r.x + r.width, drawing.width);
        EXPECT_LE(r.y + r.height, drawing.height);
    }
    for (const Text& t : shapesOf<Text>(drawing)) {
        if (t.upward) continue;
        const double width = textWidth(t.text, t.size);
        const double shift = t.anchor == Anchor::start ? 0 : t.anchor == Anchor::middle ? 0.5 : 1;
        EXPECT_GE(t.x - shift * width, 0) << t.text;
        EXPECT_LE(t.x + (1 - shift) * width, drawing.width) << t.text;
        EXPECT_LE(t.y, drawing.height) << t.text;
        EXPECT_GE(t.y - t.size, 0) << t.text;
    }
}

TEST(Scale, linearTicksAreRound) {
    EXPECT_THAT(Scale(0, 10, false).ticks(), ElementsAre(0, 2, 4, 6, 8, 10));
    EXPECT_THAT(Scale(0, 0, false).ticks(), testing::Contains(0));
    EXPECT_DOUBLE_EQ(Scale(0, 10, false).at(5), 0.5);
}

TEST(Scale, logarithmicTicksAreDecades) {
    const Scale scale(3, 4000, true);
    ASSERT_EQ(scale.ticks().size(), 5U);
    EXPECT_DOUBLE_EQ(scale.ticks().front(), 1);
    EXPECT_DOUBLE_EQ(scale.ticks().back(), 10000);
    EXPECT_NEAR(scale.at(100), 0.5, 1e-12);
    EXPECT_LE(Scale(1e-9, 1e9, true).ticks().size(), 10U);
}

TEST(Chart, barsAreAsHighAsTheirValues) {
    const Drawing drawing = layOut(levels());
    const auto bars = shapesOf<Rect>(drawing);
    ASSERT_EQ(bars.size(), 2U) << "a value of 0 has no bar";
    EXPECT_NEAR(bars[1].height, 4 * bars[0].height, 1e-9);
    EXPECT_NEAR(bars[0].y + bars[0].height, bars[1].y + bars[1].height, 1e-9);
    expectInside(drawing);
}

TEST(Chart, logarithmicBarsShowTheLeastValueToo) {
    BarChart chart = levels();
    chart.y.log = true;
    chart.series[0].values = {1, 1000000, 0};
    const Drawing drawing = layOut(chart);
    const auto bars = shapesOf<Rect>(drawing);
    ASSERT_EQ(bars.size(), 2U);
    EXPECT_GT(bars[0].height, 5);
    expectInside(drawing);
}

TEST(Chart, stackedBarsStandOnEachOther) {
    BarChart chart = levels();
    chart.stacked = true;
    chart.series = {{"a", {1, 2, 3}}, {"b", {3, 2, 1}}};
    auto bars = shapesOf<Rect>(layOut(chart));
    bars.erase(bars.begin(), bars.begin() + 2);  // the legend's
    ASSERT_EQ(bars.size(), 6U);
    EXPECT_NEAR(bars[1].y + bars[1].height, bars[0].y, 1e-9);
    EXPECT_NEAR(bars[1].y, bars[3].y, 1e-9);
}

TEST(Chart, longNamesAndManyCategoriesStayInside) {
    BarChart chart = levels();
    chart.title = std::string(300, 'M');
    chart.categories = {std::string(200, 'a'), "b", "c"};
    chart.series[0].name = std::string(200, 's');
    expectInside(layOut(chart));
    chart.categories.assign(300, "12345");
    chart.series[0].values.assign(300, 1e9);
    expectInside(layOut(chart));
}

TEST(Chart, shortNamesStandInTwoRows) {
    BarChart chart = levels();
    chart.x = {};
    chart.categories.assign(14, "micromap");
    chart.series[0].values.assign(14, 3);
    const Drawing drawing = layOut(chart);
    const auto texts = shapesOf<Text>(drawing);
    EXPECT_EQ(std::ranges::count(texts, "micromap", &Text::text), 14);
    expectInside(drawing);
    chart.x = {"method"};
    const auto thinned = shapesOf<Text>(layOut(chart));
    EXPECT_EQ(std::ranges::count(thinned, "micromap", &Text::text), 7);
}

TEST(Chart, badNumbersAreLeftOut) {
    BarChart chart = levels();
    chart.series[0].values = {NAN, INFINITY, 3};
    EXPECT_EQ(shapesOf<Rect>(layOut(chart)).size(), 1U);
    LineChart lines;
    lines.series = {{"", {{1, NAN}, {NAN, 1}, {2, 5}}}};
    EXPECT_EQ(shapesOf<Dot>(layOut(lines)).size(), 1U);
}

TEST(Chart, emptyChartsSayThatThereIsNoData) {
    EXPECT_THAT(toSvg(layOut(BarChart{})), HasSubstr("no data"));
    EXPECT_THAT(toSvg(layOut(LineChart{})), HasSubstr("no data"));
    BarChart zeros = levels();
    zeros.y.log = true;
    zeros.series[0].values = {0, 0, 0};
    EXPECT_THAT(toSvg(layOut(zeros)), HasSubstr("no data"));
}

TEST(Chart, linesRiseWithTheirValues) {
    LineChart chart;
    chart.x = {"level", "", true};
    chart.y = {"size", "bytes", true};
    chart.series = {{"flat", {{1, 10}, {10, 100}, {100, 1000}}, seriesColour(0)},
                    {"tree", {{1, 10}, {100, 100}}, seriesColour(1), true}};
    const Drawing drawing = layOut(chart);
    const auto lines = shapesOf<Polyline>(drawing);
    ASSERT_EQ(lines.size(), 4U) << "two of the legend, two of the data";
    const auto& p = lines[2].points;
    EXPECT_NEAR(p[0].second - p[1].second, p[1].second - p[2].second, 1e-9);
    EXPECT_GT(p[0].second, p[2].second);
    expectInside(drawing);
    EXPECT_THAT(toSvg(drawing), HasSubstr("size (bytes)"));
}

TEST(Chart, dotsLieByBothMeasures) {
    ScatterChart chart;
    chart.x = {"bytes", "", true};
    chart.y = {"speed"};
    chart.series = {{"lattice", {{1, 10, "torus"}, {100, 20}, {NAN, 3}, {-1, 3}}, seriesColour(2)}};
    const Drawing drawing = layOut(chart);
    const auto dots = shapesOf<Dot>(drawing);
    ASSERT_EQ(dots.size(), 3U) << "the legend's, and two of the data";
    EXPECT_LT(dots[1].x, dots[2].x);
    EXPECT_GT(dots[1].y, dots[2].y);
    EXPECT_EQ(dots[1].hint, "lattice, torus: 1, 10");
    EXPECT_EQ(dots[2].hint, "lattice: 100, 20");
    expectInside(drawing);
    EXPECT_THAT(toSvg(drawing), Not(HasSubstr("fill-opacity")));
    chart.series[0].hollow = true;
    EXPECT_THAT(toSvg(layOut(chart)), HasSubstr("fill-opacity"));
    chart.series[0].points.resize(0);
    EXPECT_THAT(toSvg(layOut(chart)), HasSubstr("no data"));
}

ColourScale greys() {
    return {"error, % of the diagonal",
            {{0, 0, 0}, {100, 100, 100}, {200, 100, 0}},
            {{0, "0"}, {0.5, "1"}, {1, "4"}},
            "mean 0.2"};
}

TEST(ColourScale, blendsItsColours) {
    EXPECT_EQ(colourAt(greys(), 0.25), (Colour{50, 50, 50}));
    EXPECT_EQ(colourAt(greys(), 0.75), (Colour{150, 100, 50}));
    EXPECT_EQ(colourAt(greys(), -3), (Colour{0, 0, 0}));
    EXPECT_EQ(colourAt(greys(), 3), (Colour{200, 100, 0}));
}

TEST(ColourScale, staysInside) {
    const Drawing drawing = layOut(greys());
    expectInside(drawing);
    const auto rects = shapesOf<Rect>(drawing);
    EXPECT_GT(rects.size(), 32U);
    EXPECT_NEAR(rects.back().x + rects.back().width, drawing.width - 1, 0.01);
    EXPECT_EQ(shapesOf<Text>(drawing).size(), 5U);
}

TEST(Svg, escapesAndFollowsTheTheme) {
    BarChart chart = levels();
    chart.title = "<script>&";
    const std::string svg = toSvg(layOut(chart));
    EXPECT_THAT(svg, Not(HasSubstr("<script>")));
    EXPECT_THAT(svg, HasSubstr("&lt;script&gt;&amp;"));
    EXPECT_THAT(svg, HasSubstr("prefers-color-scheme:dark"));
    EXPECT_THAT(svg, HasSubstr("viewBox=\"0 0 640 360\""));
    EXPECT_EQ(svg, toSvg(layOut(chart)));
}

}  // namespace
}  // namespace filigree::report
