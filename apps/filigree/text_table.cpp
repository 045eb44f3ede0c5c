#include "text_table.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

namespace filigree::app {
namespace {

// Lines of equally many cells; the first column to the left, the others to the right.
void printAligned(const std::vector<std::vector<std::string>>& lines) {
    std::vector<size_t> widths;
    for (const auto& line : lines) {
        widths.resize(std::max(widths.size(), line.size()));
        for (size_t c = 0; c < line.size(); ++c) widths[c] = std::max(widths[c], line[c].size());
    }
    for (const auto& line : lines) {
        fmt::print("{:<{}}", line[0], widths[0]);
        for (size_t c = 1; c < line.size(); ++c) fmt::print("  {:>{}}", line[c], widths[c]);
        fmt::print("\n");
    }
}

}  // namespace

void printPairs(const std::vector<std::pair<std::string, std::string>>& pairs) {
    size_t width = 0;
    for (const auto& pair : pairs) width = std::max(width, pair.first.size());
    for (const auto& [name, value] : pairs) fmt::print("{:<{}}  {}\n", name, width, value);
}

void printTable(const report::Table& table) {
    std::vector<std::vector<std::string>> lines(1);
    for (const auto& column : table.columns) {
        lines[0].push_back(column.unit.empty() ? column.name : column.name + " (" + column.unit + ")");
    }
    for (const auto& row : table.rows) {
        auto& line = lines.emplace_back();
        for (size_t c = 0; c < row.size(); ++c) line.push_back(report::cellText(row[c], table.columns[c]));
    }
    printAligned(lines);
}

}  // namespace filigree::app
