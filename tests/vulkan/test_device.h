// A device under the eyes of the validation layer.
#pragma once

#include "filigree/vulkan/device.h"

#include <cstdlib>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace filigree::tests {

// What the validation layer said.
class Messages {
  public:
    void add(std::string_view message) {
        const std::lock_guard lock(mutex_);
        all_.emplace_back(message);
    }
    [[nodiscard]] const std::vector<std::string>& all() const { return all_; }

  private:
    std::mutex mutex_;
    std::vector<std::string> all_;
};

// The device of the environment variable FILIGREE_VULKAN_DEVICE, or the usual one. Tests fail where the layer
// says anything, and skip where there is no device.
class VulkanTest : public testing::Test {
  protected:
    void SetUp() override {
        const auto found = vulkan::devices();
        if (!found) GTEST_SKIP() << found.error().message;
        if (found->empty())
            GTEST_SKIP() << "no Vulkan device was found (tools/setup --vulkan adds one on the CPU)";
        auto device = vulkan::Device::open(options());
        ASSERT_TRUE(device.ok()) << device.error().message;
        device_.emplace(std::move(*device));
    }
    void TearDown() override {
        device_.reset();
        for (const std::string& message : messages_.all()) ADD_FAILURE() << message;
    }
    vulkan::DeviceOptions options() {
        const char* wanted = std::getenv("FILIGREE_VULKAN_DEVICE");
        return {wanted != nullptr ? wanted : "",
                [this](std::string_view message) { messages_.add(message); }};
    }

    Messages messages_;
    std::optional<vulkan::Device> device_;
};

}  // namespace filigree::tests
