// Several levels, states or encodings as one option.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace filigree::app {

// Adds --levels: "1-10", "6" or "4,6,8-10". They go to `levels` rising, each once; those there already are
// the default, which `usual` names.
void addLevelsOption(CLI::App& verb, std::vector<unsigned>& levels, const std::string& usual);

// Adds --methods: names of encodings with commas between them, which the job checks. `usual` names those
// that it takes without.
void addMethodsOption(CLI::App& verb, std::vector<std::string>& methods, const std::string& usual);

// Adds --states: 2, 4 or both.
void addBothStates(CLI::App& verb, std::vector<unsigned>& states);

}  // namespace filigree::app
