#include "filigree/report/table.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::report {
namespace {

using testing::HasSubstr;
using testing::Not;

Table sampleTable() {
    Table table;
    table.caption = "Sizes <by> level";
    table.columns = {{"name", "Name", "", Show::plain, 0},
                     {"bytes", "Data", "", Show::bytes, 0},
                     {"known", "Known", "", Show::share, 0},
                     {"time", "Time", "s", Show::plain, 3}};
    table.rows = {{"leaf, \"big\"", int64_t{2048}, 0.5, 1.25}, {"<b>&", std::monostate{}, NAN, true}};
    return table;
}

TEST(Table, jsonKeepsTypesAndOrder) {
    const auto json = nlohmann::ordered_json::parse(toJson(sampleTable()));
    ASSERT_EQ(json.size(), 2U);
    EXPECT_EQ(json[0].dump(), R"({"name":"leaf, \"big\"","bytes":2048,"known":0.5,"time":1.25})");
    EXPECT_EQ(json[1].dump(), R"({"name":"<b>&","bytes":null,"known":null,"time":true})");
}

TEST(Table, jsonOfBytesThatAreNotUtf8Parses) {
    Table table = sampleTable();
    table.rows[0][0] = "\xFF";
    EXPECT_EQ(nlohmann::json::parse(toJson(table))[0]["name"], "\xEF\xBF\xBD");
}

TEST(Table, csvQuotesWhatItMust) {
    EXPECT_EQ(toCsv(sampleTable()),
              "name,bytes,known,time (s)\r\n"
              "\"leaf, \"\"big\"\"\",2048,0.5,1.25\r\n"
              "<b>&,,,true\r\n");
}

TEST(Table, csvNumbersComeBackExactly) {
    Table table;
    table.columns = {{"x", "X", "", Show::plain, 2}};
    table.rows = {{0.1}, {1.0 / 3}};
    EXPECT_EQ(toCsv(table), "x\r\n0.1\r\n0.3333333333333333\r\n");
}

TEST(Table, htmlShowsUnitsAndEscapes) {
    const std::string html = toHtml(sampleTable());
    EXPECT_THAT(html, HasSubstr("Sizes &lt;by&gt; level"));
    EXPECT_THAT(html, HasSubstr("&lt;b&gt;&amp;"));
    EXPECT_THAT(html, HasSubstr("<td class=\"n\">2.00 KiB</td>"));
    EXPECT_THAT(html, HasSubstr("<td class=\"n\">50.00 %</td>"));
    EXPECT_THAT(html, HasSubstr("Time (s)"));
    EXPECT_THAT(html, Not(HasSubstr("<b>&")));
}

TEST(Table, wholeNumbersGroupByThousands) {
    const Column column{"n", "N", "", Show::plain, 2};
    EXPECT_EQ(cellText(int64_t{-1234567}, column), "-1,234,567");
    EXPECT_EQ(cellText(INT64_MIN, column), "-9,223,372,036,854,775,808");
    EXPECT_EQ(cellText(1234.5, column), "1,234.50");
    EXPECT_EQ(cellText(std::monostate{}, column), "");
}

}  // namespace
}  // namespace filigree::report
