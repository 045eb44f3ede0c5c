// What writeWithMicromaps makes of a document.
#include "filigree/core/file.h"
#include "filigree/io/gltf_rules.h"

#include "io/document.h"
#include "io/uri.h"
#include "sample_gltf.h"
#include "temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::tests {
namespace {

using testing::HasSubstr;

// One micromap array and what the first primitive gets of it.
struct SampleOutput {
    micromap::FlatSet set = sampleSet(2, 2);
    std::vector<int32_t> indices{1, -3};
    std::vector<uint32_t> vertices;
    image::AlphaTest test{image::AlphaMode::mask, 0.25, 0.75, 2, 0.125};

    [[nodiscard]] io::MicromapOutput output() const {
        io::MicromapOutput output;
        output.micromaps.push_back({"leaf", &set, test});
        output.primitives.push_back({0, 0, 0, indices, vertices});
        return output;
    }
};

io::GltfDocument loaded(const std::filesystem::path& path) {
    Result<io::GltfDocument> document = io::GltfDocument::load(path);
    EXPECT_TRUE(document) << document.error().message;
    for (const io::Breach& breach : io::checkRules(*document))
        ADD_FAILURE() << breach.path << ": " << breach.message;
    return std::move(*document);
}

// Writes `document` and reads it back.
io::GltfDocument written(const io::GltfDocument& document, const SampleOutput& sample,
                         const std::filesystem::path& path) {
    const Status status = io::writeWithMicromaps(document, sample.output(), path);
    EXPECT_TRUE(status) << status.error().message;
    return loaded(path);
}

const scene::Primitive& onlyPrimitive(const Result<scene::Scene>& scene) {
    return scene->meshes.at(0).primitives.at(0);
}

void expectMicromaps(const io::GltfDocument& document, const SampleOutput& sample) {
    const Result<scene::Scene> scene = io::readScene(document);
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->micromaps.size(), 1U);
    EXPECT_EQ(scene->micromaps[0].name, "leaf");
    EXPECT_EQ(scene->micromaps[0].set.data, sample.set.data);
    EXPECT_EQ(scene->micromaps[0].set.records.size(), sample.set.records.size());
    EXPECT_EQ(onlyPrimitive(scene).micromapIndices, sample.indices);
    ASSERT_TRUE(scene->micromaps[0].bakedWith);
    const image::AlphaTest& test = *scene->micromaps[0].bakedWith;
    EXPECT_EQ(test.mode, sample.test.mode);
    EXPECT_EQ(test.cutoff, sample.test.cutoff);
    EXPECT_EQ(test.factor, sample.test.factor);
    EXPECT_EQ(test.mips, sample.test.mips);
    EXPECT_EQ(test.guard, sample.test.guard);
}

TEST(WriteGltf, RoundTripsThroughBothForms) {
    const TempFolder folder;
    const SampleOutput sample;
    const Result<io::GltfDocument> document = SampleGltf::maskedQuad().parse();
    const io::GltfDocument glb = written(*document, sample, folder / "a.glb");
    expectMicromaps(glb, sample);
    expectMicromaps(written(*document, sample, folder / "a.gltf"), sample);
    expectMicromaps(written(loaded(folder / "a.gltf"), sample, folder / "b.glb"), sample);
}

TEST(WriteGltf, KeepsWhatItDoesNotKnow) {
    const TempFolder folder;
    SampleGltf source = SampleGltf::maskedQuad();
    source.json["extensionsUsed"] = {"VENDOR_thing"};
    source.json["extensions"]["VENDOR_thing"] = {{"zebra", 1}, {"apple", {1.5, "two", nullptr}}};
    source.json["extras"] = {{"note", "größer"}};
    source.primitive()["extensions"]["VENDOR_thing"] = {{"deep", {{"er", true}}}};
    source.json["unheard_of"] = {3, 2, 1};
    const Result<io::GltfDocument> document = source.parse();
    const io::GltfDocument result = written(*document, SampleOutput(), folder / "a.glb");
    io::Json after = result.data().json;
    const io::Json before = document->data().json;
    EXPECT_EQ(after["extensionsUsed"], io::Json({"VENDOR_thing", "EXT_mesh_opacity_micromap"}));
    after["extensions"].erase("EXT_mesh_opacity_micromap");
    after["meshes"][0]["primitives"][0]["extensions"].erase("EXT_mesh_opacity_micromap");
    for (const char* same :
         {"extensions", "extras", "unheard_of", "meshes", "materials", "nodes", "images"}) {
        EXPECT_EQ(after[same].dump(), before[same].dump()) << same;
    }
    for (const char* longer : {"accessors", "bufferViews"}) {
        for (size_t i = 0; i < before[longer].size(); ++i) EXPECT_EQ(after[longer][i], before[longer][i]);
    }
    const auto& old = document->data().buffers[0].bytes;
    EXPECT_TRUE(std::equal(old.begin(), old.end(), result.data().buffers[0].bytes.begin()));
}

