#include "jobs/render_page.h"

#include "filigree/report/number.h"

#include "jobs/command_words.h"
#include "jobs/heat_map.h"
#include "jobs/page_parts.h"
#include "jobs/psnr.h"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

HeatSource testsOf(const MethodFilm& m) {
    return {"alpha tests a sample", m.film.alphaTests, m.film.width, m.film.height, m.film.samples};
}
HeatSource bitsOf(const MethodFilm& m) {
    return {"bits read a sample", m.film.bitsRead, m.film.width, m.film.height, m.film.samples};
}

const MethodFilm* textureOf(const std::vector<MethodFilm>& films) {
    const auto found = std::ranges::find(films, "texture", &MethodFilm::method);
    return found == films.end() ? nullptr : &*found;
}

uint64_t fetchesOf(const MethodFilm& m) {
    return m.film.counters.total().textureFetches;
}

// "94 % fewer"; empty where there is nothing to compare with.
std::string fewerText(const MethodFilm& m, const MethodFilm* texture) {
    if (texture == nullptr || texture == &m || fetchesOf(*texture) == 0) return "";
    const double share = 1 - static_cast<double>(fetchesOf(m)) / static_cast<double>(fetchesOf(*texture));
    return report::formatShare(share) + " fewer";
}

std::string agreementText(const MethodFilm& m, const MethodFilm& texture) {
    const scene::ColourImage expected = developed(texture.film);
    const scene::ColourImage picture = developed(m.film);
    if (expected.rgba == picture.rgba) return "the same to the bit";
    return fmt::format("PSNR {:.2f} dB", psnr(expected, picture));
}

Result<report::Figure> pictureFigure(const RenderOptions& options, const MethodFilm& m,
                                     const std::string& command) {
    auto picture = pictureOf(developed(m.film), "The rendered picture");
    if (!picture) return picture.error();
    return report::Figure{std::move(*picture),
                          fmt::format("{} x {}, {} samples a pixel, integrator {}.", m.film.width,
                                      m.film.height, m.film.samples, options.integrator),
                          command};
}

Result<report::Figure> heatFigure(const MethodFilm& m, const HeatSource& source, double end,
                                  const std::string& caption, const std::string& command) {
    constexpr uint32_t wide = 900;  // pixels, from which on half of them are enough beside another picture
    HeatPanel panel = source.width < wide ? heatPanel(source, end) : halvedHeatPanel(source, end);
    auto picture = pictureOf(panel.picture, fmt::format("{}: {}", m.method, source.what));
    if (!picture) return picture.error();
    report::Figure figure{std::move(*picture), caption, command};
    figure.scale = std::move(panel.scale);
    return figure;
}

// Where the rays of each method asked the texture, on one scale.
Result<report::Section> testsSection(const std::vector<MethodFilm>& films, const std::string& command) {
    const MethodFilm* const texture = textureOf(films);
    double end = 0;
    for (const MethodFilm& m : films) end = std::max(end, heatEnd(testsOf(m)));
    std::vector<const MethodFilm*> order;
    if (texture != nullptr) order.push_back(texture);
    for (const MethodFilm& m : films) {
        if (&m != texture) order.push_back(&m);
    }
    report::FigureRow row;
    for (const MethodFilm* m : order) {
        std::string caption =
            fmt::format("{}: {} alpha tests", m->method, report::formatCount(fetchesOf(*m)));
        if (const std::string fewer = fewerText(*m, texture); !fewer.empty()) caption += ", " + fewer;
        auto figure = heatFigure(*m, testsOf(*m), end, caption + ".", command);
        if (!figure) return figure.error();
        row.figures.push_back(std::move(*figure));
    }
    return report::Section{"Where rays ask the texture", {std::move(row)}};
}

Result<report::Section> bitsSection(const std::vector<MethodFilm>& films, const std::string& command) {
    report::Section section{"Bits that lookups read", {}};
    double end = 0;
    for (const MethodFilm& m : films) {
        if (m.film.counters.total().bitsRead > 0) end = std::max(end, heatEnd(bitsOf(m)));
    }
    report::FigureRow row;
    for (const MethodFilm& m : films) {
        const trace::RayCounts all = m.film.counters.total();
        if (all.bitsRead == 0) continue;
        const double mean = static_cast<double>(all.bitsRead) / static_cast<double>(all.lookups);
        auto figure =
            heatFigure(m, bitsOf(m), end, fmt::format("{}: {:.1f} bits a lookup.", m.method, mean), command);
        if (!figure) return figure.error();
        row.figures.push_back(std::move(*figure));
    }
    if (!row.figures.empty()) section.blocks.emplace_back(std::move(row));
    return section;
}

