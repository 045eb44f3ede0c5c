#include "jobs/bench_trace_page.h"

#include "jobs/command_words.h"
#include "jobs/page_parts.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

// All rows of one scene and kind of rays.
struct RaceRows {
    std::string scene;
    std::string rays;
    std::vector<const BenchTraceRow*> rows;
};

std::vector<RaceRows> racesOf(const BenchTraceSummary& summary) {
    std::vector<RaceRows> races;
    for (const BenchTraceRow& row : summary.rows) {
        auto at = std::ranges::find_if(
            races, [&](const RaceRows& race) { return race.scene == row.scene && race.rays == row.rays; });
        if (at == races.end()) at = races.insert(at, {row.scene, row.rays, {}});
        at->rows.push_back(&row);
    }
    return races;
}

std::string commandOf(const BenchTraceOptions& o) {
    const BenchTraceOptions usual;
    std::vector<std::string> words{"filigree", "bench", "trace"};
    for (const auto& input : o.inputs) words.push_back(input.string());
    const auto add = [&](const char* option, const std::string& value) {
        words.insert(words.end(), {option, value});
    };
    const auto joined = [](const auto& list) { return fmt::format("{}", fmt::join(list, ",")); };
    if (o.levels != usual.levels) add("--levels", joined(o.levels));
    if (o.states != usual.states) add("--states", joined(o.states));
    if (!o.methods.empty()) add("--methods", joined(o.methods));
    if (o.rays != usual.rays) add("--rays", joined(o.rays));
    if (o.rounds != usual.rounds) add("--rounds", std::to_string(o.rounds));
    if (o.width != usual.width || o.height != usual.height)
        add("--size", fmt::format("{}x{}", o.width, o.height));
    const std::string camera = cameraWord(o.camera);
    if (!camera.empty()) words.push_back(camera);
    if (o.overview) words.emplace_back("--overview");
    if (o.atlas > 0) add("--atlas", std::to_string(o.atlas));
    const std::vector<std::string> tests = testWords(o.parameters);
    words.insert(words.end(), tests.begin(), tests.end());
    add("--html", o.page.string());
    return shellCommand(words);
}

// What the speed of a row is for: of one level and one number of states.
std::string formOf(const BenchTraceRow& row) {
    std::string form;
    if (row.states) form = fmt::format("{} states", *row.states);
    if (row.level) form += fmt::format(", level {}", *row.level);
    return form;
}

std::vector<std::string> methodsOf(const RaceRows& race) {
    std::vector<std::string> methods;
    for (const BenchTraceRow* row : race.rows) {
        if (std::ranges::find(methods, row->method) == methods.end()) methods.push_back(row->method);
    }
    return methods;
}

report::ScatterChart memoryScatter(const RaceRows& race) {
    report::ScatterChart chart;
    chart.title = fmt::format("{}, {} rays", race.scene, race.rays);
    chart.x = {"memory of the maps", "bytes", true};
    chart.y = {"speed", "Mrays/s"};
    for (const std::string& method : methodsOf(race)) {
        report::ScatterChart::Series series{method, {}, methodColour(method), method.starts_with("vq")};
        for (const BenchTraceRow* row : race.rows) {
            if (row->method == method && row->opacityBytes > 0)
                series.points.push_back(
                    {static_cast<double>(row->opacityBytes), row->mraysPerSecond, formOf(*row)});
        }
        if (!series.points.empty()) chart.series.push_back(std::move(series));
    }
    return chart;
}

// The best of each method's forms against asking the texture alone.
report::BarChart bestBars(const RaceRows& race) {
    report::BarChart chart;
    chart.title = "Best against texture";
    chart.y = {"speed over texture's"};
    chart.categories = methodsOf(race);
    report::BarChart::Series series;
    series.values.resize(chart.categories.size());
    for (size_t k = 0; k < chart.categories.size(); ++k) {
        series.colours.push_back(methodColour(chart.categories[k]));
        for (const BenchTraceRow* row : race.rows) {
            if (row->method == chart.categories[k])
                series.values[k] = std::max(series.values[k], row->ratioToTexture);
        }
    }
    chart.series.push_back(std::move(series));
    return chart;
}

report::Section raceSection(const RaceRows& race, const std::string& command) {
    report::FigureRow row;
    row.figures.push_back(report::chartFigure(
        memoryScatter(race),
        "Each dot is a method at one level and number of states; up is faster, left is smaller.", command));
    row.figures.push_back(report::chartFigure(
        bestBars(race), "The fastest form of each method, 2 states included; texture is 1.", command));
    return {fmt::format("{}: {} rays", race.scene, race.rays), {std::move(row)}};
}

}  // namespace

report::Page benchTracePage(const BenchTraceOptions& options, const BenchTraceSummary& summary) {
    const std::string command = commandOf(options);
    report::Page page;
    page.title = "The speed of alpha tests";
    page.lead =
        "Medians over rounds in which all methods take turns over the same rays on one thread, in CPU time "
        "of "
        "these rays alone: nothing is shaded.";
    for (const RaceRows& race : racesOf(summary)) page.sections.push_back(raceSection(race, command));
    report::Table rows = benchTraceTable(summary);
    rows.command = command;
    page.sections.push_back({"All figures", {std::move(rows)}});
    addNotes(summary.notes, page);
    return page;
}

}  // namespace filigree::jobs
