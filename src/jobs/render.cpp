#include "filigree/jobs/render.h"

#include "filigree/core/file.h"
#include "filigree/grid/encode_grids.h"
#include "filigree/io/fil_grids.h"
#include "filigree/io/gltf.h"
#include "filigree/io/image_file.h"
#include "filigree/trace/render.h"

#include "jobs/camera_choice.h"
#include "jobs/device_picture.h"
#include "jobs/heat_map.h"
#include "jobs/opacity_input.h"
#include "jobs/peak_memory.h"
#include "jobs/psnr.h"
#include "jobs/render_beside.h"
#include "jobs/render_check.h"
#include "jobs/render_page.h"
#include "jobs/sha256.h"
#include "jobs/stopwatch.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

using trace::Method;

// One run of the verb.
class Rendering {
  public:
    Rendering(const RenderOptions& options, const RenderAsked& asked, const Executor& executor,
              ProgressSink& progress)
        : options_(options), method_(asked.method), executor_(executor), progress_(progress) {
        settings_.width = options.width;
        settings_.height = options.height;
        settings_.integrator = asked.integrator;
        settings_.seed = options.seed;
        settings_.bounces = options.bounces;
        settings_.defer = options.defer;
        settings_.twoStateShadows = options.twoStateShadows;
        settings_.countBitsRead = true;
    }

    Result<RenderSummary> run() {
        if (auto read = readGrids(); !read) return read.error();
        if (auto read = readScene(); !read) return read.error();
        if (auto built = buildWorld(); !built) return built.error();
        auto opacity = prepareOpacity();
        if (!opacity) return opacity.error();
        summary_.firstSampleSeconds = total_.seconds();
        auto film = rendered(*opacity, !options_.output.empty() && options_.previewSeconds > 0);
        if (!film) return film.error();
        films_.push_back(
            {options_.method, std::nullopt, summary_.seconds, opacity->opacity->bytes(), std::move(*film)});
        if (hasStates(method_)) films_.front().states = states_;
        if (auto compared = renderReference(); !compared) return compared.error();
        summarise();
        if (auto written = writePage(); !written) return written.error();
        if (auto written = writePictures(); !written) return written.error();
        summary_.totalSeconds = total_.seconds();
        return std::move(summary_);
    }

  private:
    // The file's maps serve where they are what was asked for.
    [[nodiscard]] bool takesCarriedMaps() const { return hasLevels(method_) && !options_.levelGiven; }

    // The file with triangles for Embree; empty: there are only grids.
    [[nodiscard]] const std::filesystem::path& sceneFile() const {
        return grids_ ? options_.scene : options_.input;
    }

    Status readGrids() {
        if (!io::isFil(options_.input)) {
            if (options_.scene.empty()) return {};
            return Error{ErrorKind::usage, "--scene: goes with the grids of a .fil"};
        }
        auto grids = io::readFilGrids(options_.input, executor_);
        if (!grids) return grids.error();
        grids_ = std::make_unique<io::FilGrids>(std::move(*grids));
        summary_.grids = RenderedGrids{std::string(nameOf(grids_->grids.codec)), grids_->triangleCount(),
                                       grid::bytesOf(grids_->grids).total()};
        return {};
    }

    Status readScene() {
        if (sceneFile().empty()) return {};
        const auto document = io::GltfDocument::load(sceneFile());
        if (!document) return document.error();
        io::ReadOptions reading;
        reading.blendAlpha = true;
        reading.colour = true;
        reading.micromaps = takesCarriedMaps();
        auto scene = io::readScene(*document, reading);
        if (!scene) return scene.error();
        scene_ = std::move(*scene);
        addNotes(scene_.notes);
        return {};
    }

    [[nodiscard]] trace::GridPart gridPart() const {
        trace::GridPart part;
        part.grids = &grids_->grids;
        part.table = grids_->table;
        part.triangles = grids_->triangleCount();
        part.attributes = &grids_->attributes;
        return part;
    }

    Status buildWorld() {
        trace::WorldOptions building;
        if (grids_) {
            building.opaque = false;
            building.grids = gridPart();
        }
        auto world = trace::World::build(scene_, building);
        if (!world) return world.error().within(options_.input.string());
        world_.emplace(std::move(*world));
        addNotes(world_->notes());
        if (world_->triangleCount() == 0) note("the scene has no triangles; the picture shows the sky alone");
        auto camera = cameraFor(options_.camera, scene_, *world_,
                                static_cast<float>(options_.width) / static_cast<float>(options_.height));
        if (!camera) return camera.error();
        settings_.camera = std::move(*camera);
        if (auto good = check(settings_); !good) return good;
        return options_.backend == "vulkan" ? openDevice() : Status();
    }

    Status openDevice() {
        vulkan::RaySceneOptions parts;
        if (grids_) parts = {false, {&grids_->grids, grids_->table, &grids_->attributes}};
        auto opened =
            DeviceScene::open({options_.device, {}}, options_.path, scene_, *world_, parts, executor_);
        if (!opened) return opened.error().within("--backend vulkan");
        device_.emplace(std::move(*opened));
        if (options_.previewSeconds > 0) note("--preview is ignored: the backend vulkan writes none");
        return {};
    }