report::Table methodTable(const std::vector<MethodFilm>& films, const std::string& command) {
    using report::Show;
    const MethodFilm* const texture = textureOf(films);
    report::Table table;
    table.caption = "The same rays by each method; the speed is that of rays whose bits are counted";
    table.command = command;
    table.columns = {{"method", "method"},
                     {"states", "states"},
                     {"fetches", "alpha tests"},
                     {"fetches_per_ray", "a ray", "", Show::plain, 4},
                     {"bits_per_lookup", "bits a lookup", "", Show::plain, 1},
                     {"opacity_bytes", "maps", "", Show::bytes},
                     {"mrays", "speed", "Mrays/s", Show::plain, 2},
                     {"picture", "picture"}};
    for (const MethodFilm& m : films) {
        const trace::RayCounts all = m.film.counters.total();
        const auto rays = static_cast<double>(all.rays);
        report::Cell bits;
        if (all.bitsRead > 0) bits = static_cast<double>(all.bitsRead) / static_cast<double>(all.lookups);
        report::Cell agreement;
        if (texture != nullptr && texture != &m) agreement = agreementText(m, *texture);
        table.rows.push_back({m.method, m.states ? report::Cell(int64_t{*m.states}) : report::Cell(),
                              static_cast<int64_t>(all.textureFetches),
                              static_cast<double>(all.textureFetches) / std::max(rays, 1.0), bits,
                              static_cast<int64_t>(m.opacityBytes),
                              m.seconds > 0 ? rays / m.seconds * 1e-6 : 0.0, agreement});
    }
    return table;
}

report::BarChart testsChart(const std::vector<MethodFilm>& films) {
    report::BarChart chart;
    chart.title = "Alpha tests by method";
    chart.y = {"alpha tests"};
    report::BarChart::Series series;
    for (const MethodFilm& m : films) {
        chart.categories.push_back(m.method);
        series.values.push_back(static_cast<double>(fetchesOf(m)));
        series.colours.push_back(methodColour(m.method));
    }
    chart.series.push_back(std::move(series));
    return chart;
}

report::Section methodSection(const std::vector<MethodFilm>& films, const std::string& command) {
    report::Section section{"Methods side by side", {methodTable(films, command)}};
    section.blocks.emplace_back(
        report::chartFigure(testsChart(films), "How often each method had to ask the texture.", command));
    return section;
}

report::Table byteTable(const RenderSummary& s, const std::string& command) {
    const auto bytes = [](uint64_t n) { return report::formatBytes(static_cast<double>(n)); };
    std::vector<std::vector<report::Cell>> rows{{"Opacity: maps, records and indices", bytes(s.opacityBytes)},
                                                {"Alpha textures", bytes(s.textureBytes)},
                                                {"Geometry", bytes(s.geometryBytes)},
                                                {"Hierarchy", bytes(s.bvhBytes)}};
    if (s.grids) {
        rows.push_back({fmt::format("of geometry and hierarchy: {} triangles in grids ({})",
                                    report::formatCount(s.grids->triangles), s.grids->codec),
                        bytes(s.grids->bytes)});
    }
    return factTable("Memory while rays are traced", command, std::move(rows));
}

report::Section costSection(const RenderSummary& s, const std::string& command) {
    report::Table rays = rayTable(s);
    rays.command = command;
    report::Section section{"Rays and memory", {std::move(rays), byteTable(s, "")}};
    const auto seconds = [](double value) { return fmt::format("{:.2f} s", value); };
    section.blocks.emplace_back(
        factTable("Time", "",
                  {{"To the first sample", seconds(s.firstSampleSeconds)},
                   {"Tracing", seconds(s.seconds)},
                   {"Speed", fmt::format("{:.2f} million rays a second", s.mraysPerSecond())},
                   {"Traced by", s.device.empty() ? "the CPU" : s.device + ", " + s.driver}}));
    return section;
}

std::string titleOf(const RenderOptions& options) {
    return "A picture of " + options.input.filename().string();
}

std::string leadOf(const RenderSummary& s, const std::vector<MethodFilm>& films) {
    if (films.front().film.counters.total().candidateHits == 0)
        return "No ray met a surface with an alpha test.";
    std::string text = fmt::format("Alpha tested by {}", s.method);
    if (s.states) text += fmt::format(" with {} states", *s.states);
    if (s.level) text += fmt::format(" at level {}", *s.level);
    const MethodFilm* const texture = textureOf(films);
    if (texture == nullptr || texture == &films.front()) return text + ".";
    return fmt::format("{}: {} alpha tests than with the texture alone, and the picture is {}.", text,
                       fewerText(films.front(), texture), agreementText(films.front(), *texture));
}

}  // namespace

Result<report::Page> renderPage(const RenderOptions& options, const RenderSummary& summary,
                                const std::vector<MethodFilm>& films) {
    const std::string command = renderCommand(options);
    report::Page page;
    page.title = titleOf(options);
    page.lead = leadOf(summary, films);
    auto picture = pictureFigure(options, films.front(), command);
    if (!picture) return picture.error();
    page.sections.push_back({"The picture", {std::move(*picture)}});
    const bool asks = std::ranges::any_of(
        films, [](const MethodFilm& m) { return m.film.counters.total().candidateHits > 0; });
    if (asks) {
        auto tests = testsSection(films, command);
        if (!tests) return tests.error();
        page.sections.push_back(std::move(*tests));
        auto bits = bitsSection(films, command);
        if (!bits) return bits.error();
        if (!bits->blocks.empty()) page.sections.push_back(std::move(*bits));
        if (films.size() > 1) page.sections.push_back(methodSection(films, command));
    }
    page.sections.push_back(costSection(summary, command));
    addNotes(summary.notes, page);
    return page;
}

}  // namespace filigree::jobs
