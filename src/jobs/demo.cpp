#include "filigree/jobs/demo.h"

#include "filigree/core/file.h"
#include "filigree/io/gltf.h"
#include "filigree/report/number.h"

#include "jobs/command_words.h"
#include "jobs/demo_scene.h"
#include "jobs/demo_sizes.h"
#include "jobs/demo_terrain.h"
#include "jobs/demo_views.h"
#include "jobs/inspection.h"
#include "jobs/json_text.h"

#include <string>
#include <vector>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

constexpr const char* sceneFile = "scene.glb";
constexpr const char* bakedFile = "scene_omm.glb";

std::string command(std::initializer_list<std::string> words) {
    return shellCommand(std::vector<std::string>(words));
}

Status writeScene(const std::filesystem::path& path) {
    const auto bytes = makeDemoScene();
    if (!bytes) return bytes.error();
    return writeFile(path, *bytes);
}

report::Table bakeTable(const DemoSummary& s) {
    const auto count = [](uint64_t n) { return static_cast<int64_t>(n); };
    uint64_t special = 0;
    for (const uint64_t n : s.bake.special) special += n;
    report::Table table;
    table.caption = "The bake";
    table.command = command({"filigree", "bake", s.scene.string(), "-o", s.baked.string()});
    table.columns = {{"what", "What"}, {"value", "Value"}};
    table.rows = {{"Triangles of the scene", count(s.bake.triangles)},
                  {"of them cut out by alpha", count(s.bake.maskedTriangles)},
                  {"Micromaps", count(s.bake.micromaps)},
                  {"Triangles with a special index", count(special)},
                  {"Micro-triangles", count(s.bake.microTriangles)},
                  {"Known micro-triangles", report::formatShare(s.bake.knownShare())},
                  {"Data", report::formatBytes(static_cast<double>(s.bake.dataBytes))},
                  {"Records", report::formatBytes(static_cast<double>(s.bake.recordBytes))},
                  {"Indices", report::formatBytes(static_cast<double>(s.bake.indexBytes))}};
    return table;
}

report::Table validationTable(const DemoSummary& s) {
    const auto count = [](uint64_t n) { return static_cast<int64_t>(n); };
    const DeepSummary deep = s.validation.deep.value_or(DeepSummary{});
    report::Table table;
    table.caption = "The proof: every rule of the format, and every micro-triangle against its texture";
    table.command = command({"filigree", "validate", s.baked.string(), "--deep"});
    table.columns = {{"what", "What"}, {"value", "Value"}};
    table.rows = {{"Broken rules", count(s.validation.breaches.size())},
                  {"Micro-triangles examined", count(deep.microTriangles)},
                  {"wrongly known", count(deep.wrong)},
                  {"unknown, though one side throughout", count(deep.overCautious)},
                  {"too close to the cutoff to tell", count(deep.uncertain)}};
    return table;
}

report::Section filesSection() {
    return {"Files",
            {report::Links{{{sceneFile, "the scene as it was made"},
                            {bakedFile, "the same with opacity micromaps (EXT_mesh_opacity_micromap)"},
                            {"terrain.png", "a terrain as 16-bit heights"},
                            {"terrain.fil", "the same as compressed grids"}}}}};
}

Result<scene::Scene> readBaked(const DemoSummary& summary) {
    const auto document = io::GltfDocument::load(summary.baked);
    if (!document) return document.error();
    io::ReadOptions reading;
    reading.blendAlpha = true;
    return io::readScene(*document, reading);
}

report::Page pageOf(const DemoSummary& summary, std::vector<report::Section> sections) {
    report::Page page;
    page.title = "Filigree demo";
    page.lead =
        "A glade made in code, baked to opacity micromaps, proved right and rendered with and without them. "
        "Trees, ferns, grass, blossoms and a chain-link fence are flat cards that alpha textures cut out.";
    page.sections = std::move(sections);
    page.sections.insert(page.sections.begin() + 1,
                         report::Section{"Bake and proof", {bakeTable(summary), validationTable(summary)}});
    page.sections.push_back(filesSection());
    return page;
}

