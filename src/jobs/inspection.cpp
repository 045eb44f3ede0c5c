#include "jobs/inspection.h"

#include "filigree/core/file.h"
#include "filigree/report/number.h"

#include "jobs/inspect_charts.h"
#include "jobs/lettering.h"
#include "jobs/one_stage.h"
#include "jobs/overlay.h"
#include "jobs/texture_group.h"

#include <algorithm>
#include <optional>
#include <system_error>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

// Pages larger than this are slow to open; further pictures stand beside them only.
constexpr size_t mostEmbedded = 24'000'000;  // bytes of PNG

// One texture on its way to a figure.
struct Sheet {
    TextureGroup group;
    InspectedTexture measured;
    std::optional<Result<report::Picture>> picture;
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

Result<report::Picture> drawSheet(const scene::Scene& scene, Sheet& sheet,
                                  const std::filesystem::path& folder) {
    InspectedTexture& m = sheet.measured;
    const auto triangles = overlayTriangles(scene, sheet.group);
    const OverlayLegend legend{fmt::format("{}: {} x {} texels, {} triangles", m.name, m.width, m.height,
                                           report::formatCount(m.triangles)),
                               m.areaShares()};
    const Overlay overlay =
        drawOverlay(textureOf(scene, sheet.group.source), sheet.group.source.test.factor, triangles, legend);
    m.distinctTriangles = triangles.size();
    m.drawnTriangles = overlay.drawn;
    auto png = overlay.canvas.png();
    if (!png) return png.error();
    return writePicture(folder, m.picture.string(), std::move(*png), overlay.canvas.width(),
                        overlay.canvas.height(),
                        "Micro-triangles of " + m.name + " in the colours of their states, over the alpha");
}

Status drawSheets(const scene::Scene& scene, std::vector<Sheet>& sheets, const std::filesystem::path& folder,
                  const Executor& executor, ProgressSink& progress) {
    OneStage stage(progress, "draw", sheets.size(), "textures");
    executor.parallelFor(sheets.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end && !stage.cancelled(); ++i) {
            sheets[i].picture = drawSheet(scene, sheets[i], folder);
            stage.advance(1);
        }
    });
    for (const Sheet& sheet : sheets) {
        if (!sheet.picture) return Error{ErrorKind::cancelled, "stopped while drawing"};
        if (!*sheet.picture) return sheet.picture->error();
    }
    return {};
}

report::Legend stateLegend() {
    report::Legend legend;
    for (size_t s = 0; s < 4; ++s) {
        const auto state = static_cast<micromap::State>(s);
        legend.swatches.push_back({stateColour(state), stateName(state)});
    }
    return legend;
}

std::string captionOf(const InspectedTexture& m) {
    using report::formatCount;
    std::string text = fmt::format(
        "{}: {} triangles, {} of them distinct, use {} micromaps. Grey below is the alpha.", m.name,
        formatCount(m.triangles), formatCount(m.distinctTriangles), formatCount(m.micromaps));
    if (m.drawnTriangles < m.distinctTriangles) {
        text +=
            fmt::format(" The picture shows the first {} distinct triangles.", formatCount(m.drawnTriangles));
    }
    return text;
}

report::Section overlaySection(std::vector<Sheet>& sheets, const std::string& command) {
    report::Section section{"States over the textures", {}};
    section.blocks.emplace_back(
        report::Paragraph{"Known micro-triangles are blue and need no alpha test; unknown ones are orange "
                          "and still call the any-hit "
                          "shader. The lighter of each pair is the opaque side. Triangles beyond the texture "
                          "are wrapped back into it, "
                          "later ones over earlier ones."});
    section.blocks.emplace_back(stateLegend());
    size_t embedded = 0;
    for (Sheet& sheet : sheets) {
        report::Picture picture = std::move(sheet.picture->value());
        embedded += picture.png.size();
        if (embedded > mostEmbedded) picture.png.clear();
        section.blocks.emplace_back(report::Figure{std::move(picture), captionOf(sheet.measured), command});
        section.blocks.emplace_back(stateTable(sheet.measured));
    }
    return section;
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
          Named{"states", stateChart(textures)}}) {
        const report::Drawing drawing = report::layOut(named.chart);
        const auto png = paint(drawing, 2).png();
        if (!png) return png.error();
        const std::string file = std::string(named.file) + ".png";
        if (const auto written = writeFile(folder / file, *png); !written) return written.error();
        summary.pictures.emplace_back(file);
        row.figures.push_back({drawing, fmt::format("The same picture as a file: {}.", file), command});
    }
    return report::Section{"Levels, sharing and states", {std::move(row)}};
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
                                const std::string& command, const Executor& executor,
                                ProgressSink& progress) {
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
    report::Table table = textureTable(summary.textures);
    table.command = command;
    inspection.sections.push_back({"Textures", {std::move(table)}});
    inspection.sections.push_back(overlaySection(sheets, command));
    auto charts = chartSection(summary.textures, folder, command, summary);
    if (!charts) return charts.error();
    inspection.sections.push_back(std::move(*charts));
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

Result<report::Picture> writePicture(const std::filesystem::path& folder, const std::string& file,
                                     std::vector<uint8_t> png, uint32_t width, uint32_t height,
                                     std::string alt) {
    if (const auto written = writeFile(folder / file, png); !written) return written.error();
    return report::Picture{std::move(png), width, height, std::move(alt), file};
}

std::string shellCommand(std::span<const std::string> words) {
    constexpr std::string_view plain =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._/=+:,@%";
    std::string command;
    for (const std::string& word : words) {
        if (!command.empty()) command += ' ';
        if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) {
            command += word;
            continue;
        }
        command += '\'';
        for (const char c : word) command += c == '\'' ? std::string("'\\''") : std::string(1, c);
        command += '\'';
    }
    return command;
}

}  // namespace filigree::jobs
