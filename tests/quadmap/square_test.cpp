#include "filigree/quadmap/square.h"

#include <gtest/gtest.h>

namespace filigree::quadmap {
namespace {

TEST(Square, SavingsLeaveFreeRegionsOut) {
    Square square(4, Region::free);
    EXPECT_EQ(savings(square), 0);
    square.at(0, 0) = Region::opaque;
    square.at(1, 0) = Region::transparent;
    square.at(2, 0) = Region::mixed;
    square.at(3, 3) = Region::mixed;
    EXPECT_EQ(savings(square), 0.5);
}

TEST(Square, SubstitutionsAreKnownRegionsMadeMixed) {
    Square source(2, Region::opaque);
    source.at(1, 1) = Region::free;
    EXPECT_EQ(substitutions(source, Square(2)), 3u);
    EXPECT_TRUE(isConservative(source, Square(2)));
    EXPECT_TRUE(isConservative(source, Square(2, Region::opaque)));
    EXPECT_FALSE(isConservative(source, Square(2, Region::transparent)));
}

}  // namespace
}  // namespace filigree::quadmap
