// Micromaps as devices take them, as far as that can be tried without one.
#include "vulkan/micromap_input.h"
#include "vulkan/micromap_shader.h"
#include "vulkan/shaders.h"

#include <array>
#include <cstddef>

#include <gtest/gtest.h>

namespace filigree::vulkan {
namespace {

using micromap::Format;
using micromap::Record;

// The shaders' structures are the registry's: sizes and places that drivers read at.
static_assert(sizeof(VkMicromapTriangleEXT) == micromap::recordBytes);
static_assert(sizeof(MicromapFeaturesKhr) == 24 && sizeof(AddressCommandsFeatures) == 24);
static_assert(offsetof(MicromapPropertiesKhr, maxMicromapTriangles) == 32);
static_assert(sizeof(MicromapPropertiesKhr) == 40);
static_assert(offsetof(GeometryMicromapDataKhr, pUsageCounts) == 24);
static_assert(offsetof(GeometryMicromapDataKhr, data) == 40);
static_assert(sizeof(GeometryMicromapDataKhr) == 64);
static_assert(offsetof(TrianglesMicromapKhr, indexBuffer) == 24);
static_assert(offsetof(TrianglesMicromapKhr, micromap) == 48 && sizeof(TrianglesMicromapKhr) == 56);
static_assert(offsetof(CreateStructure2, address) == 24 && offsetof(CreateStructure2, addressFlags) == 40);
static_assert(offsetof(CreateStructure2, type) == 44 && sizeof(CreateStructure2) == 48);

TEST(MicromapInput, ReadsTheRecordsOfAFlatSet) {
    const std::array<uint8_t, 16> descriptors{0, 0, 0, 0, 2, 0, 2, 0, 4, 1, 0, 0, 12, 0, 2, 0};
    encoding::EncodedView set;
    set.format = Format::fourState;
    set.mapCount = 2;
    set.descriptors = descriptors;
    const auto records = recordsOf(set);
    ASSERT_EQ(records.size(), 2u);
    EXPECT_EQ(records[0].byteOffset, 0u);
    EXPECT_EQ(records[0].level, 2u);
    EXPECT_EQ(records[1].byteOffset, 260u);
    EXPECT_EQ(records[1].level, 12u);
    EXPECT_EQ(records[1].format, Format::fourState);
}

TEST(MicromapInput, SaysWhichLevelsADeviceTakes) {
    const std::vector<Record> records{{0, 5, Format::twoState}, {64, 9, Format::fourState}};
    EXPECT_TRUE(checkLevels(records, {12, 12}).ok());
    EXPECT_TRUE(checkLevels(records, {5, 9}).ok());
    const auto tooHigh = checkLevels(records, {12, 8});
    ASSERT_FALSE(tooHigh.ok());
    EXPECT_EQ(tooHigh.error().kind, ErrorKind::unsupported);
    EXPECT_NE(tooHigh.error().message.find("level 9"), std::string::npos);
    EXPECT_NE(tooHigh.error().message.find("up to 8 with 4 states"), std::string::npos);
    EXPECT_FALSE(checkLevels(records, {4, 12}).ok());
}

TEST(MicromapInput, CountsUsagesAsTheApiHasThem) {
    const std::vector<Record> records{
        {0, 5, Format::twoState}, {64, 3, Format::fourState}, {80, 3, Format::fourState}};
    const auto all = usagesOf(micromap::usageCounts(records));
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0].count, 2u);
    EXPECT_EQ(all[0].subdivisionLevel, 3u);
    EXPECT_EQ(all[0].format, 2u);
    EXPECT_EQ(all[1].count, 1u);
    EXPECT_EQ(all[1].subdivisionLevel, 5u);
    EXPECT_EQ(all[1].format, 1u);
    // How often triangles use them; special ones and repetitions.
    const std::array<int32_t, 6> indices{1, 1, -2, 0, 1, -4};
    const auto used = usagesOf(micromap::usageByTriangles(indices, records));
    ASSERT_EQ(used.size(), 2u);
    EXPECT_EQ(used[0].count, 3u);
    EXPECT_EQ(used[1].count, 1u);
}

std::vector<SurfaceMaps> surfacesOf(std::span<const int32_t> first, std::span<const int32_t> last) {
    return {{first, {}, {}}, {{}, {}, {}}, {last, {}, {}}};
}

