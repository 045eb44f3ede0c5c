#include "filigree/core/file.h"

#include "filigree/core/mapped_file.h"

#include <cstdlib>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace filigree {
namespace {

using testing::HasSubstr;

// A new folder that goes with the test.
class FileTest : public testing::Test {
  protected:
    void SetUp() override {
        std::string pattern = (std::filesystem::temp_directory_path() / "filigree-core.XXXXXX").string();
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    [[nodiscard]] size_t filesHere() const {
        return static_cast<size_t>(std::distance(std::filesystem::directory_iterator(folder_), {}));
    }
    static std::string textOf(const std::filesystem::path& path) {
        const auto bytes = readFile(path);
        return bytes ? std::string(bytes->begin(), bytes->end()) : bytes.error().message;
    }

    std::filesystem::path folder_;
};

TEST_F(FileTest, WhatIsWrittenIsRead) {
    const auto path = folder_ / "a file";
    for (const size_t size : {0U, 1U, 4096U, 100'001U}) {
        const std::string text(size, 'x');
        ASSERT_TRUE(writeFile(path, text).ok());
        EXPECT_EQ(textOf(path), text);
    }
    EXPECT_EQ(filesHere(), 1U);
}

TEST_F(FileTest, WritingReplacesAndKeepsToTheMask) {
    const auto path = folder_ / "file";
    ASSERT_TRUE(writeFile(path, "first").ok());
    ASSERT_TRUE(writeFile(path, "second").ok());
    EXPECT_EQ(textOf(path), "second");
    struct stat info {};
    ASSERT_EQ(::stat(path.c_str(), &info), 0);
    const mode_t mask = ::umask(0);
    ::umask(mask);
    EXPECT_EQ(info.st_mode & 0777, 0666 & ~mask);
}

TEST_F(FileTest, AFolderThatIsNotThereIsNamed) {
    const auto path = folder_ / "none" / "file";
    const Status status = writeFile(path, "text");
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().kind, ErrorKind::file);
    EXPECT_THAT(status.error().message, HasSubstr(path.string()));
    EXPECT_EQ(filesHere(), 0U);
}

TEST_F(FileTest, AFullDeviceIsAnError) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
    const Status status = writeFile("/dev/full", "text");
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().kind, ErrorKind::file);
    EXPECT_THAT(status.error().message, HasSubstr("/dev/full"));
}

TEST_F(FileTest, DevicesCanBeWrittenTo) {
    EXPECT_TRUE(writeFile("/dev/null", "text").ok());
}

TEST_F(FileTest, WhereAFolderStandsNothingIsWritten) {
    const auto path = folder_ / "folder";
    std::filesystem::create_directory(path);
    EXPECT_FALSE(writeFile(path, "text").ok());
    EXPECT_TRUE(std::filesystem::is_directory(path));
    EXPECT_EQ(filesHere(), 1U);
    const auto read = readFile(path);
    ASSERT_FALSE(read.ok());
    EXPECT_THAT(read.error().message, HasSubstr("folder"));
}

TEST_F(FileTest, AnUnwritableFolderLeavesTheOldFile) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
    const auto path = folder_ / "file";
    ASSERT_TRUE(writeFile(path, "old").ok());
    std::filesystem::permissions(folder_,
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    EXPECT_FALSE(writeFile(path, "new").ok());
    EXPECT_EQ(textOf(path), "old");
    std::filesystem::permissions(folder_, std::filesystem::perms::owner_all);
}

TEST_F(FileTest, ReadingStopsAtTheLimit) {
    const auto path = folder_ / "file";
    ASSERT_TRUE(writeFile(path, "0123456789").ok());
    EXPECT_TRUE(readFile(path, 10).ok());
    const auto read = readFile(path, 9);
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.error().kind, ErrorKind::limit);
    // A device tells no size before it is read.
    const auto endless = readFile("/dev/zero", 1000);
    ASSERT_FALSE(endless.ok());
    EXPECT_EQ(endless.error().kind, ErrorKind::limit);
}

TEST_F(FileTest, AMissingFileIsNamed) {
    const auto read = readFile(folder_ / "none");
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.error().kind, ErrorKind::file);
    EXPECT_THAT(read.error().message, HasSubstr("none"));
}

TEST_F(FileTest, PiecesStandOneAfterAnother) {
    const std::vector<uint8_t> a{1, 2};
    const std::vector<uint8_t> b{3};
    const std::vector<std::span<const uint8_t>> pieces{a, {}, b};
    ASSERT_TRUE(writeFile(folder_ / "file", pieces).ok());
    EXPECT_EQ(*readFile(folder_ / "file"), (std::vector<uint8_t>{1, 2, 3}));
}

TEST_F(FileTest, AMappedFileKeepsItsPlaceWhenMoved) {
    ASSERT_TRUE(writeFile(folder_ / "file", "0123456789").ok());
    auto mapped = MappedFile::open(folder_ / "file");
    ASSERT_TRUE(mapped.ok()) << mapped.error().message;
    const uint8_t* const at = mapped->bytes().data();
    const MappedFile moved = std::move(*mapped);
    EXPECT_EQ(moved.bytes().data(), at);
    EXPECT_EQ(std::string(moved.bytes().begin(), moved.bytes().end()), "0123456789");
    EXPECT_TRUE(mapped->bytes().empty());
}

TEST_F(FileTest, OnlyRegularFilesAreMapped) {
    ASSERT_TRUE(writeFile(folder_ / "empty", "").ok());
    const auto empty = MappedFile::open(folder_ / "empty");
    ASSERT_TRUE(empty.ok());
    EXPECT_TRUE(empty->bytes().empty());
    EXPECT_FALSE(MappedFile::open(folder_).ok());
    EXPECT_FALSE(MappedFile::open("/dev/zero").ok());
    EXPECT_FALSE(MappedFile::open(folder_ / "none").ok());
}

}  // namespace
}  // namespace filigree
