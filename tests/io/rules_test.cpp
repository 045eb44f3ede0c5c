// Every rule of docs/spec/gltf.md, broken once.
#include "filigree/io/gltf_rules.h"

#include "io/document.h"
#include "sample_gltf.h"

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::tests {
namespace {

constexpr const char* extension = "EXT_mesh_opacity_micromap";
const std::string primitivePath = "/meshes/0/primitives/0/extensions/EXT_mesh_opacity_micromap";
const std::string micromapPath = "/extensions/EXT_mesh_opacity_micromap/micromaps/0";

// A file with micromaps to break. Views 4, 5 and 6 are data, records and indices; accessor 3 the indices.
struct Broken {
    SampleGltf sample;
    Broken() {
        const auto document = io::GltfDocument::parse(sampleWithMicromaps(), "", "sample.glb");
        sample.json = document->data().json;
        sample.buffer.assign(document->data().buffers[0].bytes.begin(),
                             document->data().buffers[0].bytes.end());
    }
    io::Json& micromap() { return sample.json["extensions"][extension]["micromaps"][0]; }
    io::Json& onPrimitive() { return sample.primitive()["extensions"][extension]; }
    io::Json& view(size_t index) { return sample.json["bufferViews"][index]; }
    io::Json& indices() { return sample.json["accessors"][3]; }
    uint8_t& record(size_t byte) { return sample.buffer[view(5)["byteOffset"].get<size_t>() + byte]; }
    uint8_t& index(size_t byte) { return sample.buffer[view(6)["byteOffset"].get<size_t>() + byte]; }
};

using Breaker = std::function<void(Broken&)>;

struct Case {
    const char* rule;
    std::string path;
    Breaker breakIt;
};

void PrintTo(const Case& c, std::ostream* out) {
    *out << c.rule << " at " << c.path;
}

class BrokenRule : public testing::TestWithParam<Case> {};

TEST_P(BrokenRule, IsReportedWithItsPath) {
    Broken broken;
    GetParam().breakIt(broken);
    const Result<io::GltfDocument> document = broken.sample.parse();
    ASSERT_TRUE(document) << document.error().message;
    bool found = false;
    std::string all;
    for (const io::Breach& breach : io::checkRules(*document)) {
        found |= breach.rule == GetParam().rule && breach.path == GetParam().path;
        all += breach.path + " " + breach.rule + " " + breach.message + "\n";
    }
    EXPECT_TRUE(found) << "found instead:\n" << all;
}

const std::vector<Case> cases{
    {"view-in-buffer", "/bufferViews/0", [](Broken& b) { b.view(0)["byteLength"] = 1 << 20; }},
    {"accessor", "/accessors/0/type", [](Broken& b) { b.sample.json["accessors"][0]["type"] = "VEC5"; }},
    {"accessor-in-view", "/accessors/0", [](Broken& b) { b.sample.json["accessors"][0]["count"] = 5; }},
    {"accessor-alignment", "/accessors/2",
     [](Broken& b) { b.sample.json["accessors"][2]["byteOffset"] = 1; }},
    {"omm-used", "/extensionsUsed", [](Broken& b) { b.sample.json.erase("extensionsUsed"); }},
    {"omm-not-required", "/extensionsRequired",
     [](Broken& b) { b.sample.json["extensionsRequired"] = {extension}; }},
    {"omm-micromaps", "/extensions/EXT_mesh_opacity_micromap/micromaps",
     [](Broken& b) { b.sample.json["extensions"][extension]["micromaps"] = io::Json::array(); }},
    {"omm-micromap", micromapPath, [](Broken& b) { b.micromap() = 5; }},
    {"omm-view", micromapPath + "/data", [](Broken& b) { b.micromap().erase("data"); }},
    {"omm-view", micromapPath + "/triangles", [](Broken& b) { b.micromap()["triangles"] = 99; }},
    {"omm-stride", micromapPath + "/triangles", [](Broken& b) { b.view(5)["byteStride"] = 8; }},
    {"omm-stride", micromapPath + "/data", [](Broken& b) { b.view(4)["byteStride"] = 4; }},
    {"omm-record-stride", micromapPath + "/triangles", [](Broken& b) { b.view(5)["byteStride"] = 10; }},
    {"omm-triangles-length", micromapPath + "/triangles", [](Broken& b) { b.view(5)["byteLength"] = 15; }},
    {"omm-record-level", micromapPath + "/triangles", [](Broken& b) { b.record(4) = 13; }},
    {"omm-record-format", micromapPath + "/triangles", [](Broken& b) { b.record(6) = 3; }},
    {"omm-record-region", micromapPath + "/triangles", [](Broken& b) { b.record(8) = 5; }},
    {"omm-record-overlap", micromapPath + "/triangles", [](Broken& b) { b.record(8) = 3; }},
    {"omm-usage", micromapPath + "/usageCounts",
     [](Broken& b) { b.micromap()["usageCounts"] = io::Json::array(); }},
    {"omm-usage", micromapPath + "/usageLevels", [](Broken& b) { b.micromap().erase("usageLevels"); }},
    {"omm-usage-count", micromapPath + "/usageCounts/0",
     [](Broken& b) { b.micromap()["usageCounts"][0] = 0; }},
    {"omm-usage-level", micromapPath + "/usageLevels/0",
     [](Broken& b) { b.micromap()["usageLevels"][0] = 13; }},
    {"omm-usage-format", micromapPath + "/usageFormats/0",
     [](Broken& b) { b.micromap()["usageFormats"][0] = 3; }},
    {"omm-usage-lengths", micromapPath, [](Broken& b) { b.micromap()["usageLevels"].push_back(1); }},
    {"omm-usage-total", micromapPath + "/usageCounts", [](Broken& b) { b.micromap()["usageCounts"][0] = 3; }},
    {"omm-usage-sums", micromapPath + "/usageCounts", [](Broken& b) { b.micromap()["usageLevels"][0] = 4; }},
    {"omm-primitive", primitivePath, [](Broken& b) { b.onPrimitive() = 1; }},
    {"omm-primitive-mode", "/meshes/0/primitives/0/mode",
     [](Broken& b) { b.sample.primitive()["mode"] = 5; }},
    {"omm-triangle-count", "/meshes/0/primitives/0", [](Broken& b) { b.sample.primitive()["indices"] = 99; }},
    {"omm-primitive-micromap", primitivePath + "/micromap",
     [](Broken& b) { b.onPrimitive()["micromap"] = 1; }},
    {"omm-primitive-micromap", primitivePath + "/micromap",
     [](Broken& b) { b.onPrimitive().erase("micromap"); }},
    {"omm-base-triangle", primitivePath + "/micromapBaseTriangle",
     [](Broken& b) { b.onPrimitive()["micromapBaseTriangle"] = -1; }},
    {"omm-implicit-indices", primitivePath,
     [](Broken& b) {
         b.onPrimitive().erase("micromapIndices");
         b.onPrimitive()["micromapBaseTriangle"] = 1;
     }},
    {"omm-index-accessor", primitivePath + "/micromapIndices",
     [](Broken& b) { b.onPrimitive()["micromapIndices"] = 99; }},
    {"omm-index-type", primitivePath + "/micromapIndices",
     [](Broken& b) { b.indices()["componentType"] = 5120; }},
    {"omm-index-normalized", primitivePath + "/micromapIndices",
     [](Broken& b) { b.indices()["normalized"] = true; }},
    {"omm-index-stride", primitivePath + "/micromapIndices",
     [](Broken& b) {
         b.view(6)["byteStride"] = 4;
         b.view(6)["byteLength"] = 8;
         b.sample.buffer.resize(b.sample.buffer.size() + 8);
     }},
    {"omm-index-count", primitivePath + "/micromapIndices", [](Broken& b) { b.indices()["count"] = 1; }},
    {"omm-index-value", primitivePath + "/micromapIndices", [](Broken& b) { b.index(0) = 2; }},
    {"omm-index-value", primitivePath + "/micromapIndices",
     [](Broken& b) { b.onPrimitive()["micromapBaseTriangle"] = 1; }},
    {"omm-index-value", primitivePath + "/micromapIndices",
     [](Broken& b) {
         b.indices()["componentType"] = 5124;
         b.view(6)["byteLength"] = 8;
         b.sample.buffer.resize(b.sample.buffer.size() + 8);
         for (size_t i = 0; i < 8; ++i) b.index(i) = i == 0 ? 0xFB : i < 4 ? 0xFF : 0;  // -5, 0
     }},
};

INSTANTIATE_TEST_SUITE_P(Io, BrokenRule, testing::ValuesIn(cases));

TEST(Rules, NameABufferThatIsNotThere) {
    const std::string text =
        R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": "no.bin"}]})";
    const auto document = io::GltfDocument::parse({text.begin(), text.end()}, "/nonexistent", "sample.gltf");
    const std::vector<io::Breach> breaches = io::checkRules(*document);
    ASSERT_EQ(breaches.size(), 1U);
    EXPECT_EQ(breaches[0].path, "/buffers/0");
    EXPECT_EQ(breaches[0].rule, "buffer");
}

TEST(Rules, HoldForWhatIsWritten) {
    EXPECT_TRUE(io::checkRules(*Broken().sample.parse()).empty());
}

TEST(Rules, AcceptEverySpecialIndexOfEveryType) {
    for (const unsigned type : {5121U, 5122U, 5123U, 5124U, 5125U}) {
        for (const uint8_t low : {0xFF, 0xFE, 0xFD, 0xFC}) {
            Broken broken;
            broken.indices()["componentType"] = type;
            broken.view(6)["byteLength"] = 8;
            broken.sample.buffer.resize(broken.sample.buffer.size() + 8);
            for (size_t i = 0; i < 8; ++i) broken.index(i) = 0xFF;
            broken.index(0) = low;
            broken.onPrimitive()["micromapBaseTriangle"] = 1000;  // not added to special indices
            EXPECT_TRUE(io::checkRules(*broken.sample.parse()).empty()) << type << " " << int{low};
        }
    }
}

TEST(Rules, AcceptRecordsThatAreCountedInParts) {
    Broken broken;
    broken.micromap()["usageCounts"] = {1, 1};
    broken.micromap()["usageLevels"] = {2, 2};
    broken.micromap()["usageFormats"] = {2, 2};
    EXPECT_TRUE(io::checkRules(*broken.sample.parse()).empty());
}

}  // namespace
}  // namespace filigree::tests
