// Files cut short, padded and with bits flipped: an error, never a crash. Each copy is allocated anew, so
// that the sanitizers see every read past its end.
#include "filigree/core/bytes.h"
#include "filigree/io/gltf_rules.h"

#include "io/json.h"
#include "sample_gltf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::tests {
namespace {

using testing::HasSubstr;

Status readAll(std::vector<uint8_t> bytes) {
    bytes.shrink_to_fit();
    const Result<io::GltfDocument> document =
        io::GltfDocument::parse(std::move(bytes), "/nonexistent", "broken");
    if (!document) return document.error();
    static_cast<void>(io::checkRules(*document));
    io::ReadOptions options;
    options.maxBytes = 1 << 24;
    const Result<scene::Scene> scene = io::readScene(*document, options);
    return scene ? Status() : Status(scene.error());
}

TEST(BrokenFiles, EveryPrefixOfAGlbFails) {
    const std::vector<uint8_t> whole = sampleWithMicromaps();
    ASSERT_TRUE(readAll(whole));
    for (size_t size = 0; size < whole.size(); ++size) {
        EXPECT_FALSE(readAll({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)})) << size;
    }
}

TEST(BrokenFiles, EveryPrefixWithItsLengthsMadeRightIsSafe) {
    const std::vector<uint8_t> whole = sampleWithMicromaps();
    const size_t binary = 20 + loadLe<uint32_t>(whole.data() + 12);
    for (size_t size = binary + 8; size < whole.size(); size += 4) {
        std::vector<uint8_t> cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
        storeLe(cut.data() + 8, static_cast<uint32_t>(size));
        storeLe(cut.data() + binary, static_cast<uint32_t>(size - binary - 8));
        const Status status = readAll(cut);
        ASSERT_FALSE(status) << size;
        EXPECT_THAT(status.error().message, HasSubstr("/buffers/0/byteLength"));
    }
}

TEST(BrokenFiles, EveryPrefixOfTextFails) {
    const std::string whole = SampleGltf::maskedQuad().gltf();
    for (size_t size = 0; size < whole.size(); ++size) {
        EXPECT_FALSE(readAll({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)})) << size;
    }
}

TEST(BrokenFiles, SurplusBytesFail) {
    std::vector<uint8_t> bytes = sampleWithMicromaps();
    bytes.push_back(0);
    const Status status = readAll(bytes);
    ASSERT_FALSE(status);
    EXPECT_THAT(status.error().message, HasSubstr("GLB at byte 8: length"));
}

TEST(BrokenFiles, FlippedBitsAreSafe) {
    const std::vector<uint8_t> whole = sampleWithMicromaps();
    for (size_t bit = 0; bit < whole.size() * 8; ++bit) {
        std::vector<uint8_t> flipped = whole;
        flipped[bit / 8] ^= static_cast<uint8_t>(1U << (bit % 8));
        static_cast<void>(readAll(flipped));
    }
}

TEST(BrokenFiles, BadHeadersFail) {
    std::vector<uint8_t> version = sampleWithMicromaps();
    version[4] = 1;
    EXPECT_THAT(readAll(version).error().message, HasSubstr("version 1, expected 2"));
    std::vector<uint8_t> chunk = sampleWithMicromaps();
    storeLe(chunk.data() + 12, uint32_t{0xFFFFFFFC});
    EXPECT_THAT(readAll(chunk).error().message, HasSubstr("a chunk of 4294967292 bytes"));
    std::vector<uint8_t> type = sampleWithMicromaps();
    type[16] = 'X';
    EXPECT_THAT(readAll(type).error().message, HasSubstr("the first chunk and no other must be JSON"));
}

TEST(BrokenFiles, HugeClaimsFail) {
    SampleGltf sample = SampleGltf::maskedQuad();
    sample.json["bufferViews"][0]["byteLength"] = uint64_t{4} << 30;
    EXPECT_THAT(readAll(sample.glb()).error().message, HasSubstr("/bufferViews/0"));
    SampleGltf count = SampleGltf::maskedQuad();
    count.json["accessors"][0]["count"] = uint64_t{1} << 53;
    EXPECT_THAT(readAll(count.glb()).error().message, HasSubstr("/accessors/0"));
}

TEST(Json, BoundsDepthAndMembers) {
    const std::string deep = std::string(io::maxJsonDepth + 1, '[') + std::string(io::maxJsonDepth + 1, ']');
    EXPECT_FALSE(io::parseJson(deep));
    EXPECT_TRUE(io::parseJson(std::string_view(deep).substr(1, deep.size() - 2)));
    std::string wide = "{\"k\": 0";
    for (size_t i = 0; i < io::maxJsonMembers; ++i) wide += ",\"k" + std::to_string(i) + "\":0";
    EXPECT_FALSE(io::parseJson(wide + "}"));
    EXPECT_TRUE(io::parseJson(R"({"braces": "[[[[{{{{\"[["})"));
}

}  // namespace
}  // namespace filigree::tests
