#include "levels_option.h"

#include <algorithm>

namespace filigree::app {
namespace {

constexpr unsigned highest = 12;

unsigned levelOf(const std::string& text, const std::string& all) {
    unsigned level = 0;
    if (!CLI::detail::lexical_cast(text, level) || level > highest)
        throw CLI::ConversionError(all, "--levels");
    return level;
}

// Marks the levels of "4" or "1-10".
void mark(const std::string& range, const std::string& all, std::vector<bool>& wanted) {
    const size_t dash = range.find('-');
    const unsigned first = levelOf(range.substr(0, dash), all);
    const unsigned last = dash == std::string::npos ? first : levelOf(range.substr(dash + 1), all);
    if (first > last) throw CLI::ConversionError(all, "--levels");
    std::fill(wanted.begin() + first, wanted.begin() + last + 1, true);
}

}  // namespace

void addLevelsOption(CLI::App& verb, std::vector<unsigned>& levels, const std::string& usual) {
    const auto parse = [&levels](const std::string& text) {
        if (text.ends_with(',')) throw CLI::ConversionError(text, "--levels");
        std::vector<bool> wanted(highest + 1);
        for (const std::string& range : CLI::detail::split(text, ',')) mark(range, text, wanted);
        levels.clear();
        for (unsigned level = 0; level < wanted.size(); ++level) {
            if (wanted[level]) levels.push_back(level);
        }
    };
    verb.add_option_function<std::string>("--levels", parse, "Subdivision levels; default " + usual)
        ->type_name("1-10|4,6,8");
}

void addMethodsOption(CLI::App& verb, std::vector<std::string>& methods, const std::string& usual) {
    const auto parse = [&methods](const std::string& text) { methods = CLI::detail::split(text, ','); };
    verb.add_option_function<std::string>("--methods", parse,
                                          "Encodings, with commas between them; default " + usual)
        ->type_name("NAMES");
}

void addBothStates(CLI::App& verb, std::vector<unsigned>& states) {
    const auto parse = [&states](const std::string& text) {
        if (text != "2" && text != "4" && text != "both") throw CLI::ConversionError(text, "--states");
        if (text == "both") {
            states = {2, 4};
        } else {
            states = {text == "2" ? 2U : 4U};
        }
    };
    verb.add_option_function<std::string>("--states", parse, "States of a micro-triangle; default both")
        ->type_name("2|4|both");
}

}  // namespace filigree::app
