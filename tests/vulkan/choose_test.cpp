#include "filigree/vulkan/device.h"

#include <array>

#include <gtest/gtest.h>

namespace filigree::vulkan {
namespace {

const std::array<DeviceFacts, 4> someDevices{{
    {"llvmpipe", "", DeviceKind::cpu, true, true, false},
    {"Old GPU", "", DeviceKind::gpu, false, false, false},
    {"Iris", "", DeviceKind::integratedGpu, true, false, false},
    {"New GPU", "", DeviceKind::gpu, true, true, true},
}};

TEST(ChooseDevice, PrefersRayQueriesThenGpus) {
    EXPECT_EQ(*chooseDevice(someDevices, ""), 3u);
    EXPECT_EQ(*chooseDevice(std::span(someDevices).first(3), ""), 2u);
    EXPECT_EQ(*chooseDevice(std::span(someDevices).first(2), ""), 0u);
}

TEST(ChooseDevice, TakesNumbersAndPartsOfNames) {
    EXPECT_EQ(*chooseDevice(someDevices, "1"), 1u);
    EXPECT_EQ(*chooseDevice(someDevices, "iris"), 2u);
    EXPECT_EQ(*chooseDevice(someDevices, "NEW"), 3u);
}

TEST(ChooseDevice, NamesTheDevicesWhereTheChoiceIsNone) {
    for (const char* wanted : {"4", "radeon", "gpu"}) {
        const auto chosen = chooseDevice(someDevices, wanted);
        ASSERT_FALSE(chosen.ok()) << wanted;
        EXPECT_EQ(chosen.error().kind, ErrorKind::unsupported);
        EXPECT_NE(chosen.error().message.find("0 llvmpipe, 1 Old GPU"), std::string::npos);
    }
    EXPECT_FALSE(chooseDevice({}, "").ok());
}

TEST(ChooseDevice, TakesOnesThatHavePipelinesAlone) {
    const std::array<DeviceFacts, 2> devices{{{"llvmpipe", "", DeviceKind::cpu, true, true, false},
                                              {"Headless", "", DeviceKind::gpu, false, true, false}}};
    EXPECT_EQ(*chooseDevice(devices, ""), 1u);
}

TEST(ChooseRayPath, PrefersQueriesAndTakesWhatThereIs) {
    const DeviceFacts both = someDevices[0];
    const DeviceFacts queries = someDevices[2];
    const DeviceFacts pipelines{"Headless", "", DeviceKind::gpu, false, true, false};
    EXPECT_EQ(*chooseRayPath(both, ""), RayPath::query);
    EXPECT_EQ(*chooseRayPath(both, "pipeline"), RayPath::pipeline);
    EXPECT_EQ(*chooseRayPath(queries, ""), RayPath::query);
    EXPECT_EQ(*chooseRayPath(pipelines, ""), RayPath::pipeline);
    EXPECT_EQ(chooseRayPath(both, "raster").error().kind, ErrorKind::usage);
    EXPECT_EQ(chooseRayPath(queries, "pipeline").error().kind, ErrorKind::unsupported);
    EXPECT_EQ(chooseRayPath(pipelines, "query").error().kind, ErrorKind::unsupported);
    EXPECT_EQ(chooseRayPath(someDevices[1], "").error().kind, ErrorKind::unsupported);
}

}  // namespace
}  // namespace filigree::vulkan
