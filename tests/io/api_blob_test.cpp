#include "filigree/io/api_blob.h"

#include "filigree/core/file.h"

#include "io/json.h"
#include "sample_gltf.h"
#include "temp_folder.h"

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::tests {
namespace {

class ApiBlobs : public testing::Test {
  protected:
    void SetUp() override {
        output_.micromaps.push_back({"leaf", &set_, {}});
        output_.primitives.push_back({0, 1, 0, indices_, vertices_});
        const Status status = io::writeApiBlobs(blobs(), output_, "leaf.glb");
        ASSERT_TRUE(status) << status.error().message;
    }
    [[nodiscard]] std::filesystem::path blobs() const { return folder_ / "raw"; }
    [[nodiscard]] std::vector<uint8_t> bytes(const std::string& name) const {
        return readFile(blobs() / name).value();
    }
    [[nodiscard]] std::vector<std::string> brokenRules() const {
        const Result<std::vector<io::Breach>> breaches = io::checkApiBlobs(blobs());
        EXPECT_TRUE(breaches) << breaches.error().message;
        std::vector<std::string> rules;
        for (const io::Breach& breach : *breaches) rules.push_back(breach.rule);
        return rules;
    }
    void patch(const std::string& name, size_t at, uint8_t value) const {
        std::vector<uint8_t> content = bytes(name);
        content.at(at) = value;
        ASSERT_TRUE(writeFile(blobs() / name, content));
    }
    void editManifest(const std::function<void(io::Json&)>& edit) const {
        const std::vector<uint8_t> text = bytes("manifest.json");
        io::Json json = io::Json::parse(text.begin(), text.end());
        edit(json);
        ASSERT_TRUE(writeFile(blobs() / "manifest.json", json.dump()));
    }

    TempFolder folder_;
    micromap::FlatSet set_ = sampleSet(2, 3);
    std::vector<int32_t> indices_{2, -1, 0, 2, -4};
    std::vector<uint32_t> vertices_ = std::vector<uint32_t>(15, 7);
    io::MicromapOutput output_;
};

TEST_F(ApiBlobs, AreWhatTheApisTake) {
    EXPECT_EQ(bytes("micromap_0.data.bin"), set_.data);
    EXPECT_EQ(bytes("micromap_0.records.bin"),
              (std::vector<uint8_t>{0, 0, 0, 0, 2, 0, 2, 0, 4, 0, 0, 0, 2, 0, 2, 0, 8, 0, 0, 0, 2, 0, 2, 0}));
    EXPECT_EQ(bytes("mesh_0_primitive_1.indices.bin"), (std::vector<uint8_t>{2, 0xFF, 0, 2, 0xFC}));
    EXPECT_EQ(bytes("mesh_0_primitive_1.vertices.bin").size(), 60U);
    const std::vector<uint8_t> text = bytes("manifest.json");
    const io::Json manifest = io::Json::parse(text.begin(), text.end());
    EXPECT_EQ(manifest["micromaps"][0]["usageCounts"][0]["count"], 3);
    EXPECT_EQ(manifest["primitives"][0]["usageCounts"][0]["count"], 3);
    EXPECT_EQ(manifest["primitives"][0]["indices"]["vulkanIndexType"], "VK_INDEX_TYPE_UINT8");
    EXPECT_TRUE(brokenRules().empty());
}

TEST_F(ApiBlobs, ReplaceAnEarlierFolderAndNoOther) {
    set_ = sampleSet(1, 3);
    ASSERT_TRUE(io::writeApiBlobs(blobs().string() + "/", output_, "leaf.glb"));
    EXPECT_EQ(bytes("micromap_0.data.bin"), set_.data);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
    ASSERT_TRUE(writeFile(folder_ / "precious.txt", "do not lose"));
    EXPECT_FALSE(io::writeApiBlobs(folder_.path(), output_, "leaf.glb"));
    EXPECT_FALSE(io::writeApiBlobs(folder_ / "no/such/raw", output_, "leaf.glb"));
    EXPECT_TRUE(std::filesystem::exists(folder_ / "precious.txt"));
}

TEST_F(ApiBlobs, AreJudged) {
    const auto expect = [&](const std::string& rule) { EXPECT_THAT(brokenRules(), testing::Contains(rule)); };
    patch("micromap_0.records.bin", 4, 13);
    expect("raw-records");
    patch("micromap_0.records.bin", 4, 2);
    patch("micromap_0.records.bin", 8, 2);
    expect("raw-record-overlap");
    patch("micromap_0.records.bin", 8, 4);
    EXPECT_TRUE(brokenRules().empty());
    patch("mesh_0_primitive_1.indices.bin", 0, 3);
    expect("raw-index-value");
    patch("mesh_0_primitive_1.indices.bin", 0, 0xFF);
    expect("raw-usage");
    patch("mesh_0_primitive_1.indices.bin", 0, 2);
    editManifest([](io::Json& m) { m["primitives"][0]["triangles"] = 4; });
    expect("raw-index-count");
    editManifest([](io::Json& m) { m["primitives"][0]["indices"]["stride"] = 2; });
    expect("raw-index-type");
    editManifest([](io::Json& m) { m["micromaps"][0]["test"]["version"] = 9; });
    expect("raw-test");
    editManifest([](io::Json& m) { m["micromaps"][0]["data"]["bytes"] = 11; });
    expect("raw-file");
    editManifest([](io::Json& m) { m["micromaps"][0]["data"]["file"] = "../raw/micromap_0.data.bin"; });
    expect("raw-file");
    editManifest([](io::Json& m) { m["version"] = 2; });
    expect("raw-manifest");
    std::filesystem::remove(blobs() / "manifest.json");
    EXPECT_FALSE(io::checkApiBlobs(blobs()));
}

}  // namespace
}  // namespace filigree::tests
