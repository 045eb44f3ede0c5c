// The suites written in C.
#include "capi/suites.h"

#include <gtest/gtest.h>

TEST(FromC, micromaps) {
    EXPECT_EQ(micromapsSuite(), 0);
}

TEST(FromC, sets) {
    EXPECT_EQ(setsSuite(), 0);
}
