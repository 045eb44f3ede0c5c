#include "filigree/vulkan/picture.h"

#include "filigree/scene/camera_rays.h"

#include "vulkan/commands.h"
#include "vulkan/decoders.h"
#include "vulkan/hardware_maps.h"
#include "vulkan/opacity_maps.h"
#include "vulkan/picture_shaders.h"
#include "vulkan/ray_scene_data.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

namespace filigree::vulkan {
namespace {

// The push constants of picture.comp.
struct PicturePush {
    VkDeviceAddress scene = 0;
    Vec3 origin{};
    Vec3 corner{};
    Vec3 right{};
    Vec3 down{};
    uint32_t width = 0;
    uint32_t firstRow = 0;
    uint32_t rows = 0;
    uint32_t sample = 0;
    uint32_t seed = 0;
    uint32_t integrator = 0;
    uint32_t bounces = 0;
    uint32_t flags = 0;
    float epsilon = 0;
    float aoDistance = 0;
    uint32_t grids = 0;
};
static_assert(sizeof(PicturePush) == 104);

constexpr uint32_t allOpaque = 1;
constexpr uint32_t twoStates = 2;
constexpr uint32_t twoStateShadows = 4;
constexpr uint32_t countRays = 8;

struct PixelWords {
    Vec3 light{};
    uint32_t hits = 0;
};
constexpr size_t kinds = 4;
constexpr size_t countsOfKind = 4;
using PixelCounts = std::array<uint32_t, kinds * countsOfKind>;

uint32_t flagsOf(uint32_t methodFlags, const PictureSettings& settings) {
    uint32_t flags = methodFlags;
    if (settings.twoStateShadows) flags |= twoStateShadows;
    if (settings.count) flags |= countRays;
    return flags;
}

PicturePush pushOf(const RayScene::Data& scene, uint32_t methodFlags, const PictureSettings& settings) {
    const scene::CameraRays rays(settings.camera, settings.width, settings.height);
    PicturePush push;
    push.scene = scene.words.address();
    push.origin = rays.origin();
    push.corner = rays.corner();
    push.right = rays.right();
    push.down = rays.down();
    push.width = settings.width;
    push.seed = settings.seed;
    push.integrator = static_cast<uint32_t>(settings.integrator);
    push.bounces = settings.bounces;
    push.flags = flagsOf(methodFlags, settings);
    push.epsilon = settings.epsilon;
    push.aoDistance = settings.aoDistance;
    push.grids = scene.gridsAt;
    return push;
}

// A picture in the making: bands of rows one after the other, as many as fit the device's buffers.
class PictureRun {
  public:
    PictureRun(Device::Data& device, PictureShaders& shaders, const PicturePush& push,
               const PictureSettings& settings, ProgressSink& progress)
        : device_(device), shaders_(shaders), settings_(settings), progress_(progress), push_(push) {}

    Result<Picture> run() {
        const uint64_t rowBytes = uint64_t{settings_.width} * sizeof(PixelCounts);
        const auto rows = static_cast<uint32_t>(
            std::clamp<uint64_t>(device_.limits.maxStorageBufferRange / rowBytes, 1, settings_.height));
        for (uint32_t first = 0; first < settings_.height; first += rows) {
            push_.firstRow = first;
            push_.rows = std::min(rows, settings_.height - first);
            if (auto done = band(); !done) return done.error();
        }
        return std::move(picture_);
    }

  private:
    [[nodiscard]] size_t pixels() const { return size_t{push_.rows} * settings_.width; }

    Status band() {
        auto film =
            Buffer::make(device_, pixels() * sizeof(PixelWords), BufferPlace::onDevice, "the picture");
        if (!film) return film.error();
        const size_t counted = settings_.count ? pixels() : 1;
        auto counts =
            Buffer::make(device_, counted * sizeof(PixelCounts), BufferPlace::onDevice, "counts of rays");
        if (!counts) return counts.error();
        shaders_.bindings().bind(2, *film);
        shaders_.bindings().bind(3, *counts);
        auto cleared = submit(device_, "clear the picture", [&](VkCommandBuffer commands) {
            vkCmdFillBuffer(commands, film->get(), 0, VK_WHOLE_SIZE, 0);
            vkCmdFillBuffer(commands, counts->get(), 0, VK_WHOLE_SIZE, 0);
        });
        if (!cleared) return cleared;
        for (push_.sample = 0; push_.sample < settings_.samples; ++push_.sample) {
            if (progress_.cancelled()) return Error{ErrorKind::cancelled, "stopped while rendering"};
            auto ran = submitTimed(device_, "render", [&](VkCommandBuffer commands) {
                shaders_.record(commands, &push_, settings_.width, push_.rows);
            });
            if (!ran) return ran.error();
            picture_.seconds += *ran;
            progress_.advance(pixels());
        }
        return collect(*film, *counts);
    }

