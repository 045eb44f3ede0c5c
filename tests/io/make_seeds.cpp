// Writes the seeds of the fuzz target gltf_read: make_gltf_seeds FOLDER
#include "filigree/core/file.h"

#include "sample_gltf.h"

#include <cstdio>
#include <map>
#include <string>

namespace filigree::tests {
namespace {

SampleGltf everyFeature() {
    SampleGltf sample = SampleGltf::maskedQuad();
    const size_t colours = sample.accessor(std::vector<uint8_t>(16, 200), 5121, "VEC4", 4);
    sample.json["accessors"][colours]["normalized"] = true;
    sample.primitive()["attributes"]["COLOR_0"] = colours;
    const size_t where = sample.view(std::vector<uint16_t>{1, 3});
    const size_t what = sample.view(std::vector<float>{0.25F, 0.5F, 0.75F, 1});
    sample.json["accessors"][1]["sparse"] = {{"count", 2},
                                             {"indices", {{"bufferView", where}, {"componentType", 5123}}},
                                             {"values", {{"bufferView", what}}}};
    sample.material()["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
        {"offset", {0.5, 0.25}}, {"rotation", 0.5}, {"scale", {2, 0.5}}};
    sample.json["samplers"] = {
        {{"magFilter", 9728}, {"minFilter", 9987}, {"wrapS", 33071}, {"wrapT", 33648}}};
    sample.json["textures"][0]["sampler"] = 0;
    sample.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}}};
    sample.json["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, 3}}, {"rotation", {0, 1, 0, 0}}});
    sample.json["nodes"][0]["children"] = {1};
    return sample;
}

std::vector<uint8_t> bytesOf(const std::string& text) {
    return {text.begin(), text.end()};
}

std::map<std::string, std::vector<uint8_t>> seeds() {
    return {{"masked_quad.glb", SampleGltf::maskedQuad().glb()},
            {"masked_quad.gltf", bytesOf(SampleGltf::maskedQuad().gltf())},
            {"every_feature.glb", everyFeature().glb()},
            {"micromaps.glb", sampleWithMicromaps()}};
}

}  // namespace
}  // namespace filigree::tests

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "make_gltf_seeds FOLDER\n");
        return 2;
    }
    for (const auto& [name, bytes] : filigree::tests::seeds()) {
        const filigree::Status written = filigree::writeFile(std::filesystem::path(argv[1]) / name, bytes);
        if (written) continue;
        std::fprintf(stderr, "%s\n", written.error().message.c_str());
        return 1;
    }
    return 0;
}
