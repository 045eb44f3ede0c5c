#include "filigree/report/map_view.h"

#include "filigree/report/page.h"

#include "report/packed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

MapView sampleView() {
    CellMap map;
    map.level = map.storedLevel = 1;
    map.cells = {1, 1, 1, 1};
    map.finest = {0b11'10'01'00};
    MappedTexture texture;
    texture.name = "</script><b>leaf";
    texture.png = {'f', 'o', 'o'};
    texture.width = texture.height = 16;
    texture.edges = {Edge::mirror, Edge::clamp};
    texture.shownTriangles = texture.maps = 1;
    texture.packedTriangles = packTriangles(std::vector{PlacedTriangle{{0, 0, 1, 0, 0, 1}, 0, 2, 3, 4, 5}});
    texture.packedMaps = packMaps(std::vector{map});
    return {
        {{{"T", {1, 2, 3}}, {"O", {}}, {"UT", {}}, {"UO", {}}}}, {texture}, "A <view>", "filigree inspect"};
}

TEST(ColumnWriter, splitsNumbersIntoPlanesOfBytes) {
    const std::vector<uint32_t> numbers{0x04030201, 0x08070605};
    ColumnWriter columns;
    columns.column(2, [&](size_t k) { return numbers[k]; });
    columns.append(std::vector<uint8_t>{9});
    EXPECT_THAT(columns.bytes(), ElementsAre(1, 5, 2, 6, 3, 7, 4, 8, 9));
}

TEST(MapView, carriesItsPartsAndEndsNoScript) {
    const std::string html = toHtml(sampleView());
    EXPECT_THAT(html, HasSubstr("\\u003c/script>\\u003cb>leaf"));
    EXPECT_THAT(html, Not(HasSubstr("<b>")));
    EXPECT_THAT(html, HasSubstr(R"("wrap":["mirror","clamp"])"));
    EXPECT_THAT(html, HasSubstr("class=\"alpha\">Zm9v</script>"));
    EXPECT_THAT(html, HasSubstr("A &lt;view&gt;"));
    EXPECT_THAT(html, HasSubstr("<code>filigree inspect</code>"));
}

TEST(MapView, sameViewSameBytes) {
    EXPECT_EQ(toHtml(sampleView()), toHtml(sampleView()));
}

TEST(MapView, onlyItsPagesCarryItsScript) {
    Page page;
    page.sections = {{"View", {Paragraph{"none"}}}};
    EXPECT_THAT(toHtml(page), Not(HasSubstr("curveIndex")));
    page.sections[0].blocks.emplace_back(sampleView());
    EXPECT_THAT(toHtml(page), HasSubstr("curveIndex"));
    EXPECT_THAT(toHtml(page), HasSubstr(".map-view"));
}

TEST(Gallery, opensItsFirstItemsAndKeepsPixels) {
    Picture picture{{'f', 'o', 'o'}, 16, 16, "a map", ""};
    picture.pixelated = true;
    Gallery gallery;
    gallery.items = {{"<one>", "90 %", {{picture, "source"}}}, {"two", "", {{picture, "source"}}}};
    Page page;
    page.sections = {{"Maps", {gallery}}};
    const std::string html = toHtml(page);
    EXPECT_THAT(html, HasSubstr("<details class=\"item\" open><summary>&lt;one&gt;<span>90 %</span>"));
    EXPECT_THAT(html, HasSubstr("<details class=\"item\"><summary>two"));
    EXPECT_THAT(html, HasSubstr("height=\"16\" class=\"pixelated\">"));
}

TEST(ChartFigure, isLaidOutForWideAndNarrowWindows) {
    LineChart chart;
    chart.x.whole = true;
    chart.series = {{"flat", {{1, 10}, {8, 20}}}};
    const Figure figure = chartFigure(chart, "Sizes", "");
    ASSERT_TRUE(figure.narrow.has_value());
    EXPECT_LT(figure.narrow->width, std::get<Drawing>(figure.content).width);
    Page page;
    page.sections = {{"Sizes", {figure}}};
    const std::string html = toHtml(page);
    EXPECT_THAT(html, HasSubstr("class=\"narrow\""));
    for (const char* tick : {">1</text>", ">7</text>", ">8</text>"}) EXPECT_THAT(html, HasSubstr(tick));
}

}  // namespace
}  // namespace filigree::report
