#include "jobs/vq_report.h"

#include "filigree/core/file.h"
#include "filigree/report/number.h"

#include "jobs/command_words.h"
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

constexpr size_t mostPictureBytes = 8'000'000;  // of the page

std::string commandOf(const VqOptions& options) {
    constexpr size_t mostInputs = 4;  // more would fill the page
    std::vector<std::string> words{"filigree", "vq"};
    for (size_t k = 0; k < std::min(options.inputs.size(), mostInputs); ++k)
        words.push_back(options.inputs[k].string());
    std::string command = shellCommand(words) + (options.inputs.size() > mostInputs ? " ..." : "");
    words = {"-o", options.outputFolder.string()};
    const auto add = [&](const char* option, const std::string& value) {
        words.insert(words.end(), {option, value});
    };
    const VqOptions usual;
    if (options.prefer != 0) add("--prefer", std::string(1, options.prefer));
    if (options.cutoff) add("--cutoff", fmt::format("{}", *options.cutoff));
    if (options.guard != usual.guard) add("--guard", fmt::format("{}", options.guard));
    if (options.limit != usual.limit) add("--limit", std::to_string(options.limit));
    if (options.mapsPerTexture != usual.mapsPerTexture) add("--maps", std::to_string(options.mapsPerTexture));
    return command + ' ' + shellCommand(words);
}

report::Section chartSection(const std::vector<NamedChart>& charts, const std::string& command) {
    static constexpr std::array captions{
        "16 x 16 regions: the map itself, what 256 bits keep of it with VQ2, and two 64-sub-triangle masks "
        "of the same "
        "size (figure 6 of Fenney and Ozkan 2023).",
        "Maps of 8 x 8 to 64 x 64 regions before compression: each step saves less (figure 7).",
        "32 x 32 regions: the map itself, what 512 bits keep of it with VQ4, and a plain 16 x 16 map of the "
        "same size "
        "(figure 10)."};
    report::Section section{"Savings, texture by texture", {}};
    for (size_t k = 0; k < charts.size(); ++k)
        section.blocks.emplace_back(report::chartFigure(charts[k].chart, captions[k], command));
    return section;
}

size_t pageBytes(const report::Gallery::Item& item) {
    size_t bytes = 0;
    for (const auto& tile : item.tiles) bytes += tile.picture.png.size() * 4 / 3 + 200;
    return bytes;
}

report::Section pictureSection(const std::vector<VqPicture>& pictures, const std::string& command) {
    report::Gallery gallery;
    gallery.command = command;
    size_t bytes = 0;
    for (const VqPicture& picture : pictures) {
        bytes += pageBytes(picture.item);
        if (bytes > mostPictureBytes) break;
        gallery.items.push_back(picture.item);
    }
    report::Section section{"What each encoding makes of a map", {panelLegend()}};
    if (gallery.items.size() < pictures.size())
        section.blocks.emplace_back(report::Paragraph{fmt::format(
            "To keep the page small, it shows the first {} of {} textures; all stand beside it as map-*.png.",
            gallery.items.size(), pictures.size())});
    section.blocks.emplace_back(std::move(gallery));
    return section;
}

report::Page pageOf(const VqOptions& options, const VqSummary& summary,
                    const std::vector<VqPicture>& pictures) {
    report::Page page;
    page.title = "Opacity squares";
    page.lead =
        fmt::format("{} textures, {} maps: the share of alpha tests that a map of each kind saves.",
                    report::formatCount(summary.textures.size()), report::formatCount(summary.totals.maps));
    page.sections = vqSections(options, summary, pictures);
    return page;
}

std::string shareText(const VqTexture& texture, VqMeasure measure) {
    return fmt::format("{} {:.1f} %", nameOf(measure), 100 * texture.totals.mean(measure));
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

Result<report::Gallery::Item> galleryItem(const VqTexture& texture, const VqPanels& panels) {
    using enum VqMeasure;
    report::Gallery::Item item{
        texture.name,
        fmt::format("{}, {}; {}, {}", shareText(texture, source16), shareText(texture, vq2Best),
                    shareText(texture, source32), shareText(texture, vq4Best)),
        {}};
    std::vector<const VqPanel*> order{&panels.alpha};
    for (const auto& row : panels.rows) {
        for (const VqPanel& panel : row) order.push_back(&panel);
    }
    for (const VqPanel* panel : order) {
        auto png = panel->picture.png();
        if (!png) return png.error();
        report::Picture picture{std::move(*png), panel->picture.width(), panel->picture.height(),
                                panel->caption, ""};
        picture.pixelated = panel->isSquare;
        item.tiles.push_back({std::move(picture), panel->caption});
    }
    return item;
}

std::vector<report::Section> vqSections(const VqOptions& options, const VqSummary& summary,
                                        const std::vector<VqPicture>& pictures) {
    const std::string command = commandOf(options);
    std::vector<report::Section> sections;
    report::Table mean = vqTable(summary);
    mean.command = command;
    sections.push_back({"In the mean", {std::move(mean)}});
    sections.push_back(chartSection(vqCharts(summary), command));
    if (!pictures.empty()) sections.push_back(pictureSection(pictures, command));
    sections.push_back({"Textures", {vqTextureTable(summary)}});
    return sections;
}

Status writeVqReport(const VqOptions& options, const VqSummary& summary,
                     const std::vector<VqPicture>& pictures) {
    for (const NamedChart& named : vqCharts(summary)) {
        const std::string svg = report::toSvg(report::layOut(named.chart));
        if (auto written = writeFile(options.outputFolder / named.file, svg); !written) return written;
    }
    const std::string csv = report::toCsv(vqTextureTable(summary));
    if (auto written = writeFile(options.outputFolder / "vq.csv", csv); !written) return written;
    return writeFile(options.outputFolder / "index.html", report::toHtml(pageOf(options, summary, pictures)));
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
