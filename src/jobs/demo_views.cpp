#include "jobs/demo_views.h"

#include "filigree/core/file.h"
#include "filigree/io/image_file.h"
#include "filigree/report/number.h"

#include "jobs/command_words.h"
#include "jobs/inspection.h"

#include <utility>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

constexpr const char* triptychFile = "alpha-tests.png";
constexpr const char* renderPageFile = "view.html";

RenderOptions optionsFor(const std::filesystem::path& baked, unsigned camera, unsigned samples,
                         const std::filesystem::path& folder) {
    RenderOptions options;
    options.input = baked;
    options.output = folder / fmt::format("view-{:02}.png", camera + 1);
    options.method = "sdag";
    options.integrator = "shadow";
    options.spp = samples;
    options.camera = camera;
    if (camera > 0) return options;
    options.triptych = folder / triptychFile;
    options.page = folder / renderPageFile;
    options.beside = {"micromap", "bitmask", "vq4+"};
    return options;
}

report::Table testsTable(const RenderSummary& s, const std::string& command) {
    const auto count = [](uint64_t n) { return static_cast<int64_t>(n); };
    const trace::RayCounts rays = s.counters.total();
    report::Table table;
    table.caption = "Alpha tests of the first view";
    table.command = command;
    table.columns = {{"what", "What"}, {"texture", "Texture alone"}, {"maps", "With micromaps (sdag)"}};
    table.rows = {{"Rays", count(rays.rays), count(rays.rays)},
                  {"Hits to decide", count(rays.candidateHits), count(rays.candidateHits)},
                  {"decided by a micromap", int64_t{0}, count(rays.candidateHits - rays.unknown)},
                  {"Alpha tests", count(s.triptych->textureFetches), count(rays.textureFetches)},
                  {"Pictures", "", s.triptych->identical ? "the same to the bit" : "different"}};
    return table;
}

}  // namespace

Result<report::Figure> figureOf(const std::filesystem::path& file, const std::string& alt,
                                const std::string& caption, const std::string& command) {
    auto png = readFile(file);
    if (!png) return png.error();
    const auto size = io::imageSize(*png);
    if (!size) return size.error().within(file.string());
    report::Picture picture{std::move(*png), size->width, size->height, alt, file.filename().string()};
    return report::Figure{std::move(picture), caption, command};
}

Result<DemoViews> drawDemoViews(const std::filesystem::path& baked, size_t cameras, unsigned samples,
                                const std::filesystem::path& folder, const Executor& executor,
                                ProgressSink& progress) {
    DemoViews views;
    views.section.title = "The scene";
    for (unsigned camera = 0; camera < cameras; ++camera) {
        const RenderOptions options = optionsFor(baked, camera, samples, folder);
        auto rendered = render(options, executor, progress);
        if (!rendered) return rendered.error();
        const std::string alt = fmt::format("The demo scene from camera {}", camera);
        auto figure = figureOf(options.output, alt, alt + ", sun, shadows and sky.", renderCommand(options));
        if (!figure) return figure.error();
        views.section.blocks.emplace_back(std::move(*figure));
        views.files.push_back(options.output.filename().string());
        if (!options.triptych.empty()) {
            auto tests = figureOf(options.triptych, "Alpha tests without and with micromaps",
                                  "Where rays must ask the alpha texture: each time (middle), and with "
                                  "micromaps (right). The picture is the same.",
                                  renderCommand(options));
            if (!tests) return tests.error();
            views.section.blocks.emplace_back(std::move(*tests));
            views.section.blocks.emplace_back(testsTable(*rendered, renderCommand(options)));
            views.section.blocks.emplace_back(report::Links{
                {{renderPageFile,
                  "the first view with heat maps, the bits that lookups read, and other methods"}}});
            views.files.insert(views.files.end(), {triptychFile, renderPageFile});
        }
        views.renders.push_back(std::move(*rendered));
    }
    return views;
}

}  // namespace filigree::jobs
