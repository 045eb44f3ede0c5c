#include "jobs/inspect_charts.h"

#include "jobs/overlay.h"

#include <algorithm>
#include <bit>
#include <map>
#include <numeric>
#include <string_view>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

using Counts = std::map<unsigned, double>;  // by bin

constexpr size_t mostSeries = 6;       // beside each other in a group of bars
constexpr size_t mostCategories = 12;  // textures side by side

// One series a texture, or one for all where they are too many.
std::vector<report::BarChart::Series> seriesOf(const std::vector<InspectedTexture>& textures,
                                               const std::vector<Counts>& counts,
                                               const std::vector<unsigned>& bins) {
    std::vector<report::BarChart::Series> series;
    const bool summed = textures.size() > mostSeries;
    for (size_t i = 0; i < (summed ? 1 : textures.size()); ++i) {
        series.push_back({summed ? "all textures" : textures[i].name, {}, report::seriesColour(i)});
    }
    for (const unsigned bin : bins) {
        for (auto& s : series) s.values.push_back(0);
        for (size_t i = 0; i < counts.size(); ++i) {
            const auto found = counts[i].find(bin);
            if (found != counts[i].end()) series[summed ? 0 : i].values.back() += found->second;
        }
    }
    return series;
}

std::vector<unsigned> binsOf(const std::vector<Counts>& counts) {
    unsigned lo = ~0U;
    unsigned hi = 0;
    for (const Counts& c : counts) {
        if (c.empty()) continue;
        lo = std::min(lo, c.begin()->first);
        hi = std::max(hi, c.rbegin()->first);
    }
    std::vector<unsigned> bins;
    for (unsigned bin = lo; bin <= hi && lo != ~0U; ++bin) bins.push_back(bin);
    return bins;
}

// Large differences show on a logarithmic axis only.
bool needsLog(const report::BarChart& chart) {
    double lo = 0;
    double hi = 0;
    for (const auto& series : chart.series) {
        for (const double value : series.values) {
            if (value <= 0) continue;
            lo = lo == 0 ? value : std::min(lo, value);
            hi = std::max(hi, value);
        }
    }
    return hi > 50 * lo && lo > 0;
}

// Bin b holds 2^(b-1) + 1 to 2^b triangles.
unsigned powerBin(uint64_t triangles) {
    return static_cast<unsigned>(std::bit_width(triangles - 1));
}

std::string powerBinName(unsigned bin) {
    const uint64_t last = uint64_t{1} << bin;
    if (bin < 2) return std::to_string(last);
    return fmt::format("{}-{}", last / 2 + 1, last);
}

double coveredArea(const InspectedTexture& t) {
    return std::accumulate(t.area.begin(), t.area.end(), 0.0);
}

std::string levelsText(const InspectedTexture& t) {
    if (t.levels.empty()) return "";
    const unsigned lo = t.levels.begin()->first;
    const unsigned hi = t.levels.rbegin()->first;
    return lo == hi ? std::to_string(lo) : fmt::format("{}-{}", lo, hi);
}

}  // namespace

report::BarChart levelChart(const std::vector<InspectedTexture>& textures) {
    std::vector<Counts> counts;
    for (const auto& t : textures) counts.emplace_back(t.levels.begin(), t.levels.end());
    report::BarChart chart;
    chart.title = "Micromaps by subdivision level";
    chart.x = {"level"};
    chart.y = {"micromaps"};
    const auto bins = binsOf(counts);
    for (const unsigned bin : bins) chart.categories.push_back(std::to_string(bin));
    chart.series = seriesOf(textures, counts, bins);
    chart.y.log = needsLog(chart);
    return chart;
}

report::BarChart sharingChart(const std::vector<InspectedTexture>& textures) {
    std::vector<Counts> counts(textures.size());
    for (size_t i = 0; i < textures.size(); ++i) {
        for (const auto& [triangles, micromaps] : textures[i].sharing)
            counts[i][powerBin(triangles)] += static_cast<double>(micromaps);
    }
    report::BarChart chart;
    chart.title = "Micromaps by how many share them";
    chart.x = {"triangles"};
    chart.y = {"micromaps"};
    const auto bins = binsOf(counts);
    for (const unsigned bin : bins) chart.categories.push_back(powerBinName(bin));
    chart.series = seriesOf(textures, counts, bins);
    chart.y.log = needsLog(chart);
    return chart;
}

