#include "filigree/jobs/bench_vulkan.h"

#include "filigree/io/gltf.h"

#include "jobs/busy_view.h"
#include "jobs/camera_choice.h"
#include "jobs/device_picture.h"
#include "jobs/json_text.h"
#include "jobs/level_sweep.h"
#include "jobs/median.h"
#include "jobs/opacity_input.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

using trace::Method;
using vulkan::RayPath;
using vulkan::StructureBuild;

constexpr std::string_view hardwareName = "hardware";

// What the options say, checked.
struct DevicePlan {
    std::vector<Method> methods;  // of shaders; the texture is the first
    std::vector<Method> shown;
    bool hardware = false;       // if the device can
    bool needsHardware = false;  // it was asked for
    std::vector<StructureBuild> builds;
    trace::Integrator integrator = trace::Integrator::ao;
};

Status addMethods(const BenchVulkanOptions& options, DevicePlan& plan) {
    plan.hardware = options.methods.empty();
    for (const std::string& name : options.methods) {
        if (name == hardwareName) {
            plan.hardware = plan.needsHardware = true;
            continue;
        }
        const auto method = findMethod(name, "--methods");
        if (!method) return method.error();
        plan.shown.push_back(*method);
    }
    for (size_t k = 0; options.methods.empty() && k < trace::methodCount; ++k)
        plan.shown.push_back(static_cast<Method>(k));
    plan.methods = {Method::texture};
    for (const Method method : plan.shown) {
        if (method != Method::texture) plan.methods.push_back(method);
    }
    return {};
}

Result<DevicePlan> devicePlanOf(const BenchVulkanOptions& options) {
    if (const Status levels = checkLevels(options.levels); !levels) return levels.error();
    if (options.rounds == 0) return Error{ErrorKind::usage, "--rounds 0: give one or more"};
    if (options.samples == 0) return Error{ErrorKind::usage, "--spp 0: give one or more"};
    if (const Status checked = check(options.parameters); !checked) return checked.error();
    if (const Status size = trace::checkSize(options.width, options.height); !size) return size.error();
    DevicePlan plan;
    if (const Status added = addMethods(options, plan); !added) return added.error();
    const auto integrator = trace::integratorNamed(options.integrator);
    if (!integrator)
        return Error{ErrorKind::usage, fmt::format("--integrator {}: choose one of primary, shadow, ao, path",
                                                   options.integrator)};
    plan.integrator = *integrator;
    for (const std::string& name : options.builds) {
        const auto build = vulkan::structureBuildNamed(name);
        if (!build)
            return Error{ErrorKind::usage,
                         fmt::format("--build {}: choose among fast-trace and fast-build", name)};
        plan.builds.push_back(*build);
    }
    return plan;
}

// A row in the making: a method that is ready on the device.
struct Runner {
    BenchVulkanRow row;
    vulkan::Painter painter;
    std::vector<double> seconds;  // [round]
    bool shown = true;
    bool mustAgree = false;  // with the texture, to the bit
};

// One scene on the device.
class DeviceBench {
  public:
    DeviceBench(const BenchVulkanOptions& options, const DevicePlan& plan, const std::filesystem::path& input,
                const Executor& executor, ProgressSink& progress, BenchVulkanSummary& summary)
        : options_(options),
          plan_(plan),
          input_(input),
          executor_(executor),
          progress_(progress),
          summary_(summary) {}

    Status run() {
        if (const Status opened = openScene(); !opened) return opened;
        for (const Method method : plan_.methods) {
            if (hasLevels(method)) continue;
            if (const Status added = addWithoutLevel(method); !added) return added;
        }
        for (const unsigned level : options_.levels) {
            for (const unsigned states : options_.states) {
                if (const Status added = addAt(level, states); !added) return added;
            }
        }
        if (const Status agree = compare(); !agree) return agree;
        if (const Status raced = race(); !raced) return raced;
        addRows();
        return {};
    }

  private:
    Status openScene() {
        auto scene = readUnbakedColour();
        if (!scene) return scene.error();
        scene_ = std::move(*scene);
        trace::WorldOptions building;
        building.blend = options_.parameters.includeBlend;
        auto world = trace::World::build(scene_, building);
        if (!world) return world.error().within(input_.string());
        world_.emplace(std::move(*world));
        if (const Status chosen = chooseView(); !chosen) return chosen;
        return openDevice();
    }

