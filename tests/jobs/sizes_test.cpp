// What every encoding takes on the demo's scene, to the byte: sizes.csv. A change of it is a change of a
// format or of the bake, and shows in the diff.
#include "filigree/core/file.h"
#include "filigree/jobs/compare.h"

#include "io/temp_folder.h"
#include "jobs/demo_scene.h"

#include <cstdlib>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace filigree::jobs {
namespace {

std::string tableOf(const CompareSummary& summary) {
    std::string table = "scene,states,level,method,maps,payload_bytes,descriptor_bytes,index_bytes\n";
    for (const CompareRow& row : summary.rows) {
        table += fmt::format("{},{},{},{},{},{},{},{}\n", summary.scene, row.states, row.level, row.method,
                             row.maps, row.payloadBytes, row.descriptorBytes, row.indexBytes);
    }
    return table;
}

TEST(Sizes, AreThoseOfTheTable) {
    const auto demo = makeDemoScene();
    ASSERT_TRUE(demo.ok()) << demo.error().message;
    const tests::TempFolder folder;
    CompareOptions options;
    options.input = folder / "demo.glb";
    options.levels = {3, 4, 6, 7, 8};
    ASSERT_TRUE(writeFile(options.input, *demo).ok());
    const auto summary = compare(options, serialExecutor(), silentProgress());
    ASSERT_TRUE(summary.ok()) << summary.error().message;
    const std::string table = tableOf(*summary);
    if (std::getenv("FILIGREE_UPDATE") != nullptr) {
        ASSERT_TRUE(writeFile(FILIGREE_SIZES_FILE, table).ok());
    }
    const auto expected = readFile(FILIGREE_SIZES_FILE);
    ASSERT_TRUE(expected.ok()) << expected.error().message;
    EXPECT_EQ(table, std::string(expected->begin(), expected->end()))
        << "if this is meant, write the table anew: FILIGREE_UPDATE=1 test_jobs --gtest_filter='Sizes.*'";
}

}  // namespace
}  // namespace filigree::jobs
