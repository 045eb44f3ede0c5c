#include "filigree/core/target.h"

#include <cstdio>

#include <gtest/gtest.h>

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    if (const filigree::Status forced = filigree::forceTargetFromEnvironment(); !forced) {
        std::fprintf(stderr, "%s\n", forced.error().message.c_str());
        return 1;
    }
    return RUN_ALL_TESTS();
}
