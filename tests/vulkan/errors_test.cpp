// What Vulkan's results say to a user.
#include "vulkan/owned.h"

#include <gtest/gtest.h>

namespace filigree::vulkan {
namespace {

void expectError(VkResult result, ErrorKind kind, std::string_view says) {
    const Status status = checked(result, "build the tree");
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().kind, kind);
    EXPECT_NE(status.error().message.find(says), std::string::npos) << status.error().message;
    EXPECT_NE(status.error().message.find("cannot build the tree"), std::string::npos);
}

TEST(VulkanErrors, SayWhatHappenedAndToWhat) {
    EXPECT_TRUE(checked(VK_SUCCESS, "build the tree").ok());
    expectError(VK_ERROR_OUT_OF_DEVICE_MEMORY, ErrorKind::limit, "the device is out of memory");
    expectError(VK_ERROR_OUT_OF_HOST_MEMORY, ErrorKind::limit, "the device is out of memory");
    expectError(VK_ERROR_DEVICE_LOST, ErrorKind::limit, "the device was lost");
    expectError(VK_ERROR_FEATURE_NOT_PRESENT, ErrorKind::unsupported, "lacks a feature");
    expectError(VK_ERROR_UNKNOWN, ErrorKind::limit, "Vulkan error -13");
}

}  // namespace
}  // namespace filigree::vulkan
