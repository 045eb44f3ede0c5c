// Vulkan devices: which there are, and one of them opened without a screen.
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/result.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filigree::vulkan {

// False where the project was built without Vulkan (CMake's FILIGREE_VULKAN): nothing is found then.
FILIGREE_API bool isBuilt();

// What sort of device it is.
enum class DeviceKind : uint8_t { gpu, integratedGpu, virtualGpu, cpu, other };

// What a device says of itself.
struct DeviceFacts {
    std::string name;
    std::string driver;  // with its version, as the driver says it
    DeviceKind kind = DeviceKind::other;
    bool rayQuery = false;     // acceleration structures, and rays from compute shaders
    bool rayPipeline = false;  // acceleration structures, and pipelines of ray-tracing shaders
    bool micromaps = false;    // VK_EXT_opacity_micromap or VK_KHR_opacity_micromap

    [[nodiscard]] bool tracesRays() const { return rayQuery || rayPipeline; }
};

// How rays are traced; some drivers have only one of them.
enum class RayPath : uint8_t {
    query,    // rays of compute shaders
    pipeline  // ray-tracing shaders, called by the device
};
// For reports.
FILIGREE_API std::string_view nameOf(RayPath path);

// The path of a device, which `wanted` names, "query" or "pipeline"; empty: queries where it has them.
// ErrorKind::usage for other names, ErrorKind::unsupported where the device has no such path.
FILIGREE_API Result<RayPath> chooseRayPath(const DeviceFacts& facts, std::string_view wanted);

// The devices with Vulkan 1.1 or later, in the order of the drivers. ErrorKind::unsupported without a driver,
// and where Vulkan is not built in.
FILIGREE_API Result<std::vector<DeviceFacts>> devices();

// Which device `wanted` names: a number from 0, or a part of a name, upper and lower case alike, that only
// one device has. Empty: the first that traces rays, GPUs before integrated ones before others.
// ErrorKind::unsupported where there is none.
FILIGREE_API Result<size_t> chooseDevice(std::span<const DeviceFacts> devices, std::string_view wanted);

// Which device, and who hears its warnings.
struct DeviceOptions {
    std::string device;  // as chooseDevice takes it
    // Where set, and the validation layer is installed, that layer watches, and each of its warnings and
    // errors comes here, up to the device's end; from any thread.
    std::function<void(std::string_view message)> onMessage;
};

// A device with its queue. All that is made on it must go before it. One thread at a time.
class FILIGREE_API Device {
  public:
    // ErrorKind::unsupported where there is no such device, ErrorKind::limit where it does not open.
    static Result<Device> open(const DeviceOptions& options);

    Device(Device&&) noexcept;
    Device& operator=(Device&&) noexcept;
    ~Device();

    [[nodiscard]] const DeviceFacts& facts() const;
    [[nodiscard]] bool isValidated() const;             // the validation layer watches
    [[nodiscard]] uint64_t allocatedBytes() const;      // memory that is in use on the device
    [[nodiscard]] uint64_t largestBufferBytes() const;  // that a shader can read

    // For this room only.
    struct Data;
    [[nodiscard]] Data& data() const { return *data_; }

  private:
    explicit Device(std::unique_ptr<Data> data);
    std::unique_ptr<Data> data_;
};

}  // namespace filigree::vulkan