report::BarChart overlapChart(const std::vector<InspectedTexture>& textures) {
    std::vector<Counts> counts(textures.size());
    for (size_t i = 0; i < textures.size(); ++i) {
        const double texels = static_cast<double>(textures[i].width) * textures[i].height;
        for (const auto& [triangles, share] : textures[i].overlaps)
            counts[i][triangles == 0 ? 0 : 1 + powerBin(triangles)] += share * texels;
    }
    report::BarChart chart;
    chart.title = "Texels by triangles over them";
    chart.x = {"distinct triangles"};
    chart.y = {"texels"};
    const auto bins = binsOf(counts);
    for (const unsigned bin : bins) chart.categories.push_back(bin == 0 ? "none" : powerBinName(bin - 1));
    chart.series = seriesOf(textures, counts, bins);
    chart.y.log = needsLog(chart);
    return chart;
}

report::BarChart stateChart(const std::vector<InspectedTexture>& textures) {
    std::vector<const InspectedTexture*> shown;
    for (const auto& t : textures) shown.push_back(&t);
    std::stable_sort(shown.begin(), shown.end(),
                     [](const auto* a, const auto* b) { return coveredArea(*a) > coveredArea(*b); });
    if (shown.size() > mostCategories) shown.resize(mostCategories);
    report::BarChart chart;
    chart.title = "Texture area by state";
    chart.x = {"texture"};
    chart.y = {"share of area"};
    chart.y.share = true;
    chart.stacked = true;
    for (const auto* t : shown) chart.categories.push_back(t->name);
    for (size_t s = 0; s < 4; ++s) {
        const auto state = static_cast<micromap::State>(s);
        report::BarChart::Series series{stateName(state), {}, stateColour(state)};
        for (const auto* t : shown) series.values.push_back(t->areaShares()[s]);
        chart.series.push_back(std::move(series));
    }
    return chart;
}

report::Table textureTable(const std::vector<InspectedTexture>& textures) {
    using report::Show;
    report::Table table;
    table.caption = "Every masked texture and the micromaps over it";
    table.columns = {{"texture", "Texture", "", Show::plain, 0},
                     {"width", "Width", "texels", Show::plain, 0},
                     {"height", "Height", "texels", Show::plain, 0},
                     {"triangles", "Triangles", "", Show::plain, 0},
                     {"micromaps", "Micromaps", "", Show::plain, 0},
                     {"special", "Special indices", "", Show::plain, 0},
                     {"levels", "Levels", "", Show::plain, 0},
                     {"bytes", "Data and records", "", Show::bytes, 0},
                     {"micro_triangles", "Micro-triangles", "", Show::plain, 0},
                     {"known_area", "Known area", "", Show::share, 2},
                     {"most_overlaps", "Most triangles over a texel", "distinct", Show::plain, 0}};
    for (const auto& t : textures) {
        const auto shares = t.areaShares();
        const auto sum = [](const auto& list) {
            return static_cast<int64_t>(std::accumulate(list.begin(), list.end(), uint64_t{0}));
        };
        table.rows.push_back({t.name, int64_t{t.width}, int64_t{t.height}, static_cast<int64_t>(t.triangles),
                              static_cast<int64_t>(t.micromaps), sum(t.special), levelsText(t),
                              static_cast<int64_t>(t.bytes), sum(t.states), shares[0] + shares[1],
                              t.overlaps.empty() ? int64_t{0} : int64_t{t.overlaps.rbegin()->first}});
    }
    return table;
}

report::Table stateTable(const std::vector<InspectedTexture>& textures) {
    using report::Show;
    report::Table table;
    table.caption = "What the states take: area, micro-triangles, and whole triangles (special indices)";
    table.columns = {{"texture", "Texture", "", Show::plain, 0}};
    for (const char* what : {"area", "micro_triangles", "special"}) {
        for (size_t s = 0; s < 4; ++s) {
            const std::string state = stateName(static_cast<micromap::State>(s));
            const bool area = std::string_view(what) == "area";
            const std::string name =
                area ? state : state + (std::string_view(what) == "special" ? ", whole" : ", micro");
            table.columns.push_back(
                {fmt::format("{}_{}", what, state), name, "", area ? Show::share : Show::plain, 2});
        }
    }
    for (const auto& t : textures) {
        std::vector<report::Cell> row{t.name};
        for (const double share : t.areaShares()) row.emplace_back(share);
        for (const uint64_t count : t.states) row.emplace_back(static_cast<int64_t>(count));
        for (const uint64_t count : t.special) row.emplace_back(static_cast<int64_t>(count));
        table.rows.push_back(std::move(row));
    }
    return table;
}

}  // namespace filigree::jobs