    Status collect(const Buffer& film, const Buffer& counts) {
        std::vector<PixelWords> band(pixels());
        auto read = download(device_, film,
                             {reinterpret_cast<uint8_t*>(band.data()), band.size() * sizeof(PixelWords)});
        if (!read) return read;
        for (const PixelWords& pixel : band) {
            picture_.sums.push_back(pixel.light);
            picture_.pixelsHit += pixel.hits;
        }
        picture_.fetches.resize(picture_.sums.size());
        return settings_.count ? collectCounts(counts) : Status();
    }

    Status collectCounts(const Buffer& counts) {
        std::vector<PixelCounts> band(pixels());
        auto read = download(device_, counts,
                             {reinterpret_cast<uint8_t*>(band.data()), band.size() * sizeof(PixelCounts)});
        if (!read) return read;
        const size_t first = picture_.sums.size() - band.size();
        for (size_t k = 0; k < band.size(); ++k) {
            for (size_t kind = 0; kind < kinds; ++kind) {
                const uint32_t* of = band[k].data() + countsOfKind * kind;
                picture_.counts[kind].rays += of[0];
                picture_.counts[kind].candidates += of[1];
                picture_.counts[kind].lookups += of[2];
                picture_.counts[kind].fetches += of[3];
                picture_.fetches[first + k] += of[3];
            }
        }
        return {};
    }

    Device::Data& device_;
    PictureShaders& shaders_;
    const PictureSettings& settings_;
    ProgressSink& progress_;
    PicturePush push_;
    Picture picture_;
};

}  // namespace

namespace {

// That the device has micromaps, and that the method's fit it.
Status checkHardware(const Device& device, const RayScene& scene, const Method& method) {
    if (!device.facts().micromaps)
        return Error{ErrorKind::unsupported, fmt::format("{} ({}): this device has no opacity micromaps",
                                                         device.facts().name, device.facts().driver)};
    if (!method.set || method.set->encoding != encoding::Encoding::flat)
        return Error{ErrorKind::usage, "the device's micromaps are made of a flat set"};
    if (auto good = checkSet(*method.set); !good) return good;
    return checkSurfaces(scene, method, method.set->mapCount);
}

}  // namespace

struct Painter::Data {
    Device::Data& device;
    const RayScene::Data& scene;
    uint32_t flags;
    OpacityMaps maps;
    std::optional<HardwareMaps> hardware;
    std::optional<RayStructures> structures;  // with `hardware`; none: the scene's own
    PictureShaders shaders;

    Status buildHardware(const Method& method) {
        auto made = HardwareMaps::make(device, method);
        if (!made) return made.error();
        hardware.emplace(std::move(*made));
        StructureOptions options;
        options.flags = structureFlagsOf(method.build);
        if (method.states == 2)
            options.instanceFlags = VK_GEOMETRY_INSTANCE_FORCE_OPACITY_MICROMAP_2_STATE_EXT;
        options.maps = &*hardware;
        auto built = RayStructures::build(device, scene.source(), options);
        if (!built) return built.error();
        structures.emplace(std::move(*built));
        return {};
    }

    void bind() {
        Bindings& bindings = shaders.bindings();
        bindings.bind(0, maps.descriptors);
        bindings.bind(1, maps.payload);
        bindings.bind(4, maps.surfaces);
        bindings.bind(5, top());
    }

    [[nodiscard]] VkAccelerationStructureKHR top() const {
        return (structures ? *structures : scene.structures).top->get();
    }
};

Result<Painter> Painter::make(const Device& device, const RayScene& scene, const Method& method,
                              RayPath path) {
    if (method.hardware) {
        if (auto good = checkHardware(device, scene, method); !good) return good.error();
    }
    // The device itself looks into its micromaps; shaders see none.
    auto maps = OpacityMaps::make(device.data(), scene, method.hardware ? Method{} : method);
    if (!maps) return maps.error();
    const bool hasGrids = scene.data().grids.has_value();
    const std::array<uint32_t, 2> constants{maps->widthShift, hasGrids ? VK_TRUE : VK_FALSE};
    auto shaders = PictureShaders::make(device.data(), path, {maps->decoder, hasGrids, method.hardware},
                                        {5, sizeof(PicturePush), true}, constants);
    if (!shaders) return shaders.error();
    const uint32_t flags = (method.takesAll ? allOpaque : 0) | (method.states == 2 ? twoStates : 0);
    std::unique_ptr<Data> data(
        new Data{device.data(), scene.data(), flags, std::move(*maps), {}, {}, std::move(*shaders)});
    if (method.hardware) {
        if (auto built = data->buildHardware(method); !built) return built.error();
    }
    data->bind();
    return Painter(std::move(data));
}

Painter::Painter(std::unique_ptr<Data> data) : data_(std::move(data)) {}
Painter::Painter(Painter&&) noexcept = default;
Painter& Painter::operator=(Painter&&) noexcept = default;
Painter::~Painter() = default;

uint64_t Painter::opacityBytes() const {
    return data_->hardware ? data_->hardware->bytes() : data_->maps.bytes;
}

Result<Picture> Painter::render(const PictureSettings& settings, ProgressSink& progress) {
    const PicturePush push = pushOf(data_->scene, data_->flags, settings);
    return PictureRun(data_->device, data_->shaders, push, settings, progress).run();
}

}  // namespace filigree::vulkan
