// The suites written in C.
#include "capi/suites.h"

#include <gtest/gtest.h>

TEST(FromC, micromaps) {
    EXPECT_EQ(micromapsSuite(), 0);
}

TEST(FromC, sets) {
    EXPECT_EQ(setsSuite(), 0);
}

TEST(FromC, squares) {
    EXPECT_EQ(squaresSuite(), 0);
}

TEST(FromC, grids) {
    EXPECT_EQ(gridsSuite(), 0);
}

TEST(FromC, containers) {
    EXPECT_EQ(containersSuite(), 0);
}

TEST(FromC, context) {
    EXPECT_EQ(contextSuite(), 0);
}

TEST(FromC, memory) {
    EXPECT_EQ(memorySuite(), 0);
}

TEST(FromC, badInput) {
    EXPECT_EQ(badInputSuite(), 0);
}
