#include "jobs/command_words.h"

#include <fmt/format.h>

namespace filigree::jobs {
namespace {

void addWords(std::vector<std::string>& words, const char* option, const std::string& value) {
    words.insert(words.end(), {option, value});
}

}  // namespace

std::vector<std::string> testWords(const BakeParameters& p) {
    const BakeParameters usual;
    std::vector<std::string> words;
    if (p.mips != usual.mips) addWords(words, "--mips", p.mips == allMips ? "all" : std::to_string(p.mips));
    if (p.guard != usual.guard) addWords(words, "--guard", fmt::format("{}", p.guard));
    if (p.cutoff) addWords(words, "--cutoff", fmt::format("{}", *p.cutoff));
    if (p.includeBlend) words.emplace_back("--include-blend");
    return words;
}

std::vector<std::string> bakeWords(const BakeParameters& p) {
    const BakeParameters usual;
    std::vector<std::string> words;
    if (p.states != usual.states) addWords(words, "--states", std::to_string(p.states));
    if (p.level) addWords(words, "--level", std::to_string(*p.level));
    if (p.maxLevel != usual.maxLevel) addWords(words, "--max-level", std::to_string(p.maxLevel));
    if (p.budget) addWords(words, "--budget", std::to_string(*p.budget));
    const std::vector<std::string> test = testWords(p);
    words.insert(words.end(), test.begin(), test.end());
    if (p.rotate) words.emplace_back("--rotate");
    return words;
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
