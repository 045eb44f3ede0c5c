#include "jobs/vq_report.h"

#include "filigree/core/file.h"
#include "filigree/report/page.h"

#include "jobs/json_text.h"
#include "jobs/vq_encoders.h"

#include <algorithm>
#include <numeric>
#include <span>

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

// Whether this version has what the measure asks for.
bool isMeasured(VqMeasure measure) {
    if (indexOf(measure) < vqFirstEncoder) return true;
    return std::ranges::any_of(vqEncoders(), [&](const VqEncoder& e) { return e.measure == measure; });
}

std::vector<VqMeasure> measures() {
    std::vector<VqMeasure> list;
    for (size_t k = 0; k < vqMeasureCount; ++k) {
        if (isMeasured(static_cast<VqMeasure>(k))) list.push_back(static_cast<VqMeasure>(k));
    }
    return list;
}

const VqEncoder* encoderOf(VqMeasure measure) {
    const auto found =
        std::ranges::find_if(vqEncoders(), [&](const VqEncoder& e) { return e.measure == measure; });
    return found == vqEncoders().end() ? nullptr : &*found;
}

double mapsPerSecond(const VqTotals& totals, VqMeasure measure) {
    const double seconds = totals.seconds[indexOf(measure)];
    return seconds > 0 ? static_cast<double>(totals.maps) / seconds : 0;
}

// Textures from the least savings of `by` to the greatest.
std::vector<const VqTexture*> sorted(const VqSummary& summary, VqMeasure by) {
    std::vector<const VqTexture*> order;
    for (const VqTexture& texture : summary.textures) order.push_back(&texture);
    std::ranges::stable_sort(order, [&](const VqTexture* a, const VqTexture* b) {
        return a->totals.mean(by) < b->totals.mean(by);
    });
    return order;
}

NamedChart chartOf(const VqSummary& summary, const std::string& file, const std::string& title, VqMeasure by,
                   std::span<const VqMeasure> shown) {
    NamedChart named{file, {}};
    named.chart.title = title;
    named.chart.x = {fmt::format("textures, by what {} saves", nameOf(by))};
    named.chart.y = {"alpha tests saved"};
    named.chart.y.share = true;
    const auto order = sorted(summary, by);
    for (const VqMeasure measure : shown) {
        if (!isMeasured(measure)) continue;
        const size_t k = named.chart.series.size();
        report::LineChart::Series series{nameOf(measure), {}, report::seriesColour(k)};
        for (size_t t = 0; t < order.size(); ++t)
            series.points.emplace_back(static_cast<double>(t + 1), order[t]->totals.mean(measure));
        named.chart.series.push_back(std::move(series));
    }
    return named;
}

// Puts `value` at "a/b" into `json`.
void put(Json& json, const std::string& path, Json value) {
    const size_t slash = path.find('/');
    if (slash == std::string::npos) {
        json[path] = std::move(value);
    } else {
        json[path.substr(0, slash)][path.substr(slash + 1)] = std::move(value);
    }
}

Json savingsJson(const VqTotals& totals) {
    Json json = Json::object();
    for (const VqMeasure measure : measures()) put(json, pathOf(measure), totals.mean(measure));
    return json;
}

// Of each encoder, value(measure).
template <class Value>
Json encoderJson(Value value) {
    Json json = Json::object();
    for (const VqEncoder& e : vqEncoders()) put(json, pathOf(e.measure), value(e.measure));
    return json;
}

Json substitutionsJson(const VqTotals& totals) {
    return encoderJson([&](VqMeasure measure) { return totals.substitutions[indexOf(measure)]; });
}

Json useJson(const TransformUse& use) {
    return {{"used", use.used}, {"unique", use.unique}, {"most_frequent_share", use.mostFrequentShare()}};
}

report::Section chartSection(const std::vector<NamedChart>& charts) {
    report::Section section{"Savings, texture by texture", {}};
    for (const NamedChart& named : charts)
        section.blocks.emplace_back(report::Figure{report::layOut(named.chart), named.chart.title, {}});
    return section;
}

report::Section pictureSection(const std::vector<std::string>& pictures) {
    report::Links links;
    for (const std::string& file : pictures) links.links.push_back({file, file});
    return {"What each encoding makes of a map",
            {report::Paragraph{
                 "Known regions are blue, mixed ones orange; what an encoder had to give up is yellow."},
             links}};
}