// Views first, then what inspect shows.
Result<std::vector<report::Section>> drawBaked(DemoSummary& summary, const DemoOptions& options,
                                               const Executor& executor, ProgressSink& progress) {
    const auto& folder = options.outputFolder;
    const auto scene = readBaked(summary);
    if (!scene) return scene.error();
    auto inspection = inspectScene(
        *scene, folder, command({"filigree", "inspect", summary.baked.string(), "-o", folder.string()}),
        ViewBudget{}, executor, progress);
    if (!inspection) return inspection.error();
    summary.inspection = std::move(inspection->summary);
    summary.inspection.page = summary.page;
    auto views =
        drawDemoViews(summary.baked, scene->cameras.size(), options.samples, folder, executor, progress);
    if (!views) return views.error();
    summary.views = std::move(views->renders);
    summary.inspection.pictures.insert(summary.inspection.pictures.end(), views->files.begin(),
                                       views->files.end());
    std::vector<report::Section> sections = std::move(inspection->sections);
    sections.insert(sections.begin(), std::move(views->section));
    return sections;
}

// Compresses the terrain and traces it.
Result<report::Section> addTerrain(DemoSummary& summary, const DemoOptions& options, const Executor& executor,
                                   ProgressSink& progress) {
    auto terrain = drawDemoTerrain(options.outputFolder, options.samples, executor, progress);
    if (!terrain) return terrain.error();
    summary.heights = std::move(terrain->heights);
    summary.terrain = std::move(terrain->grids);
    summary.grids = std::move(terrain->conversion);
    summary.terrainView = std::move(terrain->render);
    summary.inspection.pictures.insert(summary.inspection.pictures.end(), terrain->files.begin(),
                                       terrain->files.end());
    return std::move(terrain->section);
}

// The demo shows that the micromaps are right; if they are not it must not look like a success.
Status requireValid(const DemoSummary& summary) {
    if (summary.validation.valid()) return {};
    const auto& breaches = summary.validation.breaches;
    const std::string first = breaches.empty() ? "" : ": " + breaches[0].path + ": " + breaches[0].message;
    return Error{ErrorKind::format,
                 fmt::format("{}: the bake is not valid{}", summary.baked.string(), first)};
}

}  // namespace

Result<DemoSummary> demo(const DemoOptions& options, const Executor& executor, ProgressSink& progress) {
    const auto& folder = options.outputFolder;
    DemoSummary summary;
    summary.page = folder / "index.html";
    summary.scene = folder / sceneFile;
    summary.baked = folder / bakedFile;
    if (const auto made = makeFolder(folder); !made) return made.error();
    if (const auto written = writeScene(summary.scene); !written) return written.error();

    auto baked = bake({summary.scene, summary.baked, {}, options.parameters}, executor, progress);
    if (!baked) return baked.error();
    summary.bake = std::move(*baked);

    ValidateOptions deep;
    deep.input = summary.baked;
    deep.deep = true;
    auto validation = validate(deep, executor, progress);
    if (!validation) return validation.error();
    summary.validation = std::move(*validation);
    if (const auto valid = requireValid(summary); !valid) return valid.error();

    auto sections = drawBaked(summary, options, executor, progress);
    if (!sections) return sections.error();
    auto terrain = addTerrain(summary, options, executor, progress);
    if (!terrain) return terrain.error();
    sections->insert(sections->begin() + 1, std::move(*terrain));
    auto sizes = measureDemo(summary.scene, folder, executor, progress);
    if (!sizes) return sizes.error();
    sections->insert(sections->end(), sizes->begin(), sizes->end());
    const std::string html = report::toHtml(pageOf(summary, std::move(*sections)));
    if (const auto written = writeFile(summary.page, html); !written) return written.error();
    return summary;
}

std::string toJson(const DemoSummary& s) {
    Json json = {{"page", s.page.string()},
                 {"scene", s.scene.string()},
                 {"baked", s.baked.string()},
                 {"bake", Json::parse(toJson(s.bake))},
                 {"validate", Json::parse(toJson(s.validation))},
                 {"inspect", Json::parse(toJson(s.inspection))}};
    json["terrain"] = {{"heights", s.heights.string()},
                       {"file", s.terrain.string()},
                       {"grids", Json::parse(toJson(s.grids))},
                       {"render", Json::parse(toJson(s.terrainView))}};
    for (const RenderSummary& view : s.views) json["render"].push_back(Json::parse(toJson(view)));
    return dump(json);
}

}  // namespace filigree::jobs