TEST(MicromapInput, NumbersMapsIn16BitsWhereTheySuffice) {
    const std::array<int32_t, 3> first{0, 0xfffb, -1};
    const std::array<int32_t, 2> last{-4, 258};
    const MicromapIndices small = micromapIndices(surfacesOf(first, last), 0xfffc, 4);
    EXPECT_EQ(small.type, VK_INDEX_TYPE_UINT16);
    EXPECT_EQ(small.stride, 2u);
    EXPECT_EQ(small.firstBytes, (std::vector<uint64_t>{0, 6, 6}));
    EXPECT_EQ(small.bytes, (std::vector<uint8_t>{0, 0, 0xfb, 0xff, 0xff, 0xff, 0xfc, 0xff, 2, 1}));
    const MicromapIndices large = micromapIndices(surfacesOf(first, last), 0xfffd, 4);
    EXPECT_EQ(large.type, VK_INDEX_TYPE_UINT32);
    EXPECT_EQ(large.firstBytes, (std::vector<uint64_t>{0, 12, 12}));
    EXPECT_EQ(large.bytes.size(), 20u);
    EXPECT_EQ(large.bytes[11], 0xff);
}

TEST(MicromapInput, TakesTheSideOfUnknownTrianglesWithTwoStates) {
    const std::array<int32_t, 4> indices{-1, -2, -3, -4};
    EXPECT_EQ(micromapIndices(surfacesOf(indices, {}), 1, 2).bytes,
              (std::vector<uint8_t>{0xff, 0xff, 0xfe, 0xff, 0xff, 0xff, 0xfe, 0xff}));
    EXPECT_EQ(micromapIndices(surfacesOf(indices, {}), 1, 4).bytes,
              (std::vector<uint8_t>{0xff, 0xff, 0xfe, 0xff, 0xfd, 0xff, 0xfc, 0xff}));
}

// Words of the instructions with an opcode, in the order of a module.
std::vector<std::vector<uint32_t>> instructions(std::span<const uint32_t> code, uint32_t wanted) {
    std::vector<std::vector<uint32_t>> found;
    for (size_t at = 5; at < code.size(); at += code[at] >> 16) {
        if (code[at] >> 16 == 0) break;
        if ((code[at] & 0xffff) == wanted)
            found.emplace_back(code.begin() + static_cast<std::ptrdiff_t>(at),
                               code.begin() + static_cast<std::ptrdiff_t>(at + (code[at] >> 16)));
    }
    return found;
}

constexpr uint32_t opExtension = 10;
constexpr uint32_t opCapability = 17;
constexpr uint32_t opTypeBool = 20;
constexpr uint32_t opConstantTrue = 41;
constexpr uint32_t opExecutionModeId = 331;

TEST(MicromapShader, DeclaresTheCapabilityOfTheTwoStateFlag) {
    const auto code = codeOf({ShaderKind::rayGeneration, Decoder::none, true});
    const auto made = withMicromaps(code, {true, false});
    EXPECT_EQ(instructions(made, opCapability).size(), instructions(code, opCapability).size() + 1);
    EXPECT_EQ(instructions(made, opCapability).front().at(1), 5381u);
    const auto extension = instructions(made, opExtension).back();
    const std::string_view name(reinterpret_cast<const char*>(&extension[1]));
    EXPECT_EQ(name, "SPV_EXT_opacity_micromap");
    EXPECT_TRUE(instructions(made, opExecutionModeId).empty());
    EXPECT_EQ(made[3], code[3]);  // no new names
}

TEST(MicromapShader, DeclaresTheModeOfRayQueries) {
    const auto code = codeOf({ShaderKind::picture, Decoder::none, true});
    const auto made = withMicromaps(code, {true, true});
    const auto modes = instructions(made, opExecutionModeId);
    ASSERT_EQ(modes.size(), 1u);
    EXPECT_EQ(modes[0][2], 6031u);
    const auto truths = instructions(made, opConstantTrue);
    ASSERT_FALSE(truths.empty());
    EXPECT_EQ(truths.back()[1], instructions(made, opTypeBool).front().at(1));
    EXPECT_EQ(modes[0][3], truths.back()[2]);
    EXPECT_LT(modes[0][3], made[3]);
}

TEST(MicromapShader, LeavesOthersAlone) {
    const auto code = codeOf({ShaderKind::picture, Decoder::none});
    EXPECT_EQ(withMicromaps(code, {}), std::vector<uint32_t>(code.begin(), code.end()));
}

}  // namespace
}  // namespace filigree::vulkan