report::Page pageOf(const VqSummary& summary, const std::vector<NamedChart>& charts,
                    const std::vector<std::string>& pictures) {
    report::Page page;
    page.title = "Opacity squares";
    page.lead = fmt::format("{} textures, {} maps.", summary.textures.size(), summary.totals.maps);
    page.sections.push_back({"In the mean", {vqTable(summary)}});
    page.sections.push_back(chartSection(charts));
    page.sections.push_back({"Textures", {vqTextureTable(summary)}});
    if (!pictures.empty()) page.sections.push_back(pictureSection(pictures));
    return page;
}

}  // namespace

std::vector<NamedChart> vqCharts(const VqSummary& summary) {
    using enum VqMeasure;
    static constexpr std::array vq2{source16, vq2Plus, vq2Best, vq2Sensible, masks};
    static constexpr std::array sources{source64, source32, source16, source8};
    static constexpr std::array vq4{source32, vq4Plus, vq4Best, vq4Paper, raw16};
    return {chartOf(summary, "savings-vq2.svg", "VQ2: 256 bits a map", source16, vq2),
            chartOf(summary, "savings-source.svg", "Uncompressed maps", source32, sources),
            chartOf(summary, "savings-vq4.svg", "VQ4: 512 bits a map", source32, vq4)};
}

report::Table vqTable(const VqSummary& summary) {
    using report::Show;
    report::Table table;
    table.caption = fmt::format("Opacity squares of {} maps", summary.totals.maps);
    table.columns = {{"measure", "map"},
                     {"savings", "saved", "", Show::share},
                     {"kept", "of the source's", "", Show::share},
                     {"substitutions", "substitutions"},
                     {"maps_per_second", "maps a second", "", Show::compact}};
    for (const VqMeasure measure : measures()) {
        std::vector<report::Cell> row{std::string(nameOf(measure)), summary.totals.mean(measure)};
        if (const VqEncoder* const encoder = encoderOf(measure)) {
            const double source = summary.totals.mean(encoder->source);
            row.emplace_back(source > 0 ? summary.totals.mean(measure) / source : 1.0);
            row.emplace_back(static_cast<int64_t>(summary.totals.substitutions[indexOf(measure)]));
            row.emplace_back(mapsPerSecond(summary.totals, measure));
        }
        row.resize(table.columns.size());
        table.rows.push_back(std::move(row));
    }
    return table;
}

report::Table vqTextureTable(const VqSummary& summary) {
    report::Table table;
    table.caption = "Savings of every texture";
    table.columns = {{"texture", "texture"}, {"maps", "maps"}, {"pairs", "pairs"}, {"singles", "singles"}};
    for (const VqMeasure measure : measures())
        table.columns.push_back({pathOf(measure), nameOf(measure), "", report::Show::share});
    for (const VqTexture& texture : summary.textures) {
        std::vector<report::Cell> row{texture.name, static_cast<int64_t>(texture.totals.maps),
                                      static_cast<int64_t>(texture.pairs),
                                      static_cast<int64_t>(texture.singles)};
        for (const VqMeasure measure : measures()) row.emplace_back(texture.totals.mean(measure));
        table.rows.push_back(std::move(row));
    }
    return table;
}

Status writeVqReport(const VqOptions& options, const VqSummary& summary,
                     const std::vector<std::string>& pictures) {
    const auto charts = vqCharts(summary);
    for (const NamedChart& named : charts) {
        const std::string svg = report::toSvg(report::layOut(named.chart));
        if (auto written = writeFile(options.outputFolder / named.file, svg); !written) return written;
    }
    const std::string csv = report::toCsv(vqTextureTable(summary));
    if (auto written = writeFile(options.outputFolder / "vq.csv", csv); !written) return written;
    return writeFile(options.outputFolder / "index.html", report::toHtml(pageOf(summary, charts, pictures)));
}

std::string toJson(const VqSummary& s) {
    Json textures = Json::array();
    for (const VqTexture& texture : s.textures) {
        Json json{{"name", texture.name}};
        json.update(savingsJson(texture.totals));
        json["substitutions"] = substitutionsJson(texture.totals);
        json["maps"] = texture.totals.maps;
        json["pairs"] = texture.pairs;
        json["singles"] = texture.singles;
        textures.push_back(std::move(json));
    }
    return dump({{"textures", textures},
                 {"mean", savingsJson(s.totals)},
                 {"substitutions", substitutionsJson(s.totals)},
                 {"maps_per_second",
                  encoderJson([&](VqMeasure measure) { return mapsPerSecond(s.totals, measure); })},
                 {"transforms", {{"vq2", useJson(s.vq2)}, {"vq4", useJson(s.vq4)}}},
                 {"maps", s.totals.maps},
                 {"seconds", s.seconds}});
}

}  // namespace filigree::jobs
