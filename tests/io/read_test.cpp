// What readScene makes of a file.
#include "filigree/io/image_file.h"

#include "sample_gltf.h"

#include <functional>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::tests {
namespace {

using testing::HasSubstr;

const scene::Primitive& firstPrimitive(const Result<scene::Scene>& scene) {
    return scene->meshes[0].primitives[0];
}

void expectError(const Result<scene::Scene>& scene, ErrorKind kind, const std::string& part) {
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().kind, kind);
    EXPECT_THAT(scene.error().message, HasSubstr("sample.glb"));
    EXPECT_THAT(scene.error().message, HasSubstr(part));
}

TEST(ReadScene, ReadsAMaskedQuad) {
    const Result<scene::Scene> scene = SampleGltf::maskedQuad().read();
    ASSERT_TRUE(scene) << scene.error().message;
    const scene::Primitive& primitive = firstPrimitive(scene);
    EXPECT_EQ(primitive.positions.size(), 4U);
    EXPECT_EQ(primitive.indices, (std::vector<uint32_t>{0, 1, 2, 0, 2, 3}));
    EXPECT_EQ(primitive.uvs[1], (mesh::Uv{1, 1}));
    EXPECT_TRUE(primitive.alphas.empty());
    EXPECT_EQ(scene->instances.size(), 1U);
    EXPECT_EQ(scene->materials[0].alphaMode, scene::AlphaMode::mask);
    EXPECT_EQ(scene->materials[0].filter, image::Filter::linear);
    ASSERT_TRUE(scene->images[0].alpha);
    EXPECT_EQ(scene->images[0].alpha->at(1, 0), 0);
    EXPECT_EQ(scene->images[0].alpha->at(2, 3), 65535);
    EXPECT_FALSE(scene->images[0].colour);
    EXPECT_TRUE(scene->notes.empty());
}

TEST(ReadScene, ReadsTextAsItReadsGlb) {
    const std::string text = SampleGltf::maskedQuad().gltf();
    const auto document = io::GltfDocument::parse({text.begin(), text.end()}, "", "sample.gltf");
    ASSERT_TRUE(document) << document.error().message;
    const Result<scene::Scene> scene = io::readScene(*document);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(firstPrimitive(scene).uvs, firstPrimitive(SampleGltf::maskedQuad().read()).uvs);
}

TEST(ReadScene, CountsUpWithoutIndices) {
    SampleGltf sample = SampleGltf::maskedQuad();
    sample.primitive().erase("indices");
    const Result<scene::Scene> scene = sample.read();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(firstPrimitive(scene).indices, (std::vector<uint32_t>{0, 1, 2}));
}

TEST(ReadScene, ReadsIndicesOfEveryType) {
    SampleGltf bytes = SampleGltf::maskedQuad();
    bytes.primitive()["indices"] = bytes.accessor(std::vector<uint8_t>{3, 2, 1}, 5121, "SCALAR", 3);
    EXPECT_EQ(firstPrimitive(bytes.read()).indices, (std::vector<uint32_t>{3, 2, 1}));
    SampleGltf words = SampleGltf::maskedQuad();
    words.primitive()["indices"] = words.accessor(std::vector<uint32_t>{3, 2, 1}, 5125, "SCALAR", 3);
    EXPECT_EQ(firstPrimitive(words.read()).indices, (std::vector<uint32_t>{3, 2, 1}));
}

TEST(ReadScene, RejectsAnIndexPastTheVertices) {
    SampleGltf sample = SampleGltf::maskedQuad();
    sample.primitive()["indices"] =
        sample.accessor(std::vector<uint16_t>{0, 1, 2, 0, 4, 3}, 5123, "SCALAR", 6);
    expectError(sample.read(), ErrorKind::format, "index 1 of triangle 1 is 4, expected below 4");
}

TEST(ReadScene, MapsNormalizedCoordinates) {
    SampleGltf sample = SampleGltf::maskedQuad();
    const size_t accessor =
        sample.accessor(std::vector<uint16_t>{0, 65535, 1, 2, 3, 4, 5, 32768}, 5123, "VEC2", 4);
    sample.json["accessors"][accessor]["normalized"] = true;
    sample.primitive()["attributes"]["TEXCOORD_0"] = accessor;
    const Result<scene::Scene> scene = sample.read();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(firstPrimitive(scene).uvs[0], (mesh::Uv{0, 1}));
    EXPECT_EQ(firstPrimitive(scene).uvs[3],
              (mesh::Uv{static_cast<float>(5 / 65535.0), static_cast<float>(32768 / 65535.0)}));
}

