#include "filigree/report/page.h"

#include "filigree/report/chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::report {
namespace {

using testing::HasSubstr;
using testing::Not;

Page samplePage() {
    Table table;
    table.caption = "Counts";
    table.columns = {{"n", "N", "", Show::plain, 0}};
    table.rows = {{int64_t{1234}}};
    Picture picture;
    picture.png = {'f', 'o', 'o'};
    picture.width = 640;
    picture.height = 480;
    picture.alt = "states over \"leaf\"";
    picture.file = "overlay leaf.png";
    Page page;
    page.title = "Maps of <leaf>";
    page.lead = "One & all";
    page.sections = {
        {"First", {Paragraph{"a < b"}, table, Figure{picture, "Overlay", "filigree inspect 'a<b>.glb'"}}},
        {"Second", {Legend{{{{1, 2, 255}, "opaque"}}}, Links{{{"scene.glb", "the scene"}}}}},
        {"Third", {FigureRow{{{layOut(BarChart{}), "Bars", ""}}}}}};
    return page;
}

TEST(Page, holdsEverythingItself) {
    const std::string html = toHtml(samplePage());
    EXPECT_TRUE(html.starts_with("<!DOCTYPE html>"));
    EXPECT_THAT(html, HasSubstr("src=\"data:image/png;base64,Zm9v\""));
    EXPECT_THAT(html, HasSubstr("width=\"640\" height=\"480\""));
    EXPECT_THAT(html, HasSubstr("default-src 'none'"));
    EXPECT_THAT(html, Not(HasSubstr("src=\"http")));
    EXPECT_THAT(html, Not(HasSubstr("href=\"http")));
    EXPECT_THAT(html, Not(HasSubstr("@import")));
}

TEST(Page, escapesEveryText) {
    const std::string html = toHtml(samplePage());
    EXPECT_THAT(html, HasSubstr("<title>Maps of &lt;leaf&gt;</title>"));
    EXPECT_THAT(html, HasSubstr("One &amp; all"));
    EXPECT_THAT(html, HasSubstr("a &lt; b"));
    EXPECT_THAT(html, HasSubstr("alt=\"states over &quot;leaf&quot;\""));
    EXPECT_THAT(html, HasSubstr("<code>filigree inspect &#39;a&lt;b&gt;.glb&#39;</code>"));
    EXPECT_THAT(html, HasSubstr("href=\"overlay%20leaf.png\""));
    EXPECT_THAT(html, HasSubstr("background:#0102ff"));
}

TEST(Page, listsItsSections) {
    const std::string html = toHtml(samplePage());
    EXPECT_THAT(html, HasSubstr("<a href=\"#s3\">Third</a>"));
    EXPECT_THAT(html, HasSubstr("<section id=\"s3\">"));
    Page small = samplePage();
    small.sections.resize(1);
    EXPECT_THAT(toHtml(small), Not(HasSubstr("<nav>")));
}

TEST(Page, tablesCarryTheirCsv) {
    const std::string html = toHtml(samplePage());
    EXPECT_THAT(html, HasSubstr("<tr data-csv=\"1234\"><td class=\"n\">1,234</td>"));
    EXPECT_THAT(html, HasSubstr("<thead><tr data-csv=\"n\">"));
}

TEST(Page, picturesCarryTheirScale) {
    Page page = samplePage();
    auto& figure = std::get<Figure>(page.sections[0].blocks[2]);
    EXPECT_THAT(toHtml(page), Not(HasSubstr("class=\"scale\"")));
    figure.scale = ColourScale{"error (%)", {{1, 2, 3}, {4, 5, 6}}, {{0, "none"}, {1, "all"}}};
    const std::string html = toHtml(page);
    EXPECT_THAT(html, HasSubstr("class=\"scale\""));
    EXPECT_THAT(html, HasSubstr("error (%)"));
    EXPECT_THAT(html, HasSubstr("none"));
}

TEST(Page, aRowSaysItsCommandOnce) {
    const auto codes = [](const std::vector<Figure>& figures) {
        Page page;
        page.sections = {{"", {FigureRow{figures}}}};
        const std::string html = toHtml(page);
        size_t count = 0;
        for (size_t at = html.find("<code>"); at != std::string::npos; at = html.find("<code>", at + 1))
            ++count;
        return count;
    };
    const auto figure = [](const char* command) { return Figure{layOut(BarChart{}), "Bars", command}; };
    EXPECT_EQ(codes({figure("a"), figure("a"), figure("a")}), 1U);
    EXPECT_EQ(codes({figure("a"), figure("b"), figure("")}), 2U);
    EXPECT_EQ(codes({}), 0U);
}

TEST(Page, picturesTooLargeToEmbedAreLinked) {
    Page page;
    page.sections = {{"", {Figure{Picture{{}, 0, 0, "", "big.png"}, "Big", ""}}}};
    EXPECT_THAT(toHtml(page), HasSubstr("<a href=\"big.png\">big.png</a>"));
}

}  // namespace
}  // namespace filigree::report
