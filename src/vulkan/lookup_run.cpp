#include "vulkan/lookup_run.h"

#include "vulkan/commands.h"

#include <algorithm>

namespace filigree::vulkan {
namespace {

constexpr uint32_t lookupGroupSize = 64;          // local_size_x of the shaders
constexpr uint32_t mostGroupsEverywhere = 65535;  // what each device allows

}  // namespace

Status answerQueries(Device::Data& device, Kernel& kernel, uint32_t binding, size_t total, const char* what,
                     std::span<uint8_t> found) {
    const auto results = Buffer::make(device, found.size(), BufferPlace::onDevice, "answers");
    if (!results) return results.error();
    kernel.bindings().bind(binding, *results);
    const auto end = static_cast<uint32_t>(total);
    const uint32_t step =
        lookupGroupSize * std::min(device.limits.maxComputeWorkGroupCount[0], mostGroupsEverywhere);
    auto ran = submit(device, what, [&](VkCommandBuffer commands) {
        for (uint32_t first = 0; first < end; first += step) {
            const LookupRange range{first, std::min(step, end - first)};
            kernel.record(commands, &range, (range.count + lookupGroupSize - 1) / lookupGroupSize);
        }
    });
    if (!ran) return ran;
    return download(device, *results, found);
}

}  // namespace filigree::vulkan
