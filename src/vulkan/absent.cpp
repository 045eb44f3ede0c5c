// The room where Vulkan is left out: there is no device.
#include "filigree/vulkan/device.h"
#include "filigree/vulkan/grid_lookup.h"
#include "filigree/vulkan/lookup.h"
#include "filigree/vulkan/picture.h"
#include "filigree/vulkan/ray_scene.h"

namespace filigree::vulkan {
namespace {

Error notBuilt() {
    return {
        ErrorKind::unsupported,
        "this build has no Vulkan; install glslang-tools and libvulkan-dev, then configure and build anew"};
}

}  // namespace

struct Device::Data {};
struct RayScene::Data {};
struct Painter::Data {};

bool isBuilt() {
    return false;
}

Result<std::vector<DeviceFacts>> devices() {
    return notBuilt();
}

Result<Device> Device::open(const DeviceOptions&) {
    return notBuilt();
}

Device::Device(std::unique_ptr<Data> data) : data_(std::move(data)) {}
Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;
Device::~Device() = default;

// There is no device to ask.
const DeviceFacts& Device::facts() const {
    static const DeviceFacts none;
    return none;
}
bool Device::isValidated() const {
    return false;
}
uint64_t Device::allocatedBytes() const {
    return 0;
}
uint64_t Device::largestBufferBytes() const {
    return 0;
}

Result<std::vector<micromap::State>> lookup(const Device&, const encoding::EncodedView&,
                                            std::span<const uint32_t>, std::span<const float>,
                                            std::span<const float>) {
    return notBuilt();
}

Result<std::vector<quadmap::Region>> lookup(const Device&, const quadmap::SquareReader&,
                                            std::span<const uint32_t>, std::span<const quadmap::Half>,
                                            std::span<const float>, std::span<const float>) {
    return notBuilt();
}

Result<std::vector<GridVertex>> lookup(const Device&, const grid::EncodedGrids&, std::span<const GridPlace>,
                                       const Executor&) {
    return notBuilt();
}

Result<RayScene> RayScene::build(const Device&, const scene::Scene&, const RaySceneOptions&,
                                 const Executor&) {
    return notBuilt();
}

RayScene::RayScene(std::unique_ptr<Data> data) : data_(std::move(data)) {}
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;
RayScene::~RayScene() = default;

size_t RayScene::surfaceCount() const {
    return 0;
}
const scene::Primitive& RayScene::primitive(size_t) const {
    static const scene::Primitive none;
    return none;
}
RayScene::Bytes RayScene::bytes() const {
    return {};
}

Result<Painter> Painter::make(const Device&, const RayScene&, const Method&, RayPath) {
    return notBuilt();
}
Painter::Painter(std::unique_ptr<Data> data) : data_(std::move(data)) {}
Painter::Painter(Painter&&) noexcept = default;
Painter& Painter::operator=(Painter&&) noexcept = default;
Painter::~Painter() = default;
uint64_t Painter::opacityBytes() const {
    return 0;
}

Result<Picture> Painter::render(const PictureSettings&, ProgressSink&) {
    return notBuilt();
}

}  // namespace filigree::vulkan
