// Pictures by a Vulkan device of what the room `trace` renders on the CPU.
#pragma once

#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/scene/scene.h"
#include "filigree/trace/render.h"
#include "filigree/vulkan/picture.h"

#include "jobs/opacity_input.h"

#include <memory>
#include <optional>
#include <string_view>

namespace filigree::jobs {

// How a device runs a method.
struct DeviceChoice {
    std::optional<vulkan::RayPath> path;  // none: the scene's
    std::optional<vulkan::StructureBuild>
        hardware;  // of its own micromaps, made of flat maps; none: of shaders
};

// A scene on a device.
class DeviceScene {
  public:
    // `world` of `scene` and the same parts of it; both must outlive the result. `path` as chooseRayPath
    // takes it.
    static Result<DeviceScene> open(const vulkan::DeviceOptions& options, std::string_view path,
                                    const scene::Scene& scene, const trace::World& world,
                                    const vulkan::RaySceneOptions& parts = {},
                                    const Executor& executor = serialExecutor());

    // Makes a method ready. `input` and `maps` as makeOpacity or makeSquareOpacity made and took them.
    // ErrorKind::unsupported for what a device cannot do: squares with two states, hardware micromaps.
    [[nodiscard]] Result<vulkan::Painter> prepare(const OpacityInput& input, const SceneMaps& maps,
                                                  const DeviceChoice& choice = {}) const;

    // `samples` samples of every pixel; `deviceSeconds`, where given, is how long the shaders took.
    // ErrorKind::unsupported for deferred tests.
    [[nodiscard]] Result<trace::Film> render(vulkan::Painter& painter, const trace::RenderSettings& settings,
                                             unsigned samples, ProgressSink& progress,
                                             double* deviceSeconds = nullptr) const;

    // How long the shaders take for such a picture, counting nothing.
    [[nodiscard]] Result<double> frameSeconds(vulkan::Painter& painter, const trace::RenderSettings& settings,
                                              unsigned samples) const;

    [[nodiscard]] const vulkan::Device& device() const { return *device_; }
    [[nodiscard]] const vulkan::RayScene& scene() const { return scene_; }
    [[nodiscard]] vulkan::RayPath path() const { return path_; }

  private:
    DeviceScene(std::unique_ptr<vulkan::Device> device, vulkan::RayPath path, vulkan::RayScene scene,
                const trace::World& world)
        : device_(std::move(device)), path_(path), scene_(std::move(scene)), world_(world) {}

    std::unique_ptr<vulkan::Device> device_;  // goes last
    vulkan::RayPath path_;
    vulkan::RayScene scene_;
    const trace::World& world_;
};

}  // namespace filigree::jobs