TEST(ReadScene, ReadsQuantizedCoordinates) {
    SampleGltf sample = SampleGltf::maskedQuad();
    sample.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    const size_t plain = sample.accessor(std::vector<int8_t>{-3, 4, 0, 0, 1, 1, 127, -128}, 5120, "VEC2", 4);
    sample.primitive()["attributes"]["TEXCOORD_0"] = plain;
    EXPECT_EQ(firstPrimitive(sample.read()).uvs[0], (mesh::Uv{-3, 4}));
    sample.json["accessors"][plain]["normalized"] = true;
    EXPECT_EQ(firstPrimitive(sample.read()).uvs[3], (mesh::Uv{1, -1}));
}

TEST(ReadScene, AppliesByteStride) {
    SampleGltf sample = SampleGltf::maskedQuad();
    const size_t accessor = sample.accessor(
        std::vector<float>{.1F, .2F, 9, .3F, .4F, 9, .5F, .6F, 9, .7F, .8F, 9}, 5126, "VEC2", 4);
    sample.json["bufferViews"][sample.json["accessors"][accessor]["bufferView"].get<size_t>()]["byteStride"] =
        12;
    sample.primitive()["attributes"]["TEXCOORD_0"] = accessor;
    EXPECT_EQ(firstPrimitive(sample.read()).uvs[3], (mesh::Uv{.7F, .8F}));
}

TEST(ReadScene, AppliesSparseAccessorsOverZeros) {
    SampleGltf sample = SampleGltf::maskedQuad();
    const size_t where = sample.view(std::vector<uint8_t>{1, 3});
    const size_t what = sample.view(std::vector<float>{.1F, .2F, .3F, .4F});
    io::Json& accessor = sample.json["accessors"][1];
    accessor.erase("bufferView");
    accessor["sparse"] = {{"count", 2},
                          {"indices", {{"bufferView", where}, {"componentType", 5121}}},
                          {"values", {{"bufferView", what}}}};
    const Result<scene::Scene> scene = sample.read();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(firstPrimitive(scene).uvs, (std::vector<mesh::Uv>{{0, 0}, {.1F, .2F}, {0, 0}, {.3F, .4F}}));
    accessor["sparse"]["count"] = 5;
    expectError(sample.read(), ErrorKind::format, "/accessors/1/sparse/count");
}

TEST(ReadScene, BoundsAccessorsThatNothingBounds) {
    SampleGltf sample = SampleGltf::maskedQuad();
    sample.json["accessors"][0].erase("bufferView");
    sample.json["accessors"][0]["count"] = uint64_t{4} << 30;
    expectError(sample.read(), ErrorKind::limit, "/accessors/0/count");
}

// The example of KHR_texture_transform: the lower left quadrant of the image, rotated clockwise by 90
// degrees.
TEST(ReadScene, AppliesTheTextureTransform) {
    SampleGltf sample = SampleGltf::maskedQuad();
    sample.material()["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
        {"offset", {0, 1}}, {"rotation", std::numbers::pi / 2}, {"scale", {0.5, 0.5}}};
    const Result<scene::Scene> scene = sample.read();
    ASSERT_TRUE(scene) << scene.error().message;
    const std::vector<mesh::Uv> expected{{0.5F, 1}, {0.5F, 0.5F}, {0, 0.5F}, {0, 1}};
    for (size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(firstPrimitive(scene).uvs[i].u, expected[i].u, 1e-6) << i;
        EXPECT_NEAR(firstPrimitive(scene).uvs[i].v, expected[i].v, 1e-6) << i;
    }
}

TEST(ReadScene, TakesTheCoordinateSetOfTheTransform) {
    SampleGltf sample = SampleGltf::maskedQuad();
    sample.primitive()["attributes"]["TEXCOORD_3"] =
        sample.accessor(std::vector<float>{5, 6, 0, 0, 0, 0, 0, 0}, 5126, "VEC2", 4);
    io::Json& texture = sample.material()["pbrMetallicRoughness"]["baseColorTexture"];
    texture["texCoord"] = 1;
    texture["extensions"]["KHR_texture_transform"] = {{"texCoord", 3}};
    EXPECT_EQ(firstPrimitive(sample.read()).uvs[0], (mesh::Uv{5, 6}));
}

