#include "filigree/jobs/bench_trace.h"

#include "filigree/core/file.h"
#include "filigree/io/gltf.h"
#include "filigree/trace/rays.h"

#include "jobs/atlas.h"
#include "jobs/bench_trace_page.h"
#include "jobs/busy_view.h"
#include "jobs/camera_choice.h"
#include "jobs/level_sweep.h"
#include "jobs/median.h"
#include "jobs/opacity_input.h"
#include "jobs/trace_contestants.h"

#include <algorithm>
#include <ctime>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

using trace::Method;

// What the options say, checked.
struct Plan {
    std::vector<Method> methods;                 // `texture` among them
    std::vector<trace::Integrator> integrators;  // each gives the rays of its name
    std::vector<Method> shown;
};

Result<std::vector<Method>> methodsOf(const BenchTraceOptions& options) {
    std::vector<Method> methods;
    for (const std::string& name : options.methods) {
        const auto method = findMethod(name, "--methods");
        if (!method) return method.error();
        methods.push_back(*method);
    }
    if (options.methods.empty()) {
        for (size_t k = 0; k < trace::methodCount; ++k) methods.push_back(static_cast<Method>(k));
    }
    return methods;
}

Result<Plan> planOf(const BenchTraceOptions& options) {
    if (const Status levels = checkLevels(options.levels); !levels) return levels.error();
    if (options.rounds == 0) return Error{ErrorKind::usage, "--rounds 0: give one or more"};
    if (const Status checked = check(options.parameters); !checked) return checked.error();
    const auto methods = methodsOf(options);
    if (!methods) return methods.error();
    Plan plan;
    plan.shown = *methods;
    plan.methods = *methods;
    plan.methods.push_back(Method::texture);
    std::ranges::sort(plan.methods);
    plan.methods.erase(std::unique(plan.methods.begin(), plan.methods.end()), plan.methods.end());
    for (const std::string& name : options.rays) {
        const auto integrator = trace::integratorNamed(name);
        if (!integrator)
            return Error{ErrorKind::usage,
                         fmt::format("--rays {}: choose among primary, shadow, ao and path", name)};
        plan.integrators.push_back(*integrator);
    }
    return plan;
}

// Of this thread.
double cpuSeconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Rounds of all contestants over the same rays.
struct Race {
    std::vector<std::vector<double>> seconds;  // [contestant][round]
    std::vector<trace::Counters> counters;     // [contestant]
};

// One scene, and all that is asked of it.
class SceneBench {
  public:
    SceneBench(const BenchTraceOptions& options, const Plan& plan, const std::filesystem::path& input,
               const Executor& executor, ProgressSink& progress, BenchTraceSummary& summary)
        : options_(options),
          plan_(plan),
          input_(input),
          executor_(executor),
          progress_(progress),
          summary_(summary) {}

    Status run() {
        if (const Status read = readScene(); !read) return read;
        if (const Status built = buildWorld(); !built) return built;
        if (const Status chosen = chooseView(); !chosen) return chosen;
        if (const Status packed = pack(); !packed) return packed;
        if (const Status made = makeContestants(); !made) return made;
        for (const trace::Integrator integrator : plan_.integrators) {
            if (const Status ran = runRays(integrator); !ran) return ran;
        }
        return {};
    }

  private:
    Status readScene() {
        const auto document = io::GltfDocument::load(input_);
        if (!document) return document.error();
        io::ReadOptions reading;
        reading.blendAlpha = options_.parameters.includeBlend;
        reading.colour = true;
        reading.micromaps = false;
        auto scene = io::readScene(*document, reading);
        if (!scene) return scene.error();
        scene_ = std::move(*scene);
        return {};
    }

    Status pack() {
        if (options_.atlas == 0) return {};
        world_.reset();
        const auto notes = packAtlas(scene_, options_.atlas);
        if (!notes) return notes.error();
        for (const std::string& text : *notes) note(text);
        return buildWorld();
    }

    Status buildWorld() {
        trace::WorldOptions building;
        building.blend = options_.parameters.includeBlend;
        building.alphaAmongColours = options_.atlas > 0;
        auto world = trace::World::build(scene_, building);
        if (!world) return world.error().within(input_.string());
        world_.emplace(std::move(*world));
        return {};
    }

    // Before textures are packed, which moves triangles about: the view is the same then.
    Status chooseView() {
        settings_.width = options_.width;
        settings_.height = options_.height;
        if (const Status sizes = check(settings_); !sizes) return sizes;
        const bool anyPlace = !options_.overview && std::holds_alternative<std::monostate>(options_.camera) &&
                              scene_.cameras.empty();
        const float aspect = static_cast<float>(options_.width) / static_cast<float>(options_.height);
        auto camera =
            anyPlace ? busyView(scene_, *world_) : cameraFor(options_.camera, scene_, *world_, aspect);
        if (!camera) return camera.error();
        settings_.camera = std::move(*camera);
        return {};
    }

    Status makeContestants() {
        auto made =
            jobs::makeContestants(options_, plan_.methods, scene_, *world_, input_, executor_, progress_);
        if (!made) return made.error();
        contestants_ = std::move(*made);
        return {};
    }

