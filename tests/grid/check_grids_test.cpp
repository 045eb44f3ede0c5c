// What check() and checkPlaces() refuse, and that they survive anything.
#include "filigree/core/bytes.h"
#include "filigree/grid/check.h"

#include "sample_grids.h"

#include <random>

#include <gtest/gtest.h>

namespace filigree::grid {
namespace {

using tests::encoded;
using tests::mixedBox;
using tests::optionsFor;

class CheckGrids : public testing::TestWithParam<Codec> {
  protected:
    CheckGrids() : mesh_(mixedBox(12)), grids_(encoded(mesh_, optionsFor(mesh_, GetParam()))) {}

    void expectRefusal(const std::string& part) {
        const Status status = check(grids_, serialExecutor());
        ASSERT_FALSE(status);
        EXPECT_NE(status.error().message.find(part), std::string::npos) << status.error().message;
    }
    void expectMisplaced(const std::string& part) {
        const auto loose = static_cast<uint32_t>(mesh_.looseTriangles.size());
        const Status status = checkPlaces(grids_, mesh_.grids, loose);
        ASSERT_FALSE(status);
        EXPECT_NE(status.error().message.find(part), std::string::npos) << status.error().message;
    }

    GridMesh mesh_;
    EncodedGrids grids_;
};
INSTANTIATE_TEST_SUITE_P(Codecs, CheckGrids, testing::Values(Codec::paper, Codec::lattice),
                         [](const auto& codec) { return std::string(nameOf(codec.param)); });

TEST_P(CheckGrids, RefusesLattices) {
    grids_.lattice.step[1] = 0;
    expectRefusal("the step along y is 0");
    grids_.lattice.step[1] = 1e37;
    expectRefusal("leaves what a float holds");
}

TEST_P(CheckGrids, RefusesMissingSlack) {
    grids_.records.back() = 1;
    expectRefusal("are not zero");
    grids_.records.resize(10);
    expectRefusal("10 bytes");
}

TEST_P(CheckGrids, RefusesOffsetsOutOfOrder) {
    std::swap(grids_.offsets[1], grids_.offsets[2]);
    expectRefusal("record");
    grids_.offsets[1] = 0x7fffffff;
    expectRefusal("record 1");
}

TEST_P(CheckGrids, RefusesAnotherKindOfRecord) {
    grids_.offsets[0] ^= EncodedGrids::clusterBit;
    expectRefusal("record 0");
}

TEST_P(CheckGrids, RefusesBoxesThatDoNotContain) {
    for (auto& high : grids_.nodes[0].high) high.fill(0);
    expectRefusal("node 0");
}

TEST_P(CheckGrids, RefusesExponents) {
    grids_.paper.exponentBase = 200;
    expectRefusal("exponent base 200");
}

TEST_P(CheckGrids, RefusesATableOfOtherGrids) {
    mesh_.grids[0].rows -= 1;
    expectMisplaced("grid");
}

TEST_P(CheckGrids, RefusesMissingAndSurplusTriangles) {
    mesh_.looseTriangles.pop_back();
    expectMisplaced("loose triangles");
    mesh_.looseTriangles.resize(mesh_.looseTriangles.size() + 2);
    expectMisplaced("stands in no record");
    mesh_.looseTriangles.resize(1000000);
    expectMisplaced("too many for");
}

TEST_P(CheckGrids, RefusesQuadsInTwoRecords) {
    // The second of two records of one size becomes the first.
    for (size_t k = 1; k < grids_.offsets.size(); ++k) {
        const auto offset = [&](size_t r) { return size_t{grids_.offsets[r] & 0x7fffffff} * 8; };
        const size_t size = offset(k) - offset(k - 1);
        const size_t end =
            k + 1 < grids_.offsets.size() ? offset(k + 1) : grids_.records.size() - EncodedGrids::recordSlack;
        if (end - offset(k) != size || ((grids_.offsets[k] ^ grids_.offsets[k - 1]) >> 31) != 0) continue;
        std::copy_n(grids_.records.begin() + static_cast<ptrdiff_t>(offset(k - 1)), size,
                    grids_.records.begin() + static_cast<ptrdiff_t>(offset(k)));
        expectMisplaced("stands in two records");
        return;
    }
    GTEST_SKIP() << "no two records of one size follow each other";
}

TEST_P(CheckGrids, SurvivesFlippedBits) {
    std::mt19937 random(1);
    const EncodedGrids whole = grids_;
    const auto loose = static_cast<uint32_t>(mesh_.looseTriangles.size());
    for (int k = 0; k < 400; ++k) {
        grids_ = whole;
        auto* const nodes = reinterpret_cast<uint8_t*>(grids_.nodes.data());
        const size_t nodeBytes = grids_.nodes.size() * sizeof(bvh::Node);
        const uint8_t bit = static_cast<uint8_t>(1U << (random() % 8));
        if (k % 3 == 0)
            nodes[random() % nodeBytes] ^= bit;
        else if (k % 3 == 1)
            grids_.offsets[random() % grids_.offsets.size()] ^= 1U << (random() % 32);
        else
            grids_.records[random() % grids_.records.size()] ^= bit;
        if (check(grids_, serialExecutor())) static_cast<void>(checkPlaces(grids_, mesh_.grids, loose).ok());
    }
}

TEST_P(CheckGrids, RefusesShortRecords) {
    const EncodedGrids whole = grids_;
    for (size_t size = 0; size + 1 < whole.records.size(); size += 61) {
        grids_ = whole;
        grids_.records.assign(whole.records.begin(), whole.records.begin() + static_cast<ptrdiff_t>(size));
        grids_.records.shrink_to_fit();
        EXPECT_FALSE(check(grids_, serialExecutor())) << size;
    }
}

}  // namespace
}  // namespace filigree::grid
