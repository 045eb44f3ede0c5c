// The options that say how to bake, for every verb that does.
#pragma once

#include "filigree/jobs/bake.h"

#include <CLI/CLI.hpp>

namespace filigree::app {

// Adds them to `verb`; they fill `parameters`, which must outlive the parsing. Values out of range are wrong
// usage.
void addBakeOptions(CLI::App& verb, jobs::BakeParameters& parameters);

// The same without a budget and rotation, which encodings of micromaps do not take.
void addMapOptions(CLI::App& verb, jobs::BakeParameters& parameters);

// "4096", "64K", "10M", "1G" as the value of option `name`; anything else is wrong usage.
uint64_t parseBytes(const std::string& name, const std::string& text);

// True when any of them was given.
bool hasMapOptions(const CLI::App& verb);

// Only those that say when a state is known.
void addTestOptions(CLI::App& verb, jobs::BakeParameters& parameters);

// Prints a bake's result as a table on stdout.
void printSummary(const jobs::BakeSummary& summary);

}  // namespace filigree::app
