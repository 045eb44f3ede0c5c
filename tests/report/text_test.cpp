#include "report/text.h"

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace filigree::report {
namespace {

const std::string unknown = "\xEF\xBF\xBD";

TEST(Text, keepsValidUtf8) {
    const std::string text = "a\tb \xC3\xA9 \xE2\x82\xAC \xF0\x9F\x8C\xBF";
    EXPECT_EQ(validUtf8(text), text);
}

TEST(Text, replacesWhatIsNotUtf8) {
    EXPECT_EQ(validUtf8("a\xFFz"), "a" + unknown + "z");
    EXPECT_EQ(validUtf8("\xC3"), unknown) << "cut short";
    EXPECT_EQ(validUtf8("\xC0\x80"), unknown + unknown) << "too long a form";
    EXPECT_EQ(validUtf8("\xE0\x80\x80"), unknown + unknown + unknown) << "too long a form";
    EXPECT_EQ(validUtf8("\xED\xA0\x80"), unknown + unknown + unknown) << "a surrogate";
    EXPECT_EQ(validUtf8("\xF4\x90\x80\x80"), unknown + unknown + unknown + unknown) << "beyond U+10FFFF";
    EXPECT_EQ(validUtf8(std::string("\0\x1B", 2)), unknown + unknown) << "control characters";
}

TEST(Text, escapesMarkup) {
    EXPECT_EQ(escapeHtml("<a href=\"x\">'&'</a>"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
}

TEST(Text, base64MatchesRfc4648) {
    const auto of = [](const std::string& text) {
        return base64(std::vector<uint8_t>(text.begin(), text.end()));
    };
    EXPECT_EQ(of(""), "");
    EXPECT_EQ(of("f"), "Zg==");
    EXPECT_EQ(of("fo"), "Zm8=");
    EXPECT_EQ(of("foo"), "Zm9v");
    EXPECT_EQ(of("foobar"), "Zm9vYmFy");
}

TEST(Text, urlsCannotLeaveTheirAttributeOrScheme) {
    EXPECT_EQ(relativeUrl("a/b c.png"), "a/b%20c.png");
    EXPECT_EQ(relativeUrl("javascript:x\"<"), "javascript%3Ax%22%3C");
}

}  // namespace
}  // namespace filigree::report
