#include "filigree/core/result.h"

#include <memory>

#include <gtest/gtest.h>

namespace filigree {
namespace {

TEST(Result, HoldsAValueOrAnError) {
    const Result<int> value = 7;
    EXPECT_TRUE(value.ok());
    EXPECT_EQ(*value, 7);
    const Result<int> error = Error{ErrorKind::limit, "too much"};
    EXPECT_FALSE(error.ok());
    EXPECT_EQ(error.error().kind, ErrorKind::limit);
    EXPECT_EQ(error.error().within("a.glb").message, "a.glb: too much");
    EXPECT_EQ(error.error().within("a.glb").kind, ErrorKind::limit);
}

TEST(Result, TakesWhatOnlyMoves) {
    Result<std::unique_ptr<int>> result = std::make_unique<int>(3);
    const std::unique_ptr<int> taken = std::move(*result);
    EXPECT_EQ(*taken, 3);
}

// A value of the error's own type is still a value.
TEST(Result, KnowsAValueFromAnError) {
    const Result<std::string> text = std::string("fine");
    EXPECT_TRUE(text.ok());
    EXPECT_EQ(text->size(), 4U);
}

TEST(Status, IsFineUntilAnErrorIsGiven) {
    const Status fine;
    EXPECT_TRUE(fine.ok());
    const Status failed = Error{ErrorKind::usage, "no"};
    EXPECT_FALSE(failed.ok());
    EXPECT_EQ(failed.error().message, "no");
}

}  // namespace
}  // namespace filigree