TEST(ReadScene, ReadsVertexAlpha) {
    SampleGltf sample = SampleGltf::maskedQuad();
    const size_t accessor = sample.accessor(std::vector<uint8_t>(16, 51), 5121, "VEC4", 4);
    sample.primitive()["attributes"]["COLOR_0"] = accessor;
    expectError(sample.read(), ErrorKind::format, "COLOR_0");
    sample.json["accessors"][accessor]["normalized"] = true;
    const Result<scene::Scene> scene = sample.read();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(firstPrimitive(scene).alphas, std::vector<float>(4, 0.2F));
}

TEST(ReadScene, ReadsSamplers) {
    SampleGltf sample = SampleGltf::maskedQuad();
    sample.json["textures"][0]["sampler"] = 0;
    const auto filterOf = [&](int magnification, int minification) {
        sample.json["samplers"] =
            io::Json::array({{{"magFilter", magnification}, {"minFilter", minification}}});
        return sample.read()->materials[0].filter;
    };
    EXPECT_EQ(filterOf(9728, 9986), image::Filter::nearest);
    EXPECT_EQ(filterOf(9729, 9985), image::Filter::linear);
    EXPECT_EQ(filterOf(9728, 9987), image::Filter::both);
    sample.json["samplers"] = io::Json::array({{{"magFilter", 9728}, {"wrapS", 33071}, {"wrapT", 33648}}});
    const Result<scene::Scene> scene = sample.read();
    EXPECT_EQ(scene->materials[0].filter, image::Filter::both);
    EXPECT_EQ(scene->materials[0].wrapU, image::Wrap::clampToEdge);
    EXPECT_EQ(scene->materials[0].wrapV, image::Wrap::mirroredRepeat);
    sample.json["samplers"] = io::Json::array({{{"wrapS", 1}}});
    expectError(sample.read(), ErrorKind::format, "/samplers/0/wrapS");
}

TEST(ReadScene, PlacesInstancesByTheirNodes) {
    SampleGltf sample = SampleGltf::maskedQuad();
    sample.json["nodes"] =
        io::Json::parse(R"([{"children": [1, 2], "translation": [1, 2, 3], "scale": [2, 2, 2]},
        {"mesh": 0, "translation": [1, 0, 0]},
        {"mesh": 0, "matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1]}])");
    const Result<scene::Scene> scene = sample.read();
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->instances.size(), 2U);
    EXPECT_EQ(scene->instances[0].transform,
              (std::array<float, 16>{2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 3, 2, 3, 1}));
    EXPECT_EQ(scene->instances[1].transform,
              (std::array<float, 16>{0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 1, 2, 13, 1}));
}

TEST(ReadScene, PlacesAllScenesWhenNoneIsNamed) {
    SampleGltf sample = SampleGltf::maskedQuad();
    sample.json.erase("scene");
    sample.json["nodes"].push_back({{"mesh", 0}});
    sample.json["scenes"] = io::Json::parse(R"([{"nodes": [0]}, {"nodes": [0, 1]}])");
    EXPECT_EQ(sample.read()->instances.size(), 2U);
    sample.json["scene"] = 0;
    EXPECT_EQ(sample.read()->instances.size(), 1U);
}

TEST(ReadScene, RejectsNodesThatLoop) {
    SampleGltf sample = SampleGltf::maskedQuad();
    sample.json["nodes"] = io::Json::parse(R"([{"children": [1]}, {"children": [0]}])");
    expectError(sample.read(), ErrorKind::format, "/nodes/0: reached twice");
}

TEST(ReadScene, BoundsTheDepthOfNodes) {
    SampleGltf sample = SampleGltf::maskedQuad();
    sample.json["nodes"] = io::Json::array();
    for (size_t i = 0; i < 2000; ++i)
        sample.json["nodes"].push_back({{"children", io::Json::array({i + 1})}});
    sample.json["nodes"].push_back(io::Json::object());
    expectError(sample.read(), ErrorKind::limit, "nodes deep");
}

TEST(ReadScene, PassesOverWhatItNeedNotRead) {
    SampleGltf sample = SampleGltf::maskedQuad();
    sample.material()["alphaMode"] = "OPAQUE";
    sample.primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
    sample.json["textures"][0] = {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}};
    io::Json lines = sample.primitive();
    lines["mode"] = 1;
    sample.json["meshes"][0]["primitives"].push_back(lines);
    const Result<scene::Scene> scene = sample.read();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_TRUE(firstPrimitive(scene).indices.empty());
    EXPECT_EQ(scene->meshes[0].primitives.size(), 1U);
    EXPECT_EQ(scene->notes.size(), 3U);
}

