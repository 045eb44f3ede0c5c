#include "sample_gltf.h"

#include "filigree/core/file.h"
#include "filigree/io/image_file.h"

#include "io/glb.h"
#include "io/uri.h"
#include "temp_folder.h"

#include <array>

namespace filigree::tests {

using io::Json;

SampleGltf SampleGltf::maskedQuad() {
    SampleGltf sample;
    sample.json = Json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}], "meshes": [], "materials": [{"alphaMode": "MASK", "pbrMetallicRoughness":
        {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}], "images": [], "accessors": [],
        "bufferViews": [], "buffers": []})");
    const size_t positions =
        sample.accessor(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, 5126, "VEC3", 4);
    sample.json["accessors"][positions]["min"] = {0, 0, 0};
    sample.json["accessors"][positions]["max"] = {1, 1, 0};
    const size_t uvs = sample.accessor(std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0}, 5126, "VEC2", 4);
    const size_t indices = sample.accessor(std::vector<uint16_t>{0, 1, 2, 0, 2, 3}, 5123, "SCALAR", 6);
    const Json primitive = {{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}},
                            {"indices", indices},
                            {"material", 0}};
    sample.json["meshes"].push_back({{"primitives", Json::array({primitive})}});
    const size_t image = sample.viewOfBytes(samplePng());
    sample.json["images"].push_back({{"bufferView", image}, {"mimeType", "image/png"}});
    return sample;
}

size_t SampleGltf::viewOfBytes(const std::vector<uint8_t>& bytes) {
    buffer.resize((buffer.size() + 3) / 4 * 4);
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}});
    buffer.insert(buffer.end(), bytes.begin(), bytes.end());
    return json["bufferViews"].size() - 1;
}

std::vector<uint8_t> SampleGltf::glb() const {
    Json copy = json;
    copy["buffers"] = Json::array({{{"byteLength", buffer.size()}}});
    const std::array<std::span<const uint8_t>, 1> binary{buffer};
    return io::makeGlb(copy.dump(), binary, {}).value();
}

std::string SampleGltf::gltf() const {
    Json copy = json;
    copy["buffers"] = Json::array(
        {{{"byteLength", buffer.size()}, {"uri", io::makeDataUri("application/octet-stream", buffer)}}});
    return copy.dump(2);
}

Result<scene::Scene> SampleGltf::read(const io::ReadOptions& options) const {
    const Result<io::GltfDocument> document = parse();
    if (!document) return document.error();
    return io::readScene(*document, options);
}

std::vector<uint8_t> samplePng() {
    scene::ColourImage image{4, 4, std::vector<uint8_t>(4 * 4 * 4, 255)};
    for (size_t i = 0; i < 16; ++i) image.rgba[4 * i + 3] = i % 4 < 2 ? 0 : 255;
    return io::encodePng(image).value();
}

micromap::FlatSet sampleSet(unsigned level, size_t records) {
    micromap::FlatSet set;
    const size_t bytes = micromap::flatBytes(level, micromap::Format::fourState);
    for (size_t i = 0; i < records; ++i) {
        set.records.push_back({static_cast<uint32_t>(i * bytes), static_cast<uint16_t>(level)});
    }
    set.data.resize(records * bytes);
    for (size_t i = 0; i < set.data.size(); ++i) set.data[i] = static_cast<uint8_t>(i * 37 + 1);
    return set;
}

std::vector<uint8_t> sampleWithMicromaps() {
    const TempFolder folder;
    const micromap::FlatSet set = sampleSet(2, 2);
    const std::vector<int32_t> indices{1, -2};
    io::MicromapOutput output;
    output.micromaps.push_back({"leaf", &set, {}});
    output.primitives.push_back({0, 0, 0, indices, {}});
    const Result<io::GltfDocument> document = SampleGltf::maskedQuad().parse();
    const Status written = io::writeWithMicromaps(*document, output, folder / "out.glb");
    return written ? readFile(folder / "out.glb").value() : std::vector<uint8_t>();
}

}  // namespace filigree::tests