    Result<OpacityInput> prepareOpacity() {
        noteIgnored();
        states_ = options_.states;
        if (readsSquares(method_))
            return makeSquareOpacity(method_, states_, scene_, parameters(), *world_, executor_, progress_);
        if (readsMaps(method_)) {
            auto maps = mapsOf();
            if (!maps) return maps.error().within(options_.input.string());
            maps_ = std::move(*maps);
        }
        return makeOpacity(method_, states_, scene_, maps_, *world_, executor_);
    }

    // How to make what the method reads.
    [[nodiscard]] BakeParameters parameters() const {
        BakeParameters bake;
        bake.states = options_.states;
        bake.level = method_ == Method::bitmask ? 0 : options_.level;
        if (!options_.levelGiven) bake.maxLevel = 6;  // so that the picture begins soon
        bake.includeBlend = true;
        return bake;
    }

    Result<SceneMaps> mapsOf() {
        if (!scene_.micromaps.empty()) {
            SceneMaps maps = carriedMaps(scene_);
            if (fits(maps)) return maps;
            note("the file's micromaps have 2 states; --states 4 bakes others");
        }
        auto maps = bakeMaps(scene_, parameters(), executor_, progress_);
        if (maps) addNotes(maps->notes);
        return maps;
    }

    // 4-state maps have the sides that 2 states want; the way back there is none.
    bool fits(SceneMaps& maps) {
        const bool twoState = maps.format == micromap::Format::twoState;
        if (twoState && options_.statesGiven && options_.states == 4) return false;
        if (twoState) states_ = 2;
        if (states_ == 2) maps.format = micromap::Format::twoState;
        return true;
    }

    void noteIgnored() {
        if (options_.levelGiven && !hasLevels(method_))
            note(fmt::format("--level is ignored: {} has no levels", nameOf(method_)));
        if (options_.statesGiven && !hasStates(method_))
            note(fmt::format("--states is ignored: {} has no states", nameOf(method_)));
    }

    Result<trace::Film> rendered(const OpacityInput& input, bool previews) {
        if (device_) return renderedByDevice(input);
        const trace::Opacity& opacity = *input.opacity;
        trace::Film film(options_.width, options_.height);
        const Stopwatch watch;
        double next = options_.previewSeconds;
        progress_.begin(nameOf(opacity.method()), uint64_t{options_.spp} * film.sums.size(), "pixels");
        for (unsigned k = 0; k < options_.spp; ++k) {
            if (!addSample(*world_, opacity, settings_, executor_, progress_, film)) break;
            if (!previews || watch.seconds() < next || k + 1 == options_.spp) continue;
            if (auto written = writePng(options_.output, developed(film)); !written) return written.error();
            next = watch.seconds() + options_.previewSeconds;
        }
        progress_.end();
        if (progress_.cancelled()) return Error{ErrorKind::cancelled, "stopped while rendering"};
        if (summary_.seconds == 0) summary_.seconds = watch.seconds();
        return film;
    }

    // None where shaders decide.
    [[nodiscard]] std::optional<vulkan::StructureBuild> buildFor(const OpacityInput& input) const {
        if (options_.method != hardwareMethod || input.opacity->method() != method_) return {};
        return vulkan::structureBuildNamed(options_.build).value_or(vulkan::StructureBuild::fastTrace);
    }

    Result<trace::Film> renderedByDevice(const OpacityInput& input) {
        auto painter = device_->prepare(input, maps_, {{}, buildFor(input)});
        if (!painter) return painter.error().within("--backend vulkan");
        const Stopwatch watch;
        progress_.begin(nameOf(input.opacity->method()),
                        uint64_t{options_.spp} * options_.width * options_.height, "pixels");
        double deviceSeconds = 0;
        auto film = device_->render(*painter, settings_, options_.spp, progress_, &deviceSeconds);
        progress_.end();
        if (summary_.deviceSeconds == 0) summary_.deviceSeconds = deviceSeconds;
        if (buildFor(input)) hardwareBytes_ = painter->opacityBytes();
        if (summary_.seconds == 0) summary_.seconds = watch.seconds();
        if (!film || !hasStates(input.opacity->method())) return film;
        for (trace::RayCounts& counts : film->counters.of) counts.unknown = counts.textureFetches;
        return film;
    }

    static Status writePng(const std::filesystem::path& file, const scene::ColourImage& image) {
        const auto png = io::encodePng(image);
        if (!png) return png.error().within(file.string());
        return writeFile(file, *png);
    }

    static Status writeCanvas(const std::filesystem::path& file, const Canvas& canvas) {
        const auto png = canvas.png();
        if (!png) return png.error().within(file.string());
        return writeFile(file, *png);
    }

    Status writePictures() {
        const trace::Film& film = films_.front().film;
        const scene::ColourImage picture = developed(film);
        summary_.imageSha256 = sha256(picture.rgba);
        if (!options_.triptych.empty()) {
            if (auto written = writeTriptych(film, picture); !written) return written;
        }
        if (!options_.heatmap.empty()) {
            const HeatSource source = heatSource(film);
            if (auto written = writeCanvas(options_.heatmap, heatMap(source)); !written) return written;
        }
        return writePng(options_.output, picture);
    }

