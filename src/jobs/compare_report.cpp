#include "filigree/jobs/compare.h"

#include "jobs/command_words.h"
#include "jobs/json_text.h"
#include "jobs/page_parts.h"

#include <algorithm>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

int64_t whole(uint64_t value) {
    return static_cast<int64_t>(value);
}

// Those that have a row with `states`, in the order of the rows.
std::vector<std::string> methodsOf(const CompareSummary& summary, unsigned states) {
    std::vector<std::string> methods;
    for (const CompareRow& row : summary.rows) {
        if (row.states != states || std::ranges::find(methods, row.method) != methods.end()) continue;
        methods.push_back(row.method);
    }
    return methods;
}

std::vector<unsigned> levelsOf(const CompareSummary& summary) {
    std::vector<unsigned> levels;
    for (const CompareRow& row : summary.rows) levels.push_back(row.level);
    std::ranges::sort(levels);
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    return levels;
}

const CompareRow* find(const CompareSummary& summary, const std::string& method, unsigned level,
                       unsigned states) {
    for (const CompareRow& row : summary.rows) {
        if (row.method == method && row.level == level && row.states == states) return &row;
    }
    return nullptr;
}

std::string joined(const std::vector<unsigned>& numbers) {
    return fmt::format("{}", fmt::join(numbers, ","));
}

std::string commandOf(const CompareOptions& options) {
    std::vector<std::string> words{"filigree", "compare", options.input.string(), "--levels",
                                   joined(options.levels)};
    if (options.states.size() == 1) words.insert(words.end(), {"--states", joined(options.states)});
    const std::vector<std::string> more = testWords(options.parameters);
    words.insert(words.end(), more.begin(), more.end());
    words.insert(words.end(), {"--html", options.page.empty() ? "compare.html" : options.page.string()});
    return shellCommand(words);
}

// A level line over the whole chart.
report::LineChart::Series constant(const std::string& name, uint64_t bytes,
                                   const std::vector<unsigned>& levels, size_t colour) {
    report::LineChart::Series series{name, {}, report::seriesColour(colour), true};
    for (const unsigned level : {levels.front(), levels.back()})
        series.points.emplace_back(level, static_cast<double>(bytes));
    return series;
}

}  // namespace

report::Table comparisonTable(const CompareSummary& summary, unsigned states) {
    using report::Show;
    const auto methods = methodsOf(summary, states);
    report::Table table;
    table.caption = fmt::format("{}, {} states: payload and descriptors", summary.scene, states);
    table.columns = {{"level", "level", ""}, {"maps", "maps", ""}};
    for (const auto& method : methods) table.columns.push_back({method, method, "", Show::bytes});
    table.columns.push_back({"indices", "indices", "", Show::bytes});
    for (const unsigned level : levelsOf(summary)) {
        std::vector<report::Cell> cells{int64_t{level}};
        for (const auto& method : methods) {
            const CompareRow* const row = find(summary, method, level, states);
            if (cells.size() == 1) cells.emplace_back(row ? report::Cell(whole(row->maps)) : report::Cell());
            cells.emplace_back(row ? report::Cell(whole(row->payloadBytes + row->descriptorBytes))
                                   : report::Cell());
        }
        const CompareRow* const row = methods.empty() ? nullptr : find(summary, methods[0], level, states);
        if (row == nullptr) continue;
        cells.emplace_back(whole(row->indexBytes));
        table.rows.push_back(std::move(cells));
    }
    return table;
}

report::Table rowTable(const CompareSummary& summary) {
    report::Table table;
    table.caption = "Every method on " + summary.scene;
    table.columns = {{"method", "method"},
                     {"level", "level"},
                     {"states", "states"},
                     {"maps", "maps"},
                     {"payload_bytes", "payload", "bytes"},
                     {"descriptor_bytes", "descriptors", "bytes"},
                     {"index_bytes", "indices", "bytes"},
                     {"total_bytes", "total", "bytes"},
                     {"encode_seconds", "encode", "s"}};
    for (const CompareRow& r : summary.rows) {
        table.rows.push_back({r.method, int64_t{r.level}, int64_t{r.states}, whole(r.maps),
                              whole(r.payloadBytes), whole(r.descriptorBytes), whole(r.indexBytes),
                              whole(r.totalBytes()), r.encodeSeconds});
    }
    return table;
}

report::LineChart comparisonChart(const CompareSummary& summary, unsigned states) {
    report::LineChart chart;
    chart.title = fmt::format("{}, {} states", summary.scene, states);
    chart.x = {"level"};
    chart.x.whole = true;
    chart.y = {"memory", "bytes", true};
    const auto levels = levelsOf(summary);
    for (const auto& method : methodsOf(summary, states)) {
        report::LineChart::Series series{method, {}, methodColour(method)};
        for (const unsigned level : levels) {
            if (const CompareRow* const row = find(summary, method, level, states))
                series.points.emplace_back(level, static_cast<double>(row->totalBytes()));
        }
        chart.series.push_back(std::move(series));
    }
    if (levels.empty()) return chart;
    chart.series.push_back(constant("texture", summary.textureBytes, levels, 2));
    chart.series.push_back(constant("vertices", summary.vertexBytes, levels, 6));
    chart.series.push_back(constant("triangle indices", summary.triangleIndexBytes, levels, 7));
    return chart;
}

std::vector<report::Section> comparisonSections(const CompareSummary& summary,
                                                const CompareOptions& options) {
    const std::string command = commandOf(options);
    std::vector<report::Section> sections;
    for (const unsigned states : options.states) {
        report::Section section{fmt::format("{} states", states), {}};
        section.blocks.emplace_back(report::chartFigure(
            comparisonChart(summary, states),
            "Payload, descriptors and the indices of all masked triangles. Dashed: what the scene needs "
            "besides, its alpha texels at a byte each, texture coordinates and triangle indices.",
            command));
        section.blocks.emplace_back(comparisonTable(summary, states));
        sections.push_back(std::move(section));
    }
    report::Table rows = rowTable(summary);
    rows.command = command;
    sections.push_back({"All figures", {std::move(rows)}});
    return sections;
}

std::string toJson(const CompareSummary& s) {
    Json rows = Json::array();
    for (const CompareRow& r : s.rows) {
        rows.push_back({{"method", r.method},
                        {"level", r.level},
                        {"states", r.states},
                        {"payload_bytes", r.payloadBytes},
                        {"descriptor_bytes", r.descriptorBytes},
                        {"index_bytes", r.indexBytes},
                        {"total_bytes", r.totalBytes()},
                        {"maps", r.maps},
                        {"encode_seconds", r.encodeSeconds}});
    }
    return dump({{"scene", s.scene},
                 {"triangles", s.triangles},
                 {"masked_triangles", s.maskedTriangles},
                 {"rows", rows},
                 {"texture_bytes", s.textureBytes},
                 {"vertex_bytes", s.vertexBytes},
                 {"triangle_index_bytes", s.triangleIndexBytes},
                 {"seconds", s.seconds},
                 {"peak_bytes", s.peakBytes}});
}

}  // namespace filigree::jobs
