#include "filigree/jobs/bench_grids.h"

#include "filigree/core/box.h"
#include "filigree/core/file.h"
#include "filigree/grid/error.h"
#include "filigree/grid/shapes.h"
#include "filigree/trace/grid_rays.h"
#include "filigree/trace/render.h"

#include "jobs/bench_grids_page.h"
#include "jobs/grid_input.h"
#include "jobs/grid_leaks.h"
#include "jobs/grid_methods.h"
#include "jobs/grid_race.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

constexpr uint32_t leastShapeSize = 65;
constexpr uint32_t mostShapeSize = 8193;
constexpr std::string_view stockMethod = "triangles";
constexpr std::string_view watertightMethod = "lattice";
constexpr std::string_view optionalMethod = "triangles-robust";

using MakeShape = grid::GridMesh (*)(uint32_t n, const Executor& executor);
struct GridShape {
    std::string_view name;
    MakeShape make;
};
constexpr std::array<GridShape, 2> gridShapes{{{"terrain", grid::terrain}, {"torus", grid::torus}}};

const GridShape* gridShapeNamed(std::string_view name) {
    const auto* found = std::ranges::find(gridShapes, name, &GridShape::name);
    return found == gridShapes.end() ? nullptr : found;
}

Status checkBenchGrids(const BenchGridsOptions& options) {
    for (const uint32_t n : options.sizes) {
        if (n < leastShapeSize || n > mostShapeSize)
            return Error{ErrorKind::usage, fmt::format("--sizes {}: give numbers from {} to {}", n,
                                                       leastShapeSize, mostShapeSize)};
    }
    if (options.leakSize < leastShapeSize / 2 || options.leakSize > mostShapeSize)
        return Error{ErrorKind::usage, fmt::format("--leak-size {}: give a number from {} to {}",
                                                   options.leakSize, leastShapeSize / 2, mostShapeSize)};
    for (const std::string& name : options.methods) {
        if (!isGridMethod(name))
            return Error{ErrorKind::usage, fmt::format("--methods {}: choose among {}", name,
                                                       fmt::join(gridMethodNames(), ", "))};
    }
    if (options.rounds == 0) return Error{ErrorKind::usage, "--rounds 0: give one or more"};
    return trace::checkSize(options.width, options.height);
}

bool isWanted(const BenchGridsOptions& options, std::string_view name) {
    if (options.methods.empty()) return name != optionalMethod;
    return std::ranges::find(options.methods, name) != options.methods.end();
}

// All but the stock method, which races whether asked for or not.
std::vector<std::string> methodsToRace(const BenchGridsOptions& options) {
    std::vector<std::string> methods;
    for (const std::string_view name : gridMethodNames()) {
        if (name != stockMethod && isWanted(options, name)) methods.emplace_back(name);
    }
    return methods;
}

BenchGridsSpeed speedOf(const GridSpeed& speed) {
    return {speed.mraysPerSecond, speed.ratio, speed.ratioToBatches, speed.hits, speed.batched};
}

// One scene with all methods.
class GridSceneBench {
  public:
    GridSceneBench(const BenchGridsOptions& options, GridScene& scene, const Executor& executor,
                   ProgressSink& progress, BenchGridsSummary& summary)
        : options_(options), scene_(scene), executor_(executor), progress_(progress), summary_(summary) {}

    Status run() {
        if (const Status made = makeStock(); !made) return made;
        std::vector<std::string> group;
        for (const std::string& name : methodsToRace(options_)) {
            if (!group.empty() && estimate(group) + estimate({name}) > options_.memory) {
                if (const Status raced = race(group); !raced) return raced;
                group.clear();
            }
            group.push_back(name);
        }
        return race(group);
    }

  private:
    // Also gives the rays, from a build that loses none.
    Status makeStock() {
        const Box bounds = grid::boundsOf(scene_.mesh);
        {
            auto reference = trace::EmbreeGrids::build(scene_.mesh, trace::EmbreeLayout::trianglesCompact,
                                                       {.robust = true, .threads = executor_.concurrency()});
            if (!reference) return reference.error();
            trace::GridRayOptions options;
            options.width = options_.width;
            options.height = options_.height;
            const float aspect = static_cast<float>(options.width) / static_cast<float>(options.height);
            rays_ = gridRaySets(*reference, bounds, trace::overviewOf(bounds, aspect), options);
        }
        auto stock = makeGridMethod(stockMethod, scene_, executor_);
        if (!stock) return stock.error();
        stock_ = std::move(*stock);
        return {};
    }

    // Of what methods take while they are built, from what Embree takes for a triangle.
    [[nodiscard]] uint64_t estimate(const std::vector<std::string>& names) const {
        uint64_t bytes = 0;
        for (const std::string& name : names)
            bytes += (name.starts_with(stockMethod) ? 120 : 40) * scene_.mesh.triangleCount();
        return bytes;
    }

