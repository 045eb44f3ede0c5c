#include "jobs/inspection.h"

#include "filigree/core/file.h"
#include "filigree/report/number.h"

#include "jobs/inspect_charts.h"
#include "jobs/inspect_view.h"
#include "jobs/lettering.h"
#include "jobs/one_stage.h"
#include "jobs/overlaps.h"
#include "jobs/overlay.h"
#include "jobs/texture_group.h"

#include <algorithm>
#include <optional>
#include <system_error>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

// One texture on its way to a figure.
struct Sheet {
    TextureGroup group;
    InspectedTexture measured;
    std::optional<Status> drawn;
};

// Names that tell textures apart also where one image is used in several ways.
void nameSheets(const scene::Scene& scene, std::vector<Sheet>& sheets) {
    for (size_t i = 0; i < sheets.size(); ++i) {
        const AlphaSource& source = sheets[i].group.source;
        std::string name = nameOf(scene, source);
        const auto sameImage = std::count_if(sheets.begin(), sheets.end(), [&](const Sheet& s) {
            return nameOf(scene, s.group.source) == name;
        });
        if (sameImage > 1) name += fmt::format(" ({})", i + 1);
        sheets[i].measured.name = name;
        sheets[i].measured.picture = fmt::format("overlay-{:02}-{}.png", i + 1, plainName(name));
    }
}

Status drawSheet(const scene::Scene& scene, Sheet& sheet, const std::filesystem::path& folder) {
    InspectedTexture& m = sheet.measured;
    const auto triangles = overlayTriangles(scene, sheet.group);
    const auto texture = textureOf(scene, sheet.group.source);
    const OverlayLegend legend{fmt::format("{}: {} x {} texels, {} triangles", m.name, m.width, m.height,
                                           report::formatCount(m.triangles)),
                               m.areaShares()};
    const Overlay overlay = drawOverlay(texture, sheet.group.source.test.factor, triangles, legend);
    m.distinctTriangles = triangles.size();
    m.drawnTriangles = overlay.drawn;
    m.overlaps = overlapShares(texture, triangles);
    const auto png = overlay.canvas.png();
    if (!png) return png.error();
    return writeFile(folder / m.picture, *png);
}

Status drawSheets(const scene::Scene& scene, std::vector<Sheet>& sheets, const std::filesystem::path& folder,
                  const Executor& executor, ProgressSink& progress) {
    OneStage stage(progress, "draw", sheets.size(), "textures");
    executor.parallelFor(sheets.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end && !stage.cancelled(); ++i) {
            sheets[i].drawn = drawSheet(scene, sheets[i], folder);
            stage.advance(1);
        }
    });
    for (const Sheet& sheet : sheets) {
        if (!sheet.drawn) return Error{ErrorKind::cancelled, "stopped while drawing"};
        if (!*sheet.drawn) return sheet.drawn->error();
    }
    return {};
}

report::Links pictureLinks(const std::vector<Sheet>& sheets) {
    using report::formatCount;
    report::Links links;
    for (const Sheet& sheet : sheets) {
        const InspectedTexture& m = sheet.measured;
        std::string text = m.name;
        if (m.drawnTriangles < m.distinctTriangles)
            text += fmt::format(", the first {} of {} distinct triangles", formatCount(m.drawnTriangles),
                                formatCount(m.distinctTriangles));
        links.links.push_back({m.picture.string(), text});
    }
    return links;
}

Result<report::Section> viewSection(const scene::Scene& scene, const std::vector<Sheet>& sheets,
                                    const ViewBudget& budget, const std::string& command,
                                    const Executor& executor) {
    std::vector<ViewInput> inputs;
    for (const Sheet& sheet : sheets) inputs.push_back({sheet.group, sheet.measured});
    auto view = inspectView(scene, inputs, budget, executor);
    if (!view) return view.error();
    view->caption =
        "Known micro-triangles are blue and need no alpha test; unknown ones are orange and still call the "
        "any-hit shader. The lighter of each pair is the opaque side, and grey below is the alpha. "
        "Triangles beyond the texture are wrapped back into it.";
    view->command = command;
    return report::Section{"Micro-triangles over the textures", {std::move(*view)}};
}

// Writes each chart as SVG and PNG, and gives the section that shows them.
Result<report::Section> chartSection(const std::vector<InspectedTexture>& textures,
                                     const std::filesystem::path& folder, const std::string& command,
                                     InspectSummary& summary) {
    struct Named {
        const char* file;
        report::BarChart chart;
    };
    report::FigureRow row;
    for (const Named& named :
         {Named{"levels", levelChart(textures)}, Named{"sharing", sharingChart(textures)},
          Named{"states", stateChart(textures)}, Named{"overlaps", overlapChart(textures)}}) {
        const report::Drawing drawing = report::layOut(named.chart);
        const auto png = paint(drawing, 2).png();
        if (!png) return png.error();
        const std::string file = std::string(named.file) + ".png";
        if (const auto written = writeFile(folder / file, *png); !written) return written.error();
        summary.pictures.emplace_back(file);
        row.figures.push_back(
            report::chartFigure(named.chart, fmt::format("The same picture as a file: {}.", file), command));
    }
    return report::Section{"Levels, sharing, states and overlaps", {std::move(row)}};
}

}  // namespace

std::string plainName(const std::string& name) {
    std::string plain;
    for (const char c : name) {
        const bool kept = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z');
        if (kept) {
            plain += c;
        } else if (!plain.empty() && plain.back() != '-') {
            plain += '-';
        }
    }
    return plain.substr(0, 40);
}

Result<Inspection> inspectScene(const scene::Scene& scene, const std::filesystem::path& folder,
                                const std::string& command, const ViewBudget& budget,
                                const Executor& executor, ProgressSink& progress) {
    Inspection inspection;
    InspectSummary& summary = inspection.summary;
    std::vector<Sheet> sheets;
    for (auto& group : textureGroups(scene, summary.notes)) {
        InspectedTexture measured = measure(scene, group);
        sheets.push_back({std::move(group), std::move(measured), {}});
    }
    nameSheets(scene, sheets);
    if (const auto drawn = drawSheets(scene, sheets, folder, executor, progress); !drawn)
        return drawn.error();
    for (const Sheet& sheet : sheets) {
        summary.textures.push_back(sheet.measured);
        summary.pictures.push_back(sheet.measured.picture);
    }
    auto view = viewSection(scene, sheets, budget, command, executor);
    if (!view) return view.error();
    if (!sheets.empty()) inspection.sections.push_back(std::move(*view));
    report::Table table = textureTable(summary.textures);
    table.command = command;
    inspection.sections.push_back({"Textures", {std::move(table), stateTable(summary.textures)}});
    auto charts = chartSection(summary.textures, folder, command, summary);
    if (!charts) return charts.error();
    inspection.sections.push_back(std::move(*charts));
    if (!sheets.empty())
        inspection.sections.push_back({"Still pictures beside this page", {pictureLinks(sheets)}});
    return inspection;
}

Status makeFolder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        return Error{ErrorKind::file,
                     fmt::format("{}: cannot make the folder: {}", folder.string(), error.message())};
    return {};
}

}  // namespace filigree::jobs
