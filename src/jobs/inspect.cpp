#include "filigree/jobs/inspect.h"

#include "filigree/core/file.h"
#include "filigree/io/gltf.h"

#include "jobs/command_words.h"
#include "jobs/inspection.h"
#include "jobs/json_text.h"
#include "jobs/overlay.h"
#include "jobs/page_parts.h"

#include <algorithm>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

std::string commandOf(const InspectOptions& options, bool baked) {
    std::vector<std::string> words = {"filigree", "inspect", options.input.string(), "-o",
                                      options.outputFolder.string()};
    if (baked) {
        const auto more = bakeWords(options.parameters);
        words.insert(words.end(), more.begin(), more.end());
    }
    if (options.full) words.emplace_back("--full");
    return shellCommand(words);
}

Result<scene::Scene> readInput(const InspectOptions& options) {
    const auto document = io::GltfDocument::load(options.input);
    if (!document) return document.error();
    io::ReadOptions reading;
    reading.blendAlpha = true;
    return io::readScene(*document, reading);
}

report::Page pageOf(const InspectOptions& options, Inspection inspection) {
    report::Page page;
    const std::string name = options.input.filename().string();
    page.title = "Opacity micromaps of " + name;
    page.lead = inspection.summary.bakedInMemory
                    ? name + " has no micromaps; these were baked for the page and not written."
                    : "The micromaps as the file holds them.";
    page.sections = std::move(inspection.sections);
    addNotes(inspection.summary.notes, page);
    return page;
}

Json byState(const auto& values) {
    return {{"transparent", values[0]},
            {"opaque", values[1]},
            {"unknown_transparent", values[2]},
            {"unknown_opaque", values[3]}};
}

Json byNumber(const auto& counts) {
    Json json = Json::object();
    for (const auto& [key, count] : counts) json[std::to_string(key)] = count;
    return json;
}

}  // namespace

Result<InspectSummary> inspect(const InspectOptions& options, const Executor& executor,
                               ProgressSink& progress) {
    auto scene = readInput(options);
    if (!scene) return scene.error();
    std::vector<std::string> notes = scene->notes;
    const bool baked = scene->micromaps.empty();
    if (baked) {
        const auto summary = bakeScene(*scene, options.parameters, executor, progress);
        if (!summary) return summary.error().within(options.input.string());
        notes.insert(notes.end(), summary->notes.begin(), summary->notes.end());
    }
    if (const auto made = makeFolder(options.outputFolder); !made) return made.error();
    auto inspection = inspectScene(*scene, options.outputFolder, commandOf(options, baked),
                                   options.full ? noViewBudget : ViewBudget{}, executor, progress);
    if (!inspection) return inspection.error().within(options.input.string());
    InspectSummary& summary = inspection->summary;
    summary.bakedInMemory = baked;
    summary.page = options.outputFolder / "index.html";
    summary.notes.insert(summary.notes.begin(), notes.begin(), notes.end());
    InspectSummary result = summary;
    const std::string html = report::toHtml(pageOf(options, std::move(*inspection)));
    if (const auto written = writeFile(result.page, html); !written) return written.error();
    return result;
}

std::string toJson(const InspectSummary& s) {
    Json json = {{"page", s.page.string()}, {"baked_in_memory", s.bakedInMemory}};
    json["pictures"] = Json::array();
    for (const auto& picture : s.pictures) json["pictures"].push_back(picture.string());
    json["textures"] = Json::array();
    for (const InspectedTexture& t : s.textures) {
        json["textures"].push_back({{"name", t.name},
                                    {"picture", t.picture.string()},
                                    {"width", t.width},
                                    {"height", t.height},
                                    {"triangles", t.triangles},
                                    {"distinct_triangles", t.distinctTriangles},
                                    {"micromaps", t.micromaps},
                                    {"bytes", t.bytes},
                                    {"special", byState(t.special)},
                                    {"states", byState(t.states)},
                                    {"area_share", byState(t.areaShares())},
                                    {"levels", byNumber(t.levels)},
                                    {"sharing", byNumber(t.sharing)},
                                    {"overlap_share", byNumber(t.overlaps)}});
    }
    json["notes"] = s.notes;
    return dump(json);
}

}  // namespace filigree::jobs