    Status race(const std::vector<std::string>& group) {
        std::vector<std::unique_ptr<GridMethod>> made;
        std::vector<GridMethod*> methods{stock_.get()};
        for (const std::string& name : group) {
            auto method = makeGridMethod(name, scene_, executor_);
            if (!method) return method.error().within(scene_.name);
            made.push_back(std::move(*method));
            methods.push_back(made.back().get());
            if (progress_.cancelled()) return Error{ErrorKind::cancelled, "the bench was cancelled"};
        }
        const auto speeds = raceGrids(methods, rays_, options_.rounds, progress_);
        if (!speeds) return speeds.error();
        if (!stockListed_) addRow(stockMethod, *stock_, speeds->front());
        stockListed_ = true;
        for (size_t k = 0; k < group.size(); ++k) addRow(group[k], *made[k], (*speeds)[k + 1]);
        return {};
    }

    void addRow(std::string_view name, const GridMethod& method, const GridSpeeds& speeds) {
        BenchGridsRow row;
        row.scene = scene_.name;
        row.triangles = scene_.mesh.triangleCount();
        row.method = name;
        row.bytesPerTriangle = static_cast<double>(method.bytes()) / static_cast<double>(row.triangles);
        row.buildSeconds = method.buildSeconds();
        row.cacheBytes = method.cacheBytes();
        row.primary = speedOf(speeds[static_cast<size_t>(GridRayKind::primary)]);
        row.bounce = speedOf(speeds[static_cast<size_t>(GridRayKind::bounce)]);
        row.ao = speedOf(speeds[static_cast<size_t>(GridRayKind::ao)]);
        row.shuffled = speedOf(speeds[static_cast<size_t>(GridRayKind::shuffled)]);
        summary_.rows.push_back(std::move(row));
    }

    const BenchGridsOptions& options_;
    GridScene& scene_;
    const Executor& executor_;
    ProgressSink& progress_;
    BenchGridsSummary& summary_;
    trace::GridRaySets rays_;
    std::unique_ptr<GridMethod> stock_;
    bool stockListed_ = false;
};

// As the verb grids converts it, and once more with uniform diagonals where it has others.
Result<GridScene> fileScene(const std::string& name, const BenchGridsOptions& options,
                            const Executor& executor, std::vector<std::string>& notes) {
    const std::filesystem::path path = name;
    grid::ConvertOptions converting;
    converting.attributes = false;
    auto input = readGridInput(path, converting, {}, executor);
    if (!input) return input.error();
    for (const std::string& note : input->notes)
        notes.push_back(fmt::format("{}: {}", path.filename().string(), note));
    GridScene scene{path.filename().string(), std::move(input->mesh), {}, {}};
    scene.precision.lossless = options.lossless && isHeightfield(path);
    if (scene.mesh.diagonals.empty()) return scene;
    converting.uniformDiagonals = true;
    converting.turnQuads = true;
    auto uniform = readGridInput(path, converting, {}, executor);
    if (!uniform) return uniform.error();
    scene.uniformMesh = std::move(uniform->mesh);
    return scene;
}

// A closed shape that rays must not leave.
struct ClosedShape {
    std::string_view name;
    MakeShape make;
    Vec3 (*behind)(const Vec3& target, Random& random);
};
constexpr std::array<ClosedShape, 2> closedShapes{
    {{"torus", grid::torus, behindTorus}, {"box", grid::box, behindBox}}};

Status countAllLeaks(const BenchGridsOptions& options, const Executor& executor, ProgressSink& progress,
                     BenchGridsSummary& summary) {
    for (const ClosedShape& shape : closedShapes) {
        GridScene scene{std::string(shape.name), shape.make(options.leakSize, executor), {}, {}};
        for (const std::string_view name : gridMethodNames()) {
            if (name != optionalMethod && !isWanted(options, name)) continue;
            auto method = makeGridMethod(name, scene, executor);
            if (!method) return method.error().within(scene.name);
            const uint64_t rays = options.leakRays / closedShapes.size();
            const GridLeaks leaks = countLeaks(**method, (*method)->surface(executor), shape.behind,
                                               name == watertightMethod ? rays : rays / 10);
            summary.leaks.push_back({scene.name, std::string(name), leaks.rays, leaks.misses});
            if (progress.cancelled()) return Error{ErrorKind::cancelled, "the bench was cancelled"};
        }
    }
    return {};
}

}  // namespace

Result<BenchGridsSummary> benchGrids(const BenchGridsOptions& options, const Executor& executor,
                                     ProgressSink& progress) {
    if (const Status checked = checkBenchGrids(options); !checked) return checked.error();
    BenchGridsSummary summary;
    const auto bench = [&](GridScene scene) {
        return GridSceneBench(options, scene, executor, progress, summary).run();
    };
    for (const std::string& name : options.scenes) {
        const GridShape* shape = gridShapeNamed(name);
        if (shape == nullptr) {
            auto scene = fileScene(name, options, executor, summary.notes);
            if (!scene) return scene.error();
            if (const Status done = bench(std::move(*scene)); !done) return done.error();
            continue;
        }
        for (const uint32_t n : options.sizes) {
            const Status done = bench({fmt::format("{} {}", name, n), shape->make(n, executor), {}, {}});
            if (!done) return done.error();
        }
    }
    if (options.leakRays > 0) {
        if (const Status counted = countAllLeaks(options, executor, progress, summary); !counted)
            return counted.error();
    }
    if (options.page.empty()) return summary;
    const Status written = writeFile(options.page, report::toHtml(benchGridsPage(options, summary)));
    if (!written) return written.error();
    return summary;
}

}  // namespace filigree::jobs