    // Rays of the kind that an integrator is named after; of a path all but the first.
    [[nodiscard]] std::vector<trace::Ray> raysFor(trace::Integrator integrator) const {
        trace::RenderSettings settings = settings_;
        settings.integrator = integrator;
        auto rays = raysOf(*world_, *reference().input->opacity, settings);
        if (integrator != trace::Integrator::primary)
            std::erase_if(rays, [](const trace::Ray& ray) { return ray.kind == trace::RayKind::primary; });
        return rays;
    }

    [[nodiscard]] const Contestant& reference() const {
        return *std::ranges::find(contestants_, Method::texture, &Contestant::method);
    }

    Status runRays(trace::Integrator integrator) {
        const auto rays = raysFor(integrator);
        if (rays.empty()) {
            note(fmt::format("no {} rays", nameOf(integrator)));
            return {};
        }
        Race race{std::vector<std::vector<double>>(contestants_.size()),
                  std::vector<trace::Counters>(contestants_.size())};
        if (const Status counted = countAll(rays, race); !counted) return counted;
        for (unsigned round = 0; round < options_.rounds; ++round) {
            for (size_t k = 0; k < contestants_.size(); ++k) {
                // Each round another one begins.
                const size_t turn = (k + round) % contestants_.size();
                trace::Counters counters;
                const double start = cpuSeconds();
                castRays(*world_, *contestants_[turn].input->opacity, rays, false, counters);
                race.seconds[turn].push_back(cpuSeconds() - start);
                if (progress_.cancelled()) return Error{ErrorKind::cancelled, "the bench was cancelled"};
            }
        }
        addRows(integrator, race);
        return {};
    }

    // Counts what rays cost, which warms caches, too, and compares what they hit.
    Status countAll(const std::vector<trace::Ray>& rays, Race& race) {
        trace::Counters ignored;
        const auto right = castRays(*world_, *reference().input->opacity, rays, false, ignored);
        for (size_t k = 0; k < contestants_.size(); ++k) {
            const Contestant& c = contestants_[k];
            const auto found = castRays(*world_, *c.input->opacity, rays, true, race.counters[k]);
            const bool mustAgree = c.method != Method::none && c.states == 4;
            if (mustAgree && (found.hits != right.hits || found.hash != right.hash))
                return Error{ErrorKind::format,
                             fmt::format("{}: {} at level {} finds other hits than texture", input_.string(),
                                         nameOf(c.method), c.level)};
        }
        return {};
    }

    void addRows(trace::Integrator integrator, const Race& race) {
        const auto reference = static_cast<size_t>(&this->reference() - contestants_.data());
        for (size_t k = 0; k < contestants_.size(); ++k) {
            const Contestant& c = contestants_[k];
            if (std::ranges::find(plan_.shown, c.method) == plan_.shown.end()) continue;
            const trace::RayCounts counts = race.counters[k].total();
            const auto rays = static_cast<double>(counts.rays);
            std::vector<double> ratios;
            for (size_t round = 0; round < options_.rounds; ++round)
                ratios.push_back(race.seconds[reference][round] / race.seconds[k][round]);
            BenchTraceRow row;
            row.scene = input_.filename().string();
            row.rays = nameOf(integrator);
            row.method = nameOf(c.method);
            if (hasStates(c.method)) row.states = c.states;
            if (hasLevels(c.method)) row.level = c.level;
            row.mraysPerSecond = rays / median(race.seconds[k]) / 1e6;
            row.ratioToTexture = median(ratios);
            row.leastRatio = std::ranges::min(ratios);
            row.mostRatio = std::ranges::max(ratios);
            row.fetchesPerRay = static_cast<double>(counts.textureFetches) / rays;
            row.testsPerRay = static_cast<double>(counts.candidateHits) / rays;
            if (counts.lookups > 0)
                row.bitsPerLookup =
                    static_cast<double>(counts.bitsRead) / static_cast<double>(counts.lookups);
            row.opacityBytes = c.input->opacity->bytes();
            summary_.rows.push_back(std::move(row));
        }
    }

    void note(std::string_view text) {
        summary_.notes.push_back(fmt::format("{}: {}", input_.filename().string(), text));
    }

    const BenchTraceOptions& options_;
    const Plan& plan_;
    const std::filesystem::path& input_;
    const Executor& executor_;
    ProgressSink& progress_;
    BenchTraceSummary& summary_;
    scene::Scene scene_;
    std::optional<trace::World> world_;
    trace::RenderSettings settings_;
    std::vector<Contestant> contestants_;
};

}  // namespace

Result<BenchTraceSummary> benchTrace(const BenchTraceOptions& options, const Executor& executor,
                                     ProgressSink& progress) {
    const auto plan = planOf(options);
    if (!plan) return plan.error();
    BenchTraceSummary summary;
    for (const auto& input : options.inputs) {
        const Status done = SceneBench(options, *plan, input, executor, progress, summary).run();
        if (!done) return done.error();
    }
    if (options.page.empty()) return summary;
    const Status written = writeFile(options.page, report::toHtml(benchTracePage(options, summary)));
    if (!written) return written.error();
    return summary;
}

}  // namespace filigree::jobs