    [[nodiscard]] HeatSource heatSource(const trace::Film& film) const {
        const bool bits = options_.heatmapOf == HeatmapOf::bits;
        return {bits ? "bits read a sample" : "alpha tests a sample",
                bits ? std::span(film.bitsRead) : std::span(film.alphaTests), film.width, film.height,
                film.samples};
    }

    // The same picture once more by the texture alone, which the maps must not change.
    Status renderReference() {
        const bool asks = films_.front().film.counters.total().candidateHits > 0;
        const bool onPage = !options_.page.empty() && asks;
        if (!hasStates(method_) || (options_.triptych.empty() && !onPage)) return {};
        const auto texture = makeOpacity(Method::texture, 4, scene_, {}, *world_, executor_);
        if (!texture) return texture.error();
        const Stopwatch watch;
        auto film = rendered(*texture, false);
        if (!film) return film.error();
        films_.push_back({std::string(nameOf(Method::texture)), std::nullopt, watch.seconds(),
                          texture->opacity->bytes(), std::move(*film)});
        return {};
    }

    Status writeTriptych(const trace::Film& film, const scene::ColourImage& picture) {
        const trace::Film& without = films_[1].film;
        const scene::ColourImage expected = developed(without);
        summary_.triptych = TriptychSummary{without.counters.total().textureFetches,
                                            expected.rgba == picture.rgba, psnr(expected, picture)};
        const Canvas canvas =
            triptych(picture, nameOf(method_),
                     {"alpha tests a sample", without.alphaTests, film.width, film.height, film.samples},
                     {"alpha tests a sample", film.alphaTests, film.width, film.height, film.samples});
        return writeCanvas(options_.triptych, canvas);
    }

    Status writePage() {
        if (options_.page.empty()) return {};
        BakeParameters like = parameters();
        like.states = states_;
        BesideRenderer beside(scene_, *world_, settings_, options_.spp, like,
                              hasLevels(method_) ? &maps_ : nullptr, executor_, progress_);
        for (const std::string& name : options_.beside) {
            if (std::ranges::find(films_, name, &MethodFilm::method) != films_.end()) continue;
            auto made = beside.render(*trace::methodNamed(name));
            if (!made) return made.error();
            films_.push_back(std::move(*made));
        }
        const auto page = renderPage(options_, summary_, films_);
        return page ? writeFile(options_.page, report::toHtml(*page)) : page.error();
    }

    void summarise() {
        const MethodFilm& made = films_.front();
        const trace::Film& film = made.film;
        if (film.pixelsHit == 0) note("the camera sees nothing of the scene");
        summary_.method = options_.method;
        summary_.states = made.states;
        summary_.hasLevels = hasLevels(method_);
        summary_.level = maps_.level;
        summary_.integrator = options_.integrator;
        summary_.width = film.width;
        summary_.height = film.height;
        summary_.spp = film.samples;
        summary_.counters = film.counters;
        const trace::World::Bytes bytes = world_->bytes();
        summary_.opacityBytes = made.opacityBytes;
        summary_.textureBytes = bytes.textures;
        summary_.geometryBytes = bytes.geometry;
        summary_.bvhBytes = bytes.bvh;
        summary_.backend = options_.backend;
        if (device_) {
            summary_.bvhBytes = device_->scene().bytes().structures;
            summary_.device = device_->device().facts().name;
            summary_.driver = device_->device().facts().driver;
            summary_.path = nameOf(device_->path());
            if (options_.method == hardwareMethod) {
                summary_.build = options_.build.empty() ? "fast-trace" : options_.build;
                summary_.opacityBytes = hardwareBytes_;
            }
            const vulkan::RayScene::Bytes onDevice = device_->scene().bytes();
            if (summary_.grids) summary_.grids->bytes = onDevice.gridWords + onDevice.gridStructures;
        }
        summary_.peakBytes = peakMemory();
    }

    void note(std::string text) { summary_.notes.push_back(std::move(text)); }
    void addNotes(const std::vector<std::string>& notes) {
        summary_.notes.insert(summary_.notes.end(), notes.begin(), notes.end());
    }

    const RenderOptions& options_;
    const Method method_;
    const Executor& executor_;
    ProgressSink& progress_;
    const Stopwatch total_;
    trace::RenderSettings settings_;
    unsigned states_ = 4;
    std::unique_ptr<io::FilGrids> grids_;  // null: none
    scene::Scene scene_;
    std::optional<trace::World> world_;  // of both
    std::optional<DeviceScene> device_;  // none: the CPU renders
    SceneMaps maps_;
    uint64_t hardwareBytes_ = 0;
    std::vector<MethodFilm> films_;  // the picture; then the texture's, where it is compared; then others
    RenderSummary summary_;
};

}  // namespace

Result<RenderSummary> render(const RenderOptions& options, const Executor& executor, ProgressSink& progress) {
    const auto asked = checked(options);
    if (!asked) return asked.error();
    return Rendering(options, *asked, executor, progress).run();
}

}  // namespace filigree::jobs
