#include "bake_options.h"

#include "filigree/report/number.h"

#include "text_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include <fmt/format.h>

namespace filigree::app {
namespace {

unsigned parseUnsigned(const std::string& name, const std::string& text) {
    unsigned value = 0;
    if (!CLI::detail::lexical_cast(text, value)) throw CLI::ConversionError(text, name);
    return value;
}

void addStatesAndLevels(CLI::App& verb, jobs::BakeParameters& p) {
    verb.add_option("--states", p.states, "States of a micro-triangle; default 4")->type_name("2|4");
    const auto setLevel = [&p](const std::string& text) {
        if (text != "auto") p.level = parseUnsigned("--level", text);
    };
    verb.add_option_function<std::string>(
            "--level", setLevel,
            "Subdivision level, or auto (the default): the highest useful one per triangle")
        ->type_name("0..12|auto");
    verb.add_option("--max-level", p.maxLevel, "With auto, the highest level; default 8")->type_name("0..12");
}

void addBudget(CLI::App& verb, jobs::BakeParameters& p) {
    const auto setBudget = [&p](const std::string& text) { p.budget = parseBytes("--budget", text); };
    verb.add_option_function<std::string>("--budget", setBudget,
                                          "Choose levels so that data and records fit; K, M, G are 1024s")
        ->type_name("BYTES");
}

void addTest(CLI::App& verb, jobs::BakeParameters& p) {
    const auto setMips = [&p](const std::string& text) {
        p.mips = text == "all" ? jobs::allMips : parseUnsigned("--mips", text);
    };
    verb.add_option_function<std::string>("--mips", setMips,
                                          "Known states also hold at so many coarser mip levels; default 0")
        ->type_name("N|all");
    verb.add_option("--guard", p.guard,
                    "Widen each micro-triangle by this before it is decided; default 1/256")
        ->type_name("TEXELS");
    verb.add_option("--cutoff", p.cutoff, "Alpha cutoff, instead of each material's own")->type_name("0..1");
    verb.add_flag("--include-blend", p.includeBlend,
                  "Bake BLEND materials too: O where alpha is 1, T where it is 0");
}

void checkWhenParsed(CLI::App& verb, const jobs::BakeParameters& p) {
    verb.parse_complete_callback([&p] {
        if (const Status checked = jobs::check(p); !checked)
            throw CLI::ValidationError(checked.error().message);
    });
}

}  // namespace

uint64_t parseBytes(const std::string& name, const std::string& text) {
    uint64_t count = 0;
    const char* const end = text.data() + text.size();
    const auto [unit, error] = std::from_chars(text.data(), end, count);
    static constexpr std::array<std::string_view, 4> units{"", "K", "M", "G"};
    const auto found = std::find(units.begin(), units.end(), std::string_view(unit, end));
    const auto shift = static_cast<unsigned>(10 * (found - units.begin()));
    if (error != std::errc{} || found == units.end() || count > (UINT64_MAX >> shift)) {
        throw CLI::ConversionError(text, name);
    }
    return count << shift;
}

void addBakeOptions(CLI::App& verb, jobs::BakeParameters& p) {
    addStatesAndLevels(verb, p);
    addBudget(verb, p);
    addTest(verb, p);
    verb.add_flag("--rotate", p.rotate, "Rotate triangles' indices where they then share a micromap");
    checkWhenParsed(verb, p);
}

void addMapOptions(CLI::App& verb, jobs::BakeParameters& p) {
    addStatesAndLevels(verb, p);
    addTest(verb, p);
    checkWhenParsed(verb, p);
}

bool hasMapOptions(const CLI::App& verb) {
    static constexpr std::array names{"--states", "--level",  "--max-level",    "--mips",
                                      "--guard",  "--cutoff", "--include-blend"};
    return std::ranges::any_of(names, [&](const char* name) { return verb.count(name) > 0; });
}

void addTestOptions(CLI::App& verb, jobs::BakeParameters& p) {
    addTest(verb, p);
    checkWhenParsed(verb, p);
}

void printSummary(const jobs::BakeSummary& s) {
    using report::formatBytes;
    using report::formatCount;
    const auto bytes = [](uint64_t count) { return formatBytes(static_cast<double>(count)); };
    std::string levels;
    for (size_t level = 0; level < s.levels.size(); ++level) {
        if (s.levels[level] > 0)
            levels +=
                fmt::format("{}{}: {}", levels.empty() ? "" : ", ", level, formatCount(s.levels[level]));
    }
    std::vector<std::pair<std::string, std::string>> lines{
        {"triangles",
         fmt::format("{}, of which masked {}", formatCount(s.triangles), formatCount(s.maskedTriangles))},
        {"micromaps", formatCount(s.micromaps)},
        {"by level", levels},
        {"special indices",
         fmt::format("T {}, O {}, UT {}, UO {}", formatCount(s.special[0]), formatCount(s.special[1]),
                     formatCount(s.special[2]), formatCount(s.special[3]))},
        {"known", fmt::format("{} of {} micro-triangles", report::formatShare(s.knownShare()),
                              formatCount(s.microTriangles))},
        {"bytes", fmt::format("data {}, records {}, indices {}", bytes(s.dataBytes), bytes(s.recordBytes),
                              bytes(s.indexBytes))},
        {"seconds", fmt::format("read {:.2f}, bake {:.2f}, write {:.2f}, in all {:.2f}", s.readSeconds,
                                s.bakeSeconds, s.writeSeconds, s.totalSeconds)},
    };
    if (s.budgetCost && s.budgetBound && *s.budgetBound > 0) {
        lines.insert(lines.end() - 1,
                     {"budget", fmt::format("{:.2f} % above the bound on expected any-hit calls",
                                            (*s.budgetCost / *s.budgetBound - 1) * 100)});
    }
    printPairs(lines);
}

}  // namespace filigree::app
