// Real scenes for tests. They are not part of the project: tests that use them skip where they are absent.
#pragma once

#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

namespace filigree::tests {

// The folder with the shared data, empty when the environment names none or it does not exist.
inline std::filesystem::path sharedData() {
    const char* folder = std::getenv("FILIGREE_SHARED_DATA");
    std::error_code ignored;
    if (folder == nullptr || !std::filesystem::is_directory(folder, ignored)) return {};
    return folder;
}

}  // namespace filigree::tests

// Skips the running test unless the shared data is there.
#define FILIGREE_NEEDS_SHARED_DATA()                                                        \
    if (filigree::tests::sharedData().empty()) {                                            \
        GTEST_SKIP() << "the shared test data is absent (FILIGREE_SHARED_DATA names none)"; \
    }                                                                                       \
    static_assert(true)