TEST(ReadScene, NamesWhatItNeedsAndCannotRead) {
    SampleGltf draco = SampleGltf::maskedQuad();
    draco.primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
    expectError(draco.read(), ErrorKind::unsupported, "KHR_draco_mesh_compression");
    SampleGltf meshopt = SampleGltf::maskedQuad();
    meshopt.json["bufferViews"][1]["extensions"]["EXT_meshopt_compression"] = io::Json::object();
    expectError(meshopt.read(), ErrorKind::unsupported, "EXT_meshopt_compression");
    SampleGltf basis = SampleGltf::maskedQuad();
    basis.json["textures"][0] = {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}};
    expectError(basis.read(), ErrorKind::unsupported, "KHR_texture_basisu");
    SampleGltf required = SampleGltf::maskedQuad();
    required.json["extensionsRequired"] = {"KHR_materials_unlit", "VENDOR_surprise"};
    expectError(required.read(), ErrorKind::unsupported, "VENDOR_surprise");
    SampleGltf web = SampleGltf::maskedQuad();
    web.json["images"][0] = {{"uri", "https://example.com/leaf.png"}};
    expectError(web.read(), ErrorKind::unsupported, "https://example.com/leaf.png");
    SampleGltf lost = SampleGltf::maskedQuad();
    lost.json["images"][0] = {{"uri", "no/such/leaf.png"}};
    expectError(lost.read(), ErrorKind::file, "/images/0");
}

TEST(ReadScene, RejectsBrokenStructure) {
    const auto broken = [](const std::function<void(SampleGltf&)>& breakIt, const std::string& part) {
        SampleGltf sample = SampleGltf::maskedQuad();
        breakIt(sample);
        const Result<scene::Scene> scene = sample.read();
        ASSERT_FALSE(scene) << part;
        EXPECT_THAT(scene.error().message, HasSubstr(part));
    };
    broken([](SampleGltf& s) { s.json["meshes"][0]["primitives"] = io::Json::array(); },
           "/meshes/0/primitives: empty");
    broken([](SampleGltf& s) { s.json["accessors"][0]["count"] = 400; }, "/accessors/0: 400 elements");
    broken([](SampleGltf& s) { s.json["bufferViews"][0]["byteOffset"] = 1 << 20; }, "/bufferViews/0: bytes");
    broken([](SampleGltf& s) { s.json["bufferViews"][0]["buffer"] = 1; }, "/bufferViews/0/buffer");
    broken([](SampleGltf& s) { s.json["accessors"][0]["count"] = -1; }, "/accessors/0/count: found -1");
    broken([](SampleGltf& s) { s.json["accessors"][1]["count"] = 3; }, "one for each of 4 vertices");
    broken([](SampleGltf& s) { s.json["accessors"] = 7; }, "/accessors: found 7, expected an array");
    broken([](SampleGltf& s) { s.material()["alphaMode"] = "GLASS"; }, "/materials/0/alphaMode");
    broken([](SampleGltf& s) { s.material()["alphaCutoff"] = -1; }, "/materials/0/alphaCutoff");
    broken([](SampleGltf& s) { s.json["asset"]["version"] = "1.0"; }, "/asset/version");
    broken([](SampleGltf& s) { s.json["images"][0]["bufferView"] = 0; }, "/images/0: neither PNG nor JPEG");
}

TEST(ReadScene, DecodesBlendAndColourOnRequest) {
    SampleGltf sample = SampleGltf::maskedQuad();
    sample.material()["alphaMode"] = "BLEND";
    EXPECT_FALSE(sample.read()->images[0].alpha);
    io::ReadOptions options;
    options.blendAlpha = true;
    options.colour = true;
    const Result<scene::Scene> scene = sample.read(options);
    EXPECT_TRUE(scene->images[0].alpha);
    ASSERT_TRUE(scene->images[0].colour);
    EXPECT_EQ(scene->images[0].colour->rgba.size(), 64U);
}

TEST(ReadScene, KeepsToItsMemory) {
    io::ReadOptions options;
    options.maxBytes = 100;
    expectError(SampleGltf::maskedQuad().read(options), ErrorKind::limit, "100");
}

}  // namespace
}  // namespace filigree::tests
