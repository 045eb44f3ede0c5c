// The encodings on the real scenes.
#include "filigree/encoding/bitmask.h"
#include "filigree/encoding/map_reader.h"
#include "filigree/verify/verify.h"

#include "jobs/encode_scene.h"
#include "jobs/level_sweep.h"
#include "shared_data.h"

#include <cstdlib>
#include <numeric>

namespace filigree::jobs {
namespace {

using encoding::Encoding;
using micromap::Format;
using micromap::State;

bool isFull() {
    return std::getenv("FILIGREE_FULL") != nullptr;
}

// All that give back what went in.
constexpr std::array lossless{Encoding::flat, Encoding::tree, Encoding::indexedTree, Encoding::dag,
                              Encoding::sdag};

class SceneEncodings : public testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        FILIGREE_NEEDS_SHARED_DATA();
        input_ = tests::sharedData() / "data" / "scenes" / (std::string(GetParam()) + ".glb");
        auto scene = readUnbaked(input_, {});
        ASSERT_TRUE(scene.ok()) << scene.error().message;
        scene_ = std::move(*scene);
    }

    SceneMaps bakedAt(unsigned level, unsigned states) {
        auto maps = bakeAt(scene_, input_, {}, level, states, *executor_, silentProgress());
        EXPECT_TRUE(maps.ok()) << maps.error().message;
        return maps.ok() ? std::move(*maps) : SceneMaps{};
    }

    void expectRoundTrip(const SceneMaps& maps, Encoding encoding) {
        SCOPED_TRACE(std::string(nameOf(encoding)));
        const auto set = encodeMaps(scene_, maps, encoding, maps.format, *executor_);
        ASSERT_TRUE(set.ok()) << set.error().message;
        const auto reader = encoding::openReader(viewOf(*set));
        ASSERT_TRUE(reader.ok()) << reader.error().message;
        ASSERT_EQ((*reader)->mapCount(), maps.maps.size());
        for (uint32_t map = 0; map < maps.maps.size(); ++map)
            ASSERT_TRUE(equal((*reader)->decode(map).view(), maps.maps[map])) << "map " << map;
    }

    std::filesystem::path input_;
    scene::Scene scene_;
    std::unique_ptr<Executor> executor_ = makeThreadedExecutor(0);
};

TEST_P(SceneEncodings, GiveBackEveryMap) {
#ifdef __SANITIZE_ADDRESS__
    std::vector<unsigned> levels{4};
#else
    std::vector<unsigned> levels{4, 6};
#endif
    if (isFull()) {
        levels.resize(10);
        std::iota(levels.begin(), levels.end(), 1u);
    }
    for (const unsigned level : levels) {
        for (const unsigned states : {2u, 4u}) {
            SCOPED_TRACE(testing::Message() << "level " << level << ", " << states << " states");
            const SceneMaps maps = bakedAt(level, states);
            ASSERT_GT(maps.maps.size(), 0u);
            for (const Encoding encoding : lossless) {
                expectRoundTrip(maps, encoding);
                if (HasFailure()) return;
            }
        }
    }
}

// The two triangles of the square that cell (x, y) of a texture covers.
void appendCell(const encoding::BitmaskAxis& u, const encoding::BitmaskAxis& v, uint32_t x, uint32_t y,
                std::vector<mesh::UvTriangle>& to) {
    const auto place = [](const encoding::BitmaskAxis& axis, uint32_t cell) {
        const double texel = static_cast<double>(axis.firstCell() + cell) + (axis.betweenTexels ? 0.5 : 0);
        return static_cast<float>(texel / axis.size);
    };
    const float left = place(u, x), right = place(u, x + 1), top = place(v, y), bottom = place(v, y + 1);
    to.push_back({{{{left, top}, {right, top}, {right, bottom}}}});
    to.push_back({{{{left, top}, {right, bottom}, {left, bottom}}}});
}

// The judge sees each cell as triangles of level 0. Half of the guard is left to the rounding of their
// corners, and one cell in so many is enough.
constexpr double judgedShare = 1.0 / 8;

void expectConservative(const encoding::BitmaskReader& reader, uint32_t texture,
                        const image::AlphaTexture& image, image::AlphaTest test, const Executor& executor) {
    const auto u = reader.axisU(texture);
    const auto v = reader.axisV(texture);
    std::vector<mesh::UvTriangle> triangles;
    micromap::FlatSet set;
    for (uint32_t y = 0; y < v.cells(); ++y) {
        for (uint32_t x = 0; x < u.cells(); ++x) {
            const auto middle = [](const encoding::BitmaskAxis& axis, uint32_t cell) {
                const double half = axis.betweenTexels ? 1 : 0.5;
                return static_cast<float>((static_cast<double>(axis.firstCell() + cell) + half) / axis.size);
            };
            const State state = reader.at(texture, middle(u, x), middle(v, y));
            appendCell(u, v, x, y, triangles);
            set.indices.insert(set.indices.end(), 2, micromap::specialIndex(state));
        }
    }
    test.guard /= 2;
    verify::DeepSettings settings;
    settings.sample = judgedShare;
    const auto counts = verify::deepCheck(triangles, set, image, test, settings, executor, silentProgress());
    ASSERT_TRUE(counts.ok()) << counts.error().message;
    EXPECT_EQ(counts->wrong, 0u);
    EXPECT_GT(counts->microTriangles, 0u);
}

TEST_P(SceneEncodings, BitmasksAreNeverWrong) {
    if (!isFull()) GTEST_SKIP() << "long: ./check --full";
    const SceneMaps maps = bakedAt(0, 4);
    const auto set = encodeMaps(scene_, maps, Encoding::bitmask, Format::fourState, *executor_);
    ASSERT_TRUE(set.ok()) << set.error().message;
    const auto reader = encoding::BitmaskReader::open(viewOf(*set));
    ASSERT_TRUE(reader.ok()) << reader.error().message;
    for (uint32_t k = 0; k < maps.groups.size(); ++k) {
        SCOPED_TRACE(maps.groups[k].name);
        expectConservative(*reader, k, textureOf(scene_, *maps.groups[k].source), *maps.groups[k].test,
                           *executor_);
    }
}

INSTANTIATE_TEST_SUITE_P(Shared, SceneEncodings,
                         testing::Values("0ad_forest_temperate", "crytek_sponza", "sh3d_nets_and_plants",
                                         "stk_black_forest"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace filigree::jobs
