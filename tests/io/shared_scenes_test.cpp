// The real scenes, read and written.
#include "filigree/io/gltf_rules.h"
#include "filigree/io/gltf_write.h"

#include "sample_gltf.h"
#include "shared_data.h"
#include "temp_folder.h"

#include <chrono>
#include <map>

namespace filigree::tests {
namespace {

class SharedScenes : public testing::TestWithParam<const char*> {};

bool isMasked(const scene::Scene& scene, const scene::Primitive& primitive) {
    return primitive.material >= 0 &&
           scene.materials[static_cast<size_t>(primitive.material)].alphaMode == scene::AlphaMode::mask;
}

// Indices that use records and special ones, enough to need 8 and 16 bits.
std::map<const scene::Primitive*, std::vector<int32_t>> syntheticIndices(const scene::Scene& scene,
                                                                         int32_t records) {
    std::map<const scene::Primitive*, std::vector<int32_t>> indices;
    for (const scene::Mesh& mesh : scene.meshes) {
        for (const scene::Primitive& primitive : mesh.primitives) {
            if (!isMasked(scene, primitive)) continue;
            std::vector<int32_t>& of = indices[&primitive];
            for (size_t t = 0; t < primitive.triangleCount(); ++t) {
                of.push_back(static_cast<int32_t>(t % static_cast<size_t>(records + 4)) - 4);
            }
        }
    }
    return indices;
}

TEST_P(SharedScenes, KeepMicromapsThroughAFile) {
    FILIGREE_NEEDS_SHARED_DATA();
    const TempFolder folder;
    const auto start = std::chrono::steady_clock::now();
    const Result<io::GltfDocument> document =
        io::GltfDocument::load(sharedData() / "data" / "scenes" / GetParam());
    ASSERT_TRUE(document) << document.error().message;
    const Result<scene::Scene> scene = io::readScene(*document);
    ASSERT_TRUE(scene) << scene.error().message;
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    RecordProperty("read_seconds", std::to_string(seconds.count()));
    EXPECT_TRUE(io::checkRules(*document).empty());

    const micromap::FlatSet set = sampleSet(3, 300);
    const auto indices = syntheticIndices(*scene, 300);
    io::MicromapOutput output;
    output.micromaps.push_back({"synthetic", &set, {}});
    for (const auto& [primitive, values] : indices) {
        output.primitives.push_back({primitive->meshIndex, primitive->primitiveIndex, 0, values, {}});
    }
    ASSERT_FALSE(output.primitives.empty());
    const Status written = io::writeWithMicromaps(*document, output, folder / "out.glb");
    ASSERT_TRUE(written) << written.error().message;

    const Result<io::GltfDocument> again = io::GltfDocument::load(folder / "out.glb");
    ASSERT_TRUE(again) << again.error().message;
    for (const io::Breach& breach : io::checkRules(*again))
        ADD_FAILURE() << breach.path << ": " << breach.message;
    const Result<scene::Scene> read = io::readScene(*again);
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->micromaps.size(), 1U);
    EXPECT_EQ(read->micromaps[0].set.data, set.data);
    for (const auto& [primitive, values] : indices) {
        for (const scene::Primitive& other : read->meshes[primitive->meshIndex].primitives) {
            if (other.primitiveIndex != primitive->primitiveIndex) continue;
            EXPECT_EQ(other.micromapIndices, values);
            EXPECT_EQ(other.indices, primitive->indices);
            EXPECT_EQ(other.uvs, primitive->uvs);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Io, SharedScenes,
                         testing::Values("crytek_sponza.glb", "0ad_forest_temperate.glb",
                                         "sh3d_nets_and_plants.glb", "stk_black_forest.glb"));

}  // namespace
}  // namespace filigree::tests