    Result<scene::Scene> readUnbakedColour() const {
        const auto document = io::GltfDocument::load(input_);
        if (!document) return document.error();
        io::ReadOptions reading;
        reading.blendAlpha = options_.parameters.includeBlend;
        reading.colour = true;
        reading.micromaps = false;
        return io::readScene(*document, reading);
    }

    Status chooseView() {
        settings_.width = options_.width;
        settings_.height = options_.height;
        settings_.integrator = plan_.integrator;
        const bool anyPlace =
            std::holds_alternative<std::monostate>(options_.camera) && scene_.cameras.empty();
        const float aspect = static_cast<float>(options_.width) / static_cast<float>(options_.height);
        auto camera =
            anyPlace ? busyView(scene_, *world_) : cameraFor(options_.camera, scene_, *world_, aspect);
        if (!camera) return camera.error();
        settings_.camera = std::move(*camera);
        return {};
    }

    Status openDevice() {
        auto opened = DeviceScene::open({options_.device, {}}, options_.path, scene_, *world_);
        if (!opened) return opened.error();
        device_.emplace(std::move(*opened));
        const vulkan::DeviceFacts& facts = device_->device().facts();
        summary_.device = facts.name;
        summary_.driver = facts.driver;
        if (plan_.needsHardware && !facts.micromaps)
            return Error{ErrorKind::unsupported, fmt::format("{} ({}): this device has no opacity micromaps",
                                                             facts.name, facts.driver)};
        hardware_ = plan_.hardware && facts.micromaps;
        if (!options_.path.empty()) {
            paths_ = {device_->path()};
        } else {
            if (facts.rayQuery) paths_.push_back(RayPath::query);
            if (facts.rayPipeline) paths_.push_back(RayPath::pipeline);
        }
        return {};
    }

    Status addWithoutLevel(Method method) {
        SceneMaps maps;
        if (readsMaps(method)) {
            auto baked = bakeAt(scene_, input_, options_.parameters, 0, 4, executor_, progress_);
            if (!baked) return baked.error();
            maps = std::move(*baked);
        }
        for (const unsigned states : hasStates(method) ? options_.states : std::vector<unsigned>{4}) {
            if (const Status added = add(method, states, {}, maps); !added) return added;
        }
        return {};
    }

    Status addAt(unsigned level, unsigned states) {
        std::map<unsigned, SceneMaps> baked;  // by states
        const auto wantsLevels = [](Method method) { return hasLevels(method); };
        if (!hardware_ && std::ranges::none_of(plan_.methods, wantsLevels)) return {};
        for (const unsigned of : {states, 4u}) {
            if (baked.contains(of)) continue;
            auto maps = bakeAt(scene_, input_, options_.parameters, level, of, executor_, progress_);
            if (!maps) return maps.error();
            baked.emplace(of, std::move(*maps));
        }
        for (const Method method : plan_.methods) {
            if (!hasLevels(method)) continue;
            const SceneMaps& maps = baked.at(method == Method::gruen ? 4 : states);
            if (const Status added = add(method, states, level, maps); !added) return added;
        }
        return hardware_ ? addHardware(level, states, baked.at(states)) : Status();
    }

    Result<OpacityInput> inputFor(Method method, unsigned states, const SceneMaps& maps) {
        if (readsSquares(method))
            return makeSquareOpacity(method, states, scene_, options_.parameters, *world_, executor_,
                                     progress_);
        return makeOpacity(method, states, scene_, maps, *world_, executor_);
    }

    Status add(Method method, unsigned states, std::optional<unsigned> level, const SceneMaps& maps) {
        const auto input = inputFor(method, states, maps);
        if (!input) return input.error();
        BenchVulkanRow row;
        row.method = nameOf(method);
        if (hasStates(method)) row.states = states;
        row.level = level;
        const bool isShown = std::ranges::find(plan_.shown, method) != plan_.shown.end();
        return addRunners(row, *input, maps, {}, isShown, method != Method::none && states == 4);
    }

    Status addHardware(unsigned level, unsigned states, const SceneMaps& maps) {
        const auto input = makeOpacity(Method::micromap, states, scene_, maps, *world_, executor_);
        if (!input) return input.error();
        for (const StructureBuild build : plan_.builds) {
            BenchVulkanRow row;
            row.method = hardwareName;
            row.build = nameOf(build);
            row.states = states;
            row.level = level;
            if (const Status added = addRunners(row, *input, maps, build, true, states == 4); !added)
                return added;
        }
        return {};
    }