TEST(WriteGltf, KeepsUnknownChunks) {
    const TempFolder folder;
    std::vector<uint8_t> bytes = SampleGltf::maskedQuad().glb();
    const std::vector<uint8_t> extra{4, 0, 0, 0, 'X', 'T', 'R', 'A', 9, 8, 7, 6};
    bytes.insert(bytes.end(), extra.begin(), extra.end());
    bytes[8] = static_cast<uint8_t>(bytes.size());
    bytes[9] = static_cast<uint8_t>(bytes.size() >> 8);
    const Result<io::GltfDocument> document = io::GltfDocument::parse(bytes, "", "sample.glb");
    ASSERT_TRUE(document) << document.error().message;
    written(*document, SampleOutput(), folder / "a.glb");
    const std::vector<uint8_t> result = readFile(folder / "a.glb").value();
    EXPECT_TRUE(std::equal(extra.begin(), extra.end(), result.end() - 12));
}

TEST(WriteGltf, UsesTheSmallestIndexType) {
    const TempFolder folder;
    const auto typeFor = [&](int32_t largest, size_t records) {
        SampleOutput sample;
        sample.set = sampleSet(0, records);
        sample.indices = {largest, -1};
        const Result<io::GltfDocument> document = SampleGltf::maskedQuad().parse();
        const io::GltfDocument result = written(*document, sample, folder / "a.glb");
        expectMicromaps(result, sample);
        return result.data().json["accessors"].back()["componentType"].get<int>();
    };
    EXPECT_EQ(typeFor(251, 252), 5121);
    EXPECT_EQ(typeFor(252, 253), 5123);
    EXPECT_EQ(typeFor(65531, 65532), 5123);
    EXPECT_EQ(typeFor(65532, 65533), 5125);
}

TEST(WriteGltf, ReplacesIndicesOfRotatedTriangles) {
    const TempFolder folder;
    SampleOutput sample;
    sample.vertices = {1, 2, 0, 3, 0, 2};
    const Result<io::GltfDocument> document = SampleGltf::maskedQuad().parse();
    const io::GltfDocument result = written(*document, sample, folder / "a.glb");
    expectMicromaps(result, sample);
    EXPECT_EQ(onlyPrimitive(io::readScene(result)).indices, sample.vertices);
}

TEST(WriteGltf, ReplacesMicromapsThatWereThere) {
    const TempFolder folder;
    const Result<io::GltfDocument> first = io::GltfDocument::parse(sampleWithMicromaps(), "", "sample.glb");
    SampleOutput sample;
    sample.set = sampleSet(1, 3);
    const io::GltfDocument result = written(*first, sample, folder / "a.glb");
    expectMicromaps(result, sample);
}

TEST(WriteGltf, KeepsMicromapsOfOtherPrimitives) {
    const TempFolder folder;
    SampleGltf source = SampleGltf::maskedQuad();
    source.json["meshes"].push_back(source.json["meshes"][0]);
    SampleOutput both;
    io::MicromapOutput output = both.output();
    output.micromaps.push_back({"second", &both.set, {}});
    output.primitives.push_back({1, 0, 1, both.indices, {}});
    ASSERT_TRUE(io::writeWithMicromaps(*source.parse(), output, folder / "both.glb"));
    const io::GltfDocument result =
        written(loaded(folder / "both.glb"), SampleOutput(), folder / "again.glb");
    const io::Json& micromaps = result.data().json["extensions"]["EXT_mesh_opacity_micromap"]["micromaps"];
    ASSERT_EQ(micromaps.size(), 2U);
    EXPECT_EQ(micromaps[0]["name"], "second");
    const Result<scene::Scene> scene = io::readScene(result);
    EXPECT_EQ(scene->meshes[1].primitives[0].micromaps, 0);
    EXPECT_EQ(scene->meshes[0].primitives[0].micromaps, 1);
}

TEST(WriteGltf, ReadsAndReplacesTheOlderName) {
    const TempFolder folder;
    Result<io::GltfDocument> first = io::GltfDocument::parse(sampleWithMicromaps(), "", "sample.glb");
    std::string text = first->data().json.dump();
    for (size_t at; (at = text.find("EXT_mesh")) != std::string::npos;) text.replace(at, 3, "KHR");
    SampleGltf older;
    older.json = io::Json::parse(text);
    older.buffer.assign(first->data().buffers[0].bytes.begin(), first->data().buffers[0].bytes.end());
    const Result<scene::Scene> scene = older.read();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(onlyPrimitive(scene).micromapIndices, (std::vector<int32_t>{1, -2}));
    const io::GltfDocument result = written(*older.parse(), SampleOutput(), folder / "a.glb");
    EXPECT_EQ(result.data().json.dump().find("KHR_mesh_opacity_micromap"), std::string::npos);
    expectMicromaps(result, SampleOutput());
}

