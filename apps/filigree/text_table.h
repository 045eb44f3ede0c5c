// Aligned text on stdout.
#pragma once

#include "filigree/report/table.h"

#include <string>
#include <utility>
#include <vector>

namespace filigree::app {

// One line each: the name, and the value in a column of its own.
void printPairs(const std::vector<std::pair<std::string, std::string>>& pairs);

// Headings and rows, numbers to the right, as the report shows them.
void printTable(const report::Table& table);

}  // namespace filigree::app
