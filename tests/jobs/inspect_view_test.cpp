#include "jobs/inspect_view.h"

#include "filigree/jobs/bake.h"
#include "filigree/micromap/quadtree.h"

#include "jobs/cell_map.h"
#include "jobs/overlaps.h"
#include "jobs/small_scene.h"
#include "micromap/random_micromap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::jobs {
namespace {

using micromap::Format;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

// Reads a CellMap as map_view.h lays it out, for all cells at its level.
class CellReader {
  public:
    explicit CellReader(const report::CellMap& map) : map_(map) {}

    std::vector<unsigned> read() {
        if (map_.inner.empty() && map_.finest.empty()) {
            for (unsigned s = 0; s < 4; ++s) {
                if (map_.cells[s] > 0) cells_.assign(micromap::microTriangleCount(map_.level), s);
            }
        } else {
            readNode(map_.level);
        }
        EXPECT_EQ(inner_, map_.inner.size());
        EXPECT_EQ(finest_, map_.finest.size());
        return cells_;
    }

  private:
    void readNode(unsigned height) {
        if (height == 1) {
            const uint8_t code = map_.finest.at(finest_++);
            for (unsigned k = 0; k < 4; ++k) cells_.push_back((code >> (2 * k)) & 3U);
            return;
        }
        const uint8_t mask = map_.inner.at(inner_++);
        const uint8_t states = map_.inner.at(inner_++);
        for (unsigned k = 0; k < 4; ++k) {
            if ((mask >> k & 1U) != 0) {
                readNode(height - 1);
            } else {
                cells_.insert(cells_.end(), micromap::microTriangleCount(height - 1),
                              (states >> (2 * k)) & 3U);
            }
        }
    }

    const report::CellMap& map_;
    size_t inner_ = 0;
    size_t finest_ = 0;
    std::vector<unsigned> cells_;
};

TEST(CellMap, holdsEveryStateOfItsRecord) {
    std::mt19937 random(5);
    for (unsigned level = 0; level <= 6; ++level) {
        for (const Format format : {Format::twoState, Format::fourState}) {
            micromap::FlatSet set;
            set.data = tests::randomFlat(level, 0.3, random);
            set.records = {{0, static_cast<uint16_t>(level), format}};
            const report::CellMap map = cellMap(set, 0, 12);
            EXPECT_EQ(map.states, format == Format::twoState ? 2U : 4U);
            EXPECT_EQ(map.bytes, micromap::flatBytes(level, format) + micromap::recordBytes);
            const auto cells = CellReader(map).read();
            ASSERT_EQ(cells.size(), micromap::microTriangleCount(level));
            for (size_t k = 0; k < cells.size(); ++k)
                ASSERT_EQ(cells[k], static_cast<unsigned>(micromap::flatState(set, set.records[0], k)))
                    << level;
        }
    }
}

TEST(CellMap, mergesLevelsBeyondTheMost) {
    std::mt19937 random(6);
    micromap::FlatSet set;
    set.data = tests::randomFlat(5, 0.2, random);
    set.records = {{0, 5, Format::fourState}};
    const report::CellMap map = cellMap(set, 0, 3);
    EXPECT_EQ(map.level, 3U);
    EXPECT_EQ(map.storedLevel, 5U);
    EXPECT_EQ(map.cells[0] + map.cells[1] + map.cells[2] + map.cells[3], micromap::microTriangleCount(5));
    EXPECT_EQ(CellReader(map).read().size(), micromap::microTriangleCount(3));
}

OverlayTriangle corner(float size) {
    return {{mesh::Uv{0, 0}, mesh::Uv{size, 0}, mesh::Uv{0, size}}, nullptr, -1};
}

TEST(Overlaps, countTrianglesOverTexels) {
    image::AlphaTexture texture;
    texture.image = image::AlphaImage{4, 4, std::vector<uint16_t>(16, 0)};
    EXPECT_THAT(overlapShares(texture, {}), ElementsAre(Pair(0, 1.0)));
    texture.wrapU = texture.wrapV = image::Wrap::clampToEdge;
    EXPECT_THAT(overlapShares(texture, {corner(2)}), ElementsAre(Pair(1, 1.0)));
    const auto shares = overlapShares(texture, {corner(2), corner(0.5), corner(0.5)});
    EXPECT_EQ(shares.at(1) + shares.at(3), 1.0);
    EXPECT_GE(shares.at(3), 1.0 / 16);
    // With copies the parts beyond the tile lie over it again: 4 tiles hold half of theirs.
    texture.wrapU = texture.wrapV = image::Wrap::repeat;
    EXPECT_EQ(overlapShares(texture, {corner(2)}).rbegin()->first, 3U);
}

scene::Scene baked(unsigned level) {
    scene::Scene scene = tests::sceneOf({tests::masked(0)});
    BakeParameters parameters;
    parameters.level = level;
    EXPECT_TRUE(bakeScene(scene, parameters, serialExecutor(), silentProgress()).ok());
    return scene;
}

report::MapView viewOf(const scene::Scene& scene, const ViewBudget& budget) {
    std::vector<std::string> notes;
    const auto groups = textureGroups(scene, notes);
    const InspectedTexture measured = measure(scene, groups.at(0));
    auto view = inspectView(scene, std::vector{ViewInput{groups[0], measured}}, budget, serialExecutor());
    EXPECT_TRUE(view.ok());
    return std::move(*view);
}

TEST(InspectView, holdsDistinctTrianglesAndTheirMaps) {
    const report::MapView view = viewOf(baked(4), {});
    ASSERT_EQ(view.textures.size(), 1U);
    EXPECT_EQ(view.textures[0].width, 16U);
    EXPECT_EQ(view.textures[0].shownTriangles, 2U);
    EXPECT_EQ(view.textures[0].maps, 2U);
    EXPECT_THAT(view.textures[0].note, IsEmpty());
}

TEST(InspectView, leavesDetailOutRatherThanGrow) {
    const auto scene = baked(8);
    const size_t whole = viewOf(scene, noViewBudget).textures[0].packedMaps.size();
    const report::MapView small = viewOf(scene, {4'000, 2'000'000, 4'000 + whole / 2});
    EXPECT_LE(small.textures[0].packedMaps.size(), 4'000 + whole / 2);
    const report::MapView tiny = viewOf(scene, {1, 1, 1});
    EXPECT_THAT(tiny.textures[0].note, HasSubstr("level"));
    EXPECT_THAT(tiny.textures[0].note, HasSubstr("first 1 of 2 distinct triangles"));
    EXPECT_LT(tiny.textures[0].packedMaps.size(), whole);
}

}  // namespace
}  // namespace filigree::jobs