// A .gltf with a buffer file and an image file in folders with names that need escapes.
std::filesystem::path writeWithFiles(const TempFolder& folder) {
    SampleGltf source = SampleGltf::maskedQuad();
    std::filesystem::create_directories(folder / "in/some parts");
    EXPECT_TRUE(writeFile(folder / "in/some parts/data.bin", source.buffer));
    EXPECT_TRUE(writeFile(folder / "in/leaf.png", samplePng()));
    source.json["buffers"] = io::Json::parse(R"([{"uri": "some%20parts/data.bin"}])");
    source.json["buffers"][0]["byteLength"] = source.buffer.size();
    source.json["images"][0] = {{"uri", "leaf.png"}};
    EXPECT_TRUE(writeFile(folder / "in/scene.gltf", source.json.dump()));
    return folder / "in/scene.gltf";
}

TEST(WriteGltf, EmbedsFilesInAGlb) {
    const TempFolder folder;
    const io::GltfDocument document = loaded(writeWithFiles(folder));
    written(document, SampleOutput(), folder / "out.glb");
    std::filesystem::remove_all(folder / "in");
    const io::GltfDocument result = loaded(folder / "out.glb");
    expectMicromaps(result, SampleOutput());
    EXPECT_EQ(result.data().json.dump().find("uri"), std::string::npos);
    EXPECT_EQ(result.data().json["images"][0]["mimeType"], "image/png");
}

TEST(WriteGltf, KeepsFilesOfATextInAnotherFolder) {
    const TempFolder folder;
    std::filesystem::create_directories(folder / "elsewhere/deep");
    const io::GltfDocument document = loaded(writeWithFiles(folder));
    const io::GltfDocument result = written(document, SampleOutput(), folder / "elsewhere/deep/out.gltf");
    expectMicromaps(result, SampleOutput());
    EXPECT_EQ(result.data().json["buffers"][0]["uri"], "../../in/some%20parts/data.bin");
    EXPECT_EQ(result.data().json["images"][0]["uri"], "../../in/leaf.png");
}

TEST(WriteGltf, MergesSeveralBuffers) {
    const TempFolder folder;
    SampleGltf source = SampleGltf::maskedQuad();
    const std::vector<uint8_t> png = samplePng();
    source.json["buffers"] = io::Json::array();
    const std::string type = "application/octet-stream";
    source.json["buffers"].push_back(
        {{"uri", io::makeDataUri(type, source.buffer)}, {"byteLength", source.buffer.size()}});
    source.json["buffers"].push_back({{"uri", io::makeDataUri(type, png)}, {"byteLength", png.size()}});
    source.json["buffers"].push_back(
        {{"uri", io::makeDataUri(type, png)}, {"byteLength", png.size()}, {"extras", {{"keep", 1}}}});
    for (const size_t buffer : {1, 2}) {
        source.json["bufferViews"].push_back({{"buffer", buffer}, {"byteLength", png.size()}});
        source.json["images"].push_back(
            {{"bufferView", source.json["bufferViews"].size() - 1}, {"mimeType", "image/png"}});
        source.json["textures"][0]["source"] = buffer;
        const std::string text = source.json.dump();
        const auto document = io::GltfDocument::parse({text.begin(), text.end()}, "", "sample.gltf");
        ASSERT_TRUE(document) << document.error().message;
        const io::GltfDocument result = written(*document, SampleOutput(), folder / "a.glb");
        expectMicromaps(result, SampleOutput());
        EXPECT_EQ(result.data().json["buffers"].size(), 2U);
        EXPECT_EQ(result.data().json["buffers"][1]["extras"]["keep"], 1);
    }
}

TEST(WriteGltf, LeavesNothingBehindWhenItFails) {
    const TempFolder folder;
    const Result<io::GltfDocument> document = SampleGltf::maskedQuad().parse();
    EXPECT_FALSE(io::writeWithMicromaps(*document, SampleOutput().output(), folder / "no/such/folder/a.glb"));
    SampleGltf lost = SampleGltf::maskedQuad();
    lost.json["images"].push_back({{"uri", "lost.png"}});
    const Status status = io::writeWithMicromaps(*lost.parse(), SampleOutput().output(), folder / "a.glb");
    ASSERT_FALSE(status);
    EXPECT_THAT(status.error().message, HasSubstr("/images/1"));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(WriteGltf, WritesTheSameBytesEveryTime) {
    EXPECT_EQ(sampleWithMicromaps(), sampleWithMicromaps());
}

}  // namespace
}  // namespace filigree::tests