    Status addRunners(BenchVulkanRow row, const OpacityInput& input, const SceneMaps& maps,
                      std::optional<StructureBuild> hardware, bool isShown, bool mustAgree) {
        row.scene = input_.filename().string();
        for (const RayPath path : paths_) {
            if (progress_.cancelled()) return Error{ErrorKind::cancelled, "the bench was cancelled"};
            auto painter = device_->prepare(input, maps, {path, hardware});
            if (!painter) return painter.error().within(row.method);
            row.path = nameOf(path);
            row.opacityBytes = painter->opacityBytes();
            runners_.push_back({row, std::move(*painter), {}, isShown, mustAgree});
        }
        return {};
    }

    // Also warms the device up.
    Status compare() {
        progress_.begin("compare", runners_.size() * uint64_t{options_.width} * options_.height, "pixels");
        std::map<std::string, std::vector<Vec3>> expected;  // by path; the texture is the first
        for (Runner& runner : runners_) {
            const auto film = device_->render(runner.painter, settings_, 1, progress_);
            if (!film) return film.error();
            const auto [first, isNew] = expected.emplace(runner.row.path, film->sums);
            if (!runner.mustAgree || film->sums == first->second) continue;
            return Error{ErrorKind::format, fmt::format("{}: {} draws another picture than texture",
                                                        input_.string(), runner.row.method)};
        }
        progress_.end();
        return {};
    }

    Status race() {
        for (unsigned round = 0; round < options_.rounds; ++round) {
            for (size_t k = 0; k < runners_.size(); ++k) {
                // Each round another one begins.
                Runner& runner = runners_[(k + round) % runners_.size()];
                const auto seconds = device_->frameSeconds(runner.painter, settings_, options_.samples);
                if (!seconds) return seconds.error();
                runner.seconds.push_back(*seconds);
                if (progress_.cancelled()) return Error{ErrorKind::cancelled, "the bench was cancelled"};
            }
        }
        return {};
    }

    void addRows() {
        const std::string texture(nameOf(Method::texture));
        for (Runner& runner : runners_) {
            if (!runner.shown) continue;
            const auto reference = std::ranges::find_if(runners_, [&](const Runner& other) {
                return other.row.method == texture && other.row.path == runner.row.path;
            });
            runner.row.frameMs = 1e3 * median(runner.seconds);
            runner.row.ratioToTexture = medianRatio(reference->seconds, runner.seconds);
            summary_.rows.push_back(runner.row);
        }
    }

    void note(std::string_view text) {
        summary_.notes.push_back(fmt::format("{}: {}", input_.filename().string(), text));
    }

    const BenchVulkanOptions& options_;
    const DevicePlan& plan_;
    const std::filesystem::path& input_;
    const Executor& executor_;
    ProgressSink& progress_;
    BenchVulkanSummary& summary_;
    scene::Scene scene_;
    std::optional<trace::World> world_;
    trace::RenderSettings settings_;
    std::optional<DeviceScene> device_;
    std::vector<RayPath> paths_;
    bool hardware_ = false;
    std::vector<Runner> runners_;  // go before the device
};

}  // namespace

Result<BenchVulkanSummary> benchVulkan(const BenchVulkanOptions& options, const Executor& executor,
                                       ProgressSink& progress) {
    const auto plan = devicePlanOf(options);
    if (!plan) return plan.error();
    BenchVulkanSummary summary;
    for (const auto& input : options.inputs) {
        const Status done = DeviceBench(options, *plan, input, executor, progress, summary).run();
        if (!done) return done.error();
    }
    return summary;
}

std::string toJson(const BenchVulkanSummary& summary) {
    const auto orNull = [](const auto& value) { return value ? Json(*value) : Json(); };
    Json rows = Json::array();
    for (const BenchVulkanRow& r : summary.rows) {
        rows.push_back({{"scene", r.scene},
                        {"path", r.path},
                        {"method", r.method},
                        {"build", orNull(r.build)},
                        {"states", orNull(r.states)},
                        {"level", orNull(r.level)},
                        {"frame_ms", r.frameMs},
                        {"ratio_to_texture", r.ratioToTexture},
                        {"opacity_bytes", r.opacityBytes}});
    }
    return dump({{"device", summary.device}, {"driver", summary.driver}, {"rows", rows}});
}

}  // namespace filigree::jobs
