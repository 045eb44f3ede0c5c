#include "filigree/io/ply.h"

#include "filigree/core/file.h"

#include "temp_folder.h"

#include <bit>
#include <cstring>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

Result<mesh::FaceMesh> parse(const std::string& text) {
    return parsePly({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
}

std::string failureOf(const std::string& text) {
    const auto mesh = parse(text);
    return mesh.ok() ? "no error" : mesh.error().message;
}

const std::string squareHeader =
    "ply\nformat ascii 1.0\ncomment a square\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string squareBody = "0 0 0\n1 0 0\n1 1 0\n0 1 -0.5\n4 0 1 2 3\n";

// A number as it stands in a binary file.
template <class T>
std::string bytesOf(T value, bool bigEndian) {
    std::string bytes(sizeof(T), '\0');
    std::memcpy(bytes.data(), &value, sizeof(T));
    if (bigEndian) bytes.assign(bytes.rbegin(), bytes.rend());
    return bytes;
}

// The same square with everything that must be passed over.
std::string binarySquare(bool bigEndian) {
    std::string file = "ply\r\nformat ";
    file += bigEndian ? "binary_big_endian" : "binary_little_endian";
    file +=
        " 1.0\r\nobj_info nothing\r\nelement material 1\r\nproperty list ushort double numbers\r\n"
        "element vertex 4\r\nproperty uchar red\r\nproperty double x\r\nproperty short y\r\n"
        "property float z\r\nproperty float t\r\nproperty float s\r\nelement face 2\r\nproperty uchar "
        "flags\r\n"
        "property list uchar ushort vertex_index\r\nproperty list uint8 float32 texcoord\r\nend_header\r\n";
    file += bytesOf<uint16_t>(2, bigEndian) + bytesOf(1.0, bigEndian) + bytesOf(2.0, bigEndian);
    for (int k = 0; k < 4; ++k) {
        file += bytesOf<uint8_t>(7, bigEndian) + bytesOf<double>(k % 3 == 0 ? 0 : 1, bigEndian) +
                bytesOf<int16_t>(k < 2 ? 0 : -1, bigEndian) + bytesOf(0.25F, bigEndian) +
                bytesOf(static_cast<float>(k), bigEndian) + bytesOf(-1.0F, bigEndian);
    }
    const auto face = [&](std::initializer_list<uint16_t> corners) {
        file += bytesOf<uint8_t>(1, bigEndian);
        file += bytesOf(static_cast<uint8_t>(corners.size()), bigEndian);
        for (const uint16_t corner : corners) file += bytesOf(corner, bigEndian);
        file += bytesOf<uint8_t>(1, bigEndian) + bytesOf(5.0F, bigEndian);
    };
    face({0, 1, 2, 3});
    face({3, 2, 0});
    return file;
}

TEST(Ply, ReadsText) {
    const auto mesh = parse(squareHeader + squareBody);
    ASSERT_TRUE(mesh.ok()) << mesh.error().message;
    EXPECT_EQ(mesh->positions.size(), 4U);
    EXPECT_EQ(mesh->positions[3], (Vec3{0, 1, -0.5F}));
    EXPECT_THAT(mesh->faces, ElementsAre(mesh::Face{0, 1, 2, 3}));
    EXPECT_TRUE(mesh->normals.empty());
    EXPECT_TRUE(mesh->uvs.empty());
}

TEST(Ply, ReadsBinaryOfBothOrders) {
    for (const bool bigEndian : {false, true}) {
        const auto mesh = parse(binarySquare(bigEndian));
        ASSERT_TRUE(mesh.ok()) << mesh.error().message;
        EXPECT_THAT(mesh->positions, ElementsAre(Vec3{0, 0, 0.25F}, Vec3{1, 0, 0.25F}, Vec3{1, -1, 0.25F},
                                                 Vec3{0, -1, 0.25F}));
        EXPECT_THAT(mesh->faces, ElementsAre(mesh::Face{0, 1, 2, 3}, mesh::Face{3, 2, 0, mesh::noVertex}));
        ASSERT_EQ(mesh->uvs.size(), 4U);
        EXPECT_EQ(mesh->uvs[2], (mesh::Uv{-1, 2}));
    }
}

TEST(Ply, ReadsNormalsAndCutsPolygons) {
    const auto mesh = parse(
        "ply\nformat ascii 1.0\nelement face 2\nproperty list int int vertex_indices\nelement vertex 5\n"
        "property float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\n"
        "property float nz\nend_header\n5 0 1 2 3 4 3 4 3 2\n0 0 0 0 0 1 1 0 0 0 0 1 2 1 0 0 0 1\n"
        "1 2 0 0 0 1 +0 1e0 0 0 0.5 1");
    ASSERT_TRUE(mesh.ok()) << mesh.error().message;
    constexpr uint32_t none = mesh::noVertex;
    EXPECT_THAT(mesh->faces, ElementsAre(mesh::Face{0, 1, 2, none}, mesh::Face{0, 2, 3, none},
                                         mesh::Face{0, 3, 4, none}, mesh::Face{4, 3, 2, none}));
    ASSERT_EQ(mesh->normals.size(), 5U);
    EXPECT_EQ(mesh->normals[4], (Vec3{0, 0.5F, 1}));
    EXPECT_EQ(mesh->triangleCount(), 4U);
}

TEST(Ply, EveryPrefixFails) {
    for (const std::string& file : {squareHeader + squareBody.substr(0, squareBody.size() - 1),
                                    binarySquare(false), binarySquare(true)}) {
        for (size_t length = 0; length < file.size(); ++length)
            EXPECT_NE(failureOf(std::string(file.data(), length)), "no error") << length;
        EXPECT_EQ(failureOf(file), "no error");
        EXPECT_THAT(failureOf(file + "\nx"), HasSubstr("behind the last element"));
    }
}

TEST(Ply, HeadersAreNotBelieved) {
    const auto withLine = [](const std::string& line) {
        return "ply\nformat ascii 1.0\n" + line + "\nend_header\n";
    };
    EXPECT_THAT(failureOf("plx\n"), StartsWith("not a PLY file"));
    EXPECT_THAT(failureOf("ply\nelement vertex 1\n"), HasSubstr("breaks off behind line 2"));
    EXPECT_THAT(failureOf("ply\nend_header\n"), HasSubstr("no line \"format\""));
    EXPECT_THAT(failureOf("ply\nformat ascii 2.0\n"), HasSubstr("header line 2: expected format"));
    EXPECT_THAT(failureOf(withLine("hello")), HasSubstr("header line 3: \"hello\", expected"));
    EXPECT_THAT(failureOf(withLine("element vertex -1")), HasSubstr("header line 3: count \"-1\""));
    EXPECT_THAT(failureOf(withLine("property float x")), HasSubstr("before any element"));
    EXPECT_THAT(failureOf(withLine("element a 1\nproperty half x")), HasSubstr("line 4: a type"));
    EXPECT_THAT(failureOf(withLine("element a 1\nelement a 1")), HasSubstr("a second element \"a\""));
    EXPECT_THAT(failureOf(withLine("element a 1\nproperty int x\nproperty int x")),
                HasSubstr("a second property \"x\""));
    EXPECT_EQ(failureOf(withLine("element face 1")), "no element vertex");
    EXPECT_EQ(failureOf(withLine("element vertex 1")), "no element face");
    EXPECT_EQ(failureOf(withLine("element vertex 1\nproperty int x\nelement face 0")),
              "element vertex: no properties x, y and z");
}

// Swaps a piece of the square's file.
std::string squareWith(const std::string& old, const std::string& piece) {
    std::string file = squareHeader + squareBody;
    return file.replace(file.find(old), old.size(), piece);
}

TEST(Ply, CountsAreNotBelieved) {
    EXPECT_THAT(failureOf(squareWith("vertex 4", "vertex 4000000000")),
                HasSubstr("element vertex: 4000000000 of them, more than the file can hold"));
    EXPECT_THAT(failureOf(squareWith("vertex 4", "vertex 99999999999")), HasSubstr("99999999999 vertices"));
    EXPECT_THAT(failureOf(squareWith("vertex 4", "vertex 3")), StartsWith("face 0: "));
    EXPECT_EQ(failureOf(squareWith("vertex 4", "vertex 5")), "face 0: the file ends");
    EXPECT_EQ(failureOf(squareWith("face 1", "face 2")), "face 1: the file ends");
    EXPECT_THAT(failureOf(squareWith("4 0 1 2 3", "200 0 1 2 3")), StartsWith("face 0: the file ends"));
    EXPECT_EQ(failureOf(squareWith("element face", "element void 99999999999999\nelement face")), "no error");
}

TEST(Ply, BrokenValuesAreNamed) {
    EXPECT_EQ(failureOf(squareWith("1 1 0\n", "1 nan 0\n")), "vertex 2: y is nan, expected finite");
    EXPECT_EQ(failureOf(squareWith("1 1 0\n", "-inf 1 0\n")), "vertex 2: x is -inf, expected finite");
    EXPECT_EQ(failureOf(squareWith("1 1 0\n", "1 one 0\n")),
              "vertex 2: a word that is no number of its type");
    EXPECT_EQ(failureOf(squareWith("1 2 3\n", "1 2 4\n")), "face 0: vertex 4, expected below 4");
    EXPECT_EQ(failureOf(squareWith("1 2 3\n", "1 2 -1\n")), "face 0: vertex -1, expected below 4");
    EXPECT_EQ(failureOf(squareWith("4 0 1 2 3", "2 0 1")), "face 0: 2 corners, expected 3 or more");
    EXPECT_EQ(failureOf(squareWith("4 0 1 2 3", "-4 0 1 2 3")), "face 0: a list of no proper length");
}

TEST(Ply, ErrorsNameTheFile) {
    const tests::TempFolder folder;
    const auto path = folder / "broken.ply";
    ASSERT_TRUE(writeFile(path, std::string_view("ply\n")).ok());
    const auto mesh = readPly(path);
    ASSERT_FALSE(mesh.ok());
    EXPECT_THAT(mesh.error().message, StartsWith(path.string() + ": "));
    EXPECT_EQ(readPly(folder / "absent.ply").error().kind, ErrorKind::file);
}

}  // namespace
}  // namespace filigree::io
