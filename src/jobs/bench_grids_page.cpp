#include "jobs/bench_grids_page.h"

#include "filigree/report/number.h"

#include "jobs/command_words.h"
#include "jobs/page_parts.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

struct NamedRays {
    const char* name;
    BenchGridsSpeed BenchGridsRow::*speed;
};
constexpr std::array<NamedRays, 4> namedRays{{{"primary", &BenchGridsRow::primary},
                                              {"bounce", &BenchGridsRow::bounce},
                                              {"AO", &BenchGridsRow::ao},
                                              {"shuffled", &BenchGridsRow::shuffled}}};

std::string commandOf(const BenchGridsOptions& o) {
    const BenchGridsOptions usual;
    std::vector<std::string> words{"filigree", "bench", "grids"};
    words.insert(words.end(), o.scenes.begin(), o.scenes.end());
    const auto add = [&](const char* option, const std::string& value) {
        words.insert(words.end(), {option, value});
    };
    if (o.sizes != usual.sizes) add("--sizes", fmt::format("{}", fmt::join(o.sizes, ",")));
    if (!o.methods.empty()) add("--methods", fmt::format("{}", fmt::join(o.methods, ",")));
    if (o.lossless) words.emplace_back("--lossless");
    if (o.rounds != usual.rounds) add("--rounds", std::to_string(o.rounds));
    if (o.width != usual.width || o.height != usual.height)
        add("--size", fmt::format("{}x{}", o.width, o.height));
    if (o.leakRays != usual.leakRays) add("--leak-rays", std::to_string(o.leakRays));
    if (o.leakSize != usual.leakSize) add("--leak-size", std::to_string(o.leakSize));
    add("--html", o.page.string());
    return shellCommand(words);
}

// In the order of the rows, each once.
std::vector<std::string> distinct(const BenchGridsSummary& summary, std::string BenchGridsRow::*name) {
    std::vector<std::string> names;
    for (const BenchGridsRow& row : summary.rows) {
        if (std::ranges::find(names, row.*name) == names.end()) names.push_back(row.*name);
    }
    return names;
}

report::ScatterChart speedChart(const BenchGridsSummary& summary, const NamedRays& rays) {
    report::ScatterChart chart;
    chart.title = fmt::format("{} rays", rays.name);
    chart.x = {"memory", "bytes a triangle", true};
    chart.y = {"speed", "Mrays/s"};
    for (const std::string& method : distinct(summary, &BenchGridsRow::method)) {
        report::ScatterChart::Series series{method, {}, report::seriesColour(chart.series.size())};
        for (const BenchGridsRow& row : summary.rows) {
            if (row.method == method)
                series.points.push_back({row.bytesPerTriangle, (row.*rays.speed).mraysPerSecond, row.scene});
        }
        chart.series.push_back(std::move(series));
    }
    return chart;
}

// A group of bars a scene, a bar a method.
template <class Value>
report::BarChart barsOf(const BenchGridsSummary& summary, const std::string& title, const report::Axis& y,
                        Value value) {
    report::BarChart chart;
    chart.title = title;
    chart.y = y;
    chart.categories = distinct(summary, &BenchGridsRow::scene);
    for (const std::string& method : distinct(summary, &BenchGridsRow::method)) {
        report::BarChart::Series series{method, std::vector<double>(chart.categories.size()),
                                        report::seriesColour(chart.series.size())};
        for (const BenchGridsRow& row : summary.rows) {
            const auto at = std::ranges::find(chart.categories, row.scene) - chart.categories.begin();
            if (row.method == method) series.values[static_cast<size_t>(at)] = value(row);
        }
        chart.series.push_back(std::move(series));
    }
    return chart;
}

report::Section speedSection(const BenchGridsSummary& summary, const std::string& command) {
    report::FigureRow row;
    for (const NamedRays& rays : namedRays) {
        row.figures.push_back(
            report::chartFigure(speedChart(summary, rays),
                                "Up is faster, left is smaller; point at a dot for its scene.", command));
    }
    return {"Speed and memory", {std::move(row)}};
}

report::Section memoryBars(const BenchGridsSummary& summary, const std::string& command) {
    report::FigureRow row;
    row.figures.push_back(
        report::chartFigure(barsOf(summary, "Memory", {"bytes a triangle", "", true},
                                   [](const BenchGridsRow& r) { return r.bytesPerTriangle; }),
                            "All that is resident while rays are traced.", command));
    row.figures.push_back(report::chartFigure(
        barsOf(summary, "Build", {"seconds", "", true},
               [](const BenchGridsRow& r) { return r.buildSeconds; }),
        "The hierarchy, and the encoding where there is a codec, on all threads.", command));
    return {"Memory and build", {std::move(row)}};
}

}  // namespace

report::Page benchGridsPage(const BenchGridsOptions& options, const BenchGridsSummary& summary) {
    const std::string command = commandOf(options);
    report::Page page;
    page.title = "Compressed grids against Embree";
    page.lead =
        "Medians over rounds in which all methods take turns over the same rays on one thread, in CPU time.";
    report::Table rows = benchGridsTable(summary);
    rows.command = command;
    page.sections = {
        speedSection(summary, command), memoryBars(summary, command), {"All figures", {std::move(rows)}}};
    if (!summary.leaks.empty()) {
        report::Table leaks = benchLeaksTable(summary);
        leaks.command = command;
        page.sections.push_back({"Leaks", {std::move(leaks)}});
    }
    addNotes(summary.notes, page);
    return page;
}

}  // namespace filigree::jobs
