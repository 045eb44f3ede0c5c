#include "filigree/io/fil.h"

#include "filigree/core/file.h"

#include "io/zstd_bytes.h"
#include "sample_fil.h"
#include "temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filigree::io {
namespace {

using testing::ElementsAreArray;
using testing::HasSubstr;
using tests::resealFil;
using tests::SampleFil;
using Bytes = std::vector<uint8_t>;

Bytes written(const FilContents& contents, bool zstd) {
    const tests::TempFolder folder;
    const auto size = writeFil(folder / "x.fil", contents, zstd);
    EXPECT_TRUE(size.ok()) << size.error().message;
    auto bytes = readFile(folder / "x.fil");
    if (!size || !bytes) return {};
    EXPECT_EQ(bytes->size(), *size);
    return *bytes;
}

std::string parseError(Bytes bytes, const FilReadOptions& options = {}) {
    bytes.shrink_to_fit();
    const auto file = FilFile::parse(std::move(bytes), "x.fil", options);
    return file ? "" : file.error().message;
}

void expectSame(const FilFile& file, const FilContents& contents) {
    EXPECT_EQ(file.meta().asset, contents.meta.asset);
    EXPECT_EQ(file.meta().level, contents.meta.level);
    ASSERT_EQ(file.meta().groups.size(), contents.meta.groups.size());
    for (size_t k = 0; k < contents.meta.groups.size(); ++k) {
        const auto& test = file.meta().groups[k].test;
        const auto& expected = contents.meta.groups[k].test;
        EXPECT_EQ(file.meta().groups[k].name, contents.meta.groups[k].name);
        ASSERT_EQ(test.has_value(), expected.has_value());
        if (!test) continue;
        EXPECT_EQ(test->mode, expected->mode);
        EXPECT_EQ(test->mips, expected->mips);
        EXPECT_EQ(test->cutoff, expected->cutoff);
        EXPECT_EQ(test->factor, expected->factor);
        EXPECT_EQ(test->guard, expected->guard);
    }
    ASSERT_EQ(file.meta().primitives.size(), contents.meta.primitives.size());
    for (size_t k = 0; k < contents.meta.primitives.size(); ++k) {
        EXPECT_EQ(file.meta().primitives[k].mesh, contents.meta.primitives[k].mesh);
        EXPECT_EQ(file.meta().primitives[k].primitive, contents.meta.primitives[k].primitive);
        EXPECT_EQ(file.meta().primitives[k].triangles, contents.meta.primitives[k].triangles);
        EXPECT_EQ(file.meta().primitives[k].group, contents.meta.primitives[k].group);
    }
    EXPECT_EQ(file.set().encoding, contents.set.encoding);
    EXPECT_EQ(file.set().format, contents.set.format);
    EXPECT_EQ(file.set().mapCount, contents.set.mapCount);
    EXPECT_THAT(file.set().descriptors, ElementsAreArray(contents.set.descriptors));
    EXPECT_THAT(file.set().payload, ElementsAreArray(contents.set.payload));
    EXPECT_THAT(file.pairs(), ElementsAreArray(contents.pairs));
    std::vector<int32_t> indices(contents.indices.size());
    file.readIndices(0, indices);
    EXPECT_THAT(indices, ElementsAreArray(contents.indices));
}

TEST(Fil, WhatIsWrittenIsRead) {
    const tests::TempFolder folder;
    for (const uint32_t maps : {0u, 1u, 4u, 6u, 13u, 500u}) {
        for (const bool zstd : {false, true}) {
            const SampleFil sample(maps, maps % 2 == 0 && maps > 0);
            ASSERT_TRUE(writeFil(folder / "x.fil", sample.contents, zstd).ok());
            const auto file = FilFile::read(folder / "x.fil");
            ASSERT_TRUE(file.ok()) << file.error().message;
            expectSame(*file, sample.contents);
            EXPECT_EQ(file->fileBytes(), std::filesystem::file_size(folder / "x.fil"));
        }
    }
}

TEST(Fil, PlainSectionsAreUsedInPlace) {
    const Bytes bytes = written(SampleFil().contents, false);
    auto file = FilFile::parse(bytes, "x.fil");
    ASSERT_TRUE(file.ok());
    const FilFile moved = std::move(*file);
    const auto distance = moved.set().payload.data() - moved.set().descriptors.data();
    EXPECT_EQ(distance, 64);
    EXPECT_LT(written(SampleFil().contents, true).size(), bytes.size());
}

TEST(Fil, IndicesTakeTheFewestWholeBits) {
    using encoding::Encoding;
    EXPECT_EQ(filIndexBits(Encoding::sdag, 0), 2u);
    EXPECT_EQ(filIndexBits(Encoding::sdag, 1), 3u);
    EXPECT_EQ(filIndexBits(Encoding::sdag, 4), 3u);
    EXPECT_EQ(filIndexBits(Encoding::flat, 5), 4u);
    EXPECT_EQ(filIndexBits(Encoding::flat, INT32_MAX), 32u);
    EXPECT_EQ(filIndexBits(Encoding::bitmask, 5), 0u);
    EXPECT_EQ(filIndexBytes(Encoding::tree, 4, 21), 8u);
}

TEST(Fil, WidestIndices) {
    SampleFil sample;
    sample.contents.set.mapCount = INT32_MAX;
    sample.contents.pairs = {};
    const std::vector<int32_t> indices{-1, INT32_MAX - 1, 0, -4, 1, INT32_MAX - 1, -2};
    sample.contents.indices = indices;
    sample.contents.meta.primitives = {{0, 0, 7, 0}};
    const auto file = FilFile::parse(written(sample.contents, false), "x.fil");
    ASSERT_TRUE(file.ok()) << file.error().message;
    std::vector<int32_t> some(3);
    file->readIndices(4, some);
    EXPECT_THAT(some, testing::ElementsAre(1, INT32_MAX - 1, -2));
}

TEST(Fil, EveryPrefixAndSurplusFails) {
    for (const bool zstd : {false, true}) {
        Bytes bytes = written(SampleFil().contents, zstd);
        ASSERT_EQ(parseError(bytes), "");
        for (size_t size = 0; size < bytes.size(); ++size)
            EXPECT_NE(parseError({bytes.data(), bytes.data() + size}), "") << size;
        bytes.push_back(0);
        EXPECT_THAT(parseError(bytes), HasSubstr("bytes"));
        resealFil(bytes);
        EXPECT_THAT(parseError(bytes), HasSubstr("after the last section"));
    }
}

TEST(Fil, EveryFlippedBitIsFound) {
    for (const bool zstd : {false, true}) {
        Bytes bytes = written(SampleFil().contents, zstd);
        for (size_t bit = 0; bit < bytes.size() * 8; ++bit) {
            bytes[bit / 8] ^= static_cast<uint8_t>(1U << (bit % 8));
            EXPECT_NE(parseError(bytes), "") << bit;
            bytes[bit / 8] ^= static_cast<uint8_t>(1U << (bit % 8));
        }
    }
}

TEST(Fil, AnErrorNamesFileAndPlace) {
    const Bytes good = written(SampleFil().contents, false);
    const auto changed = [&](size_t at, uint8_t value) {
        Bytes bytes = good;
        bytes[at] = value;
        resealFil(bytes);
        return parseError(bytes);
    };
    const size_t entries = filHeaderBytes;
    const size_t meta = loadLe<uint64_t>(good.data() + entries + 8);
    EXPECT_THAT(parseError({}), HasSubstr("x.fil: the first bytes"));
    EXPECT_THAT(changed(8, 2), HasSubstr("version 2, expected 1"));
    EXPECT_THAT(changed(12, 65), HasSubstr("65 sections"));
    EXPECT_THAT(changed(entries, 99), HasSubstr("of kind 99: not known"));
    EXPECT_THAT(changed(entries, 2), HasSubstr("indices: stands twice"));
    EXPECT_THAT(changed(entries + 4, 2), HasSubstr("meta: flags"));
    EXPECT_THAT(changed(entries + 8, 1), HasSubstr("begins at"));
    EXPECT_THAT(changed(entries + 24, 1), HasSubstr("not compressed"));
    EXPECT_THAT(changed(meta - 1, 1), HasSubstr("not zero"));
    EXPECT_THAT(changed(meta, 99), HasSubstr("section meta: byte 0: the encoding is 99"));
    EXPECT_THAT(changed(meta + 1, 3), HasSubstr("byte 1: the format is 3"));
    EXPECT_THAT(changed(meta + 2, 13), HasSubstr("level 13"));
    EXPECT_THAT(changed(meta + 3, 1), HasSubstr("reserved"));
    EXPECT_THAT(changed(meta + 4, 5), HasSubstr("triangle 5 has map 5 of 5"));
    EXPECT_THAT(changed(meta + 7, 0xFF), HasSubstr("number of maps"));
    EXPECT_THAT(changed(meta + 35, 0xFF), HasSubstr("ends inside the asset's name"));
}

TEST(Fil, KindsForOthersArePassedOver) {
    const Bytes good = written(SampleFil().contents, false);
    Bytes bytes = good;
    const size_t pairs = filHeaderBytes + 4 * filEntryBytes;
    bytes[pairs + 3] = 0x80;
    resealFil(bytes);
    const auto file = FilFile::parse(bytes, "x.fil");
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_TRUE(file->pairs().empty());
}

TEST(Fil, CompressedSectionsStayWithinTheLimit) {
    FilReadOptions options;
    options.maxBytes = 999;
    const Bytes bytes = written(SampleFil().contents, true);
    EXPECT_THAT(parseError(bytes, options), HasSubstr("more than the"));
}

TEST(Fil, BlocksAreInStepWithTheMaps) {
    SampleFil sample(0, false);
    const Bytes most(64);
    const Bytes more(65);
    sample.contents.set.descriptors = most;
    for (const bool zstd : {false, true}) EXPECT_EQ(parseError(written(sample.contents, zstd)), "");
    sample.contents.set.descriptors = more;
    for (const bool zstd : {false, true})
        EXPECT_THAT(parseError(written(sample.contents, zstd)),
                    HasSubstr("descriptors: 65 bytes, expected at most 64"));
    sample.contents.set.descriptors = {};
    const Bytes payload((1 << 20) + 1);
    sample.contents.set.payload = payload;
    for (const bool zstd : {false, true})
        EXPECT_THAT(parseError(written(sample.contents, zstd)), HasSubstr("payload: 1048577 bytes"));
}

TEST(Fil, PrimitivesRiseAndHaveGroups) {
    SampleFil sample;
    sample.contents.meta.primitives[2].mesh = 0;
    sample.contents.meta.primitives[2].primitive = 1;
    EXPECT_THAT(parseError(written(sample.contents, false)), HasSubstr("expected rising numbers"));
    sample.contents.meta.primitives[2] = {1, 0, 11, 2};
    EXPECT_THAT(parseError(written(sample.contents, false)), HasSubstr("group 2 of 2"));
}

TEST(Zstd, AFrameThatLiesIsAnError) {
    Bytes plain(200'000);
    for (size_t k = 0; k < plain.size(); ++k) plain[k] = static_cast<uint8_t>(k / 999);
    Bytes frame = zstdCompress(plain);
    const auto same = zstdDecompress(frame, plain.size());
    ASSERT_TRUE(same.ok()) << same.error().message;
    EXPECT_EQ(*same, plain);
    for (const uint64_t size : {uint64_t{0}, uint64_t{1}, plain.size() - uint64_t{1},
                                plain.size() + uint64_t{1}, uint64_t{1} << 62})
        EXPECT_FALSE(zstdDecompress(frame, size).ok()) << size;
    for (size_t size = 0; size < frame.size(); ++size)
        EXPECT_FALSE(zstdDecompress(std::span(frame).first(size), plain.size()).ok()) << size;
    frame.push_back(0);
    EXPECT_FALSE(zstdDecompress(frame, plain.size()).ok());
    EXPECT_TRUE(zstdDecompress(zstdCompress({}), 0).ok());
}

TEST(Fil, AssetsAreKnownByContent) {
    const tests::TempFolder folder;
    ASSERT_TRUE(writeFile(folder / "a.glb", std::string_view("leaves")).ok());
    ASSERT_TRUE(writeFile(folder / "b.glb", std::string_view("leaver")).ok());
    const auto a = identifyAsset(folder / "a.glb");
    const auto b = identifyAsset(folder / "b.glb");
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_EQ(a->name, "a.glb");
    EXPECT_EQ(a->bytes, 6u);
    EXPECT_NE(a->hash, b->hash);
    EXPECT_THAT(contentOf(*a), HasSubstr("6 bytes, hash "));
    EXPECT_FALSE(identifyAsset(folder / "none.glb").ok());
}

}  // namespace
}  // namespace filigree::io
