#include "io/uri.h"

#include <gtest/gtest.h>

namespace filigree::tests {
namespace {

TEST(Uri, RoundTripsData) {
    for (size_t size = 0; size < 20; ++size) {
        std::vector<uint8_t> bytes;
        for (size_t i = 0; i < size; ++i) bytes.push_back(static_cast<uint8_t>(i * 91 + size));
        const std::string uri = io::makeDataUri("application/octet-stream", bytes);
        EXPECT_TRUE(io::isDataUri(uri));
        const auto decoded = io::decodeDataUri(uri);
        ASSERT_TRUE(decoded) << decoded.error().message;
        EXPECT_EQ(*decoded, bytes);
    }
    EXPECT_EQ(io::makeDataUri("a/b", std::vector<uint8_t>{'M', 'a'}), "data:a/b;base64,TWE=");
}

TEST(Uri, RejectsBrokenData) {
    for (const char* uri : {"data:", "data:a/b,plain", "data:a/b;base64,A", "data:a/b;base64,AB*D"}) {
        EXPECT_FALSE(io::decodeDataUri(uri)) << uri;
    }
}

TEST(Uri, RoundTripsPaths) {
    for (const char* path : {"leaf.png", "../a b/ü%.bin", "x/y:z", "q?#[]"}) {
        const auto decoded = io::pathOfUri("./" + io::uriOfPath(path));
        ASSERT_TRUE(decoded) << path;
        EXPECT_EQ(decoded->string(), "./" + std::string(path));
    }
    EXPECT_EQ(io::uriOfPath("a b.png"), "a%20b.png");
}

TEST(Uri, RejectsWhatIsNoRelativePath) {
    for (const char* uri :
         {"", "http://x/y", "file:///etc/passwd", "/etc/passwd", "%2Fetc", "a%2", "a%zz", "a%00b"}) {
        EXPECT_FALSE(io::pathOfUri(uri)) << uri;
    }
}

}  // namespace
}  // namespace filigree::tests
