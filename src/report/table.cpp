#include "filigree/report/table.h"

#include "filigree/report/number.h"

#include "report/text.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>

#include <fmt/format.h>

namespace filigree::report {

namespace {

template <class... Cases>
struct Overloaded : Cases... {
    using Cases::operator()...;
};

bool isNumber(const Cell& cell) {
    return std::holds_alternative<int64_t>(cell) || std::holds_alternative<double>(cell);
}

nlohmann::ordered_json jsonOf(const Cell& cell) {
    return std::visit(
        Overloaded{[](std::monostate) { return nlohmann::ordered_json(); },
                   [](double value) {
                       return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
                   },
                   [](const std::string& text) { return nlohmann::ordered_json(validUtf8(text)); },
                   [](auto value) { return nlohmann::ordered_json(value); }},
        cell);
}

std::string csvText(const std::string& text) {
    const std::string valid = validUtf8(text);
    if (valid.find_first_of(",\"\r\n") == std::string::npos) return valid;
    std::string out = "\"";
    for (const char c : valid) {
        if (c == '"') out += '"';
        out += c;
    }
    return out + '"';
}

std::string csvOf(const Cell& cell) {
    return std::visit(Overloaded{[](std::monostate) { return std::string(); },
                                 [](bool value) { return std::string(value ? "true" : "false"); },
                                 [](int64_t value) { return std::to_string(value); },
                                 [](double value) {
                                     return std::isfinite(value) ? fmt::format("{}", value) : std::string();
                                 },
                                 [](const std::string& text) { return csvText(text); }},
                      cell);
}

std::string withUnit(const std::string& name, const std::string& unit) {
    return unit.empty() ? name : fmt::format("{} ({})", name, unit);
}

std::string countText(int64_t value) {
    return value < 0 ? "-" + formatCount(uint64_t{0} - static_cast<uint64_t>(value))
                     : formatCount(static_cast<uint64_t>(value));
}

std::string numberText(double value, const Column& column) {
    switch (column.show) {
        case Show::bytes:
            return formatBytes(value);
        case Show::share:
            return formatShare(value);
        case Show::compact:
            return formatCompact(value);
        default:
            return formatNumber(value, column.decimals);
    }
}

// How each column's cells begin. Columns with numbers stand to the right, headings and all.
std::vector<std::string> classes(const Table& table) {
    std::vector<std::string> out;
    for (size_t c = 0; c < table.columns.size(); ++c) {
        const bool numeric = std::any_of(table.rows.begin(), table.rows.end(),
                                         [&](const auto& row) { return isNumber(row[c]); });
        out.emplace_back(numeric ? " class=\"n\"" : "");
    }
    return out;
}

// A record without its line end.
std::string csvHeading(const Table& table) {
    std::string out;
    for (size_t c = 0; c < table.columns.size(); ++c) {
        if (c > 0) out += ',';
        out += csvText(withUnit(table.columns[c].key, table.columns[c].unit));
    }
    return out;
}

std::string csvRow(const std::vector<Cell>& row) {
    std::string out;
    for (size_t c = 0; c < row.size(); ++c) {
        if (c > 0) out += ',';
        out += csvOf(row[c]);
    }
    return out;
}

std::string headHtml(const Table& table, const std::vector<std::string>& classes) {
    std::string out = fmt::format("<thead><tr data-csv=\"{}\">", escapeHtml(csvHeading(table)));
    for (size_t c = 0; c < table.columns.size(); ++c) {
        const Column& column = table.columns[c];
        out += fmt::format("<th scope=\"col\"{}>{}</th>", classes[c],
                           escapeHtml(withUnit(column.name, column.unit)));
    }
    return out + "</tr></thead>\n";
}

std::string bodyHtml(const Table& table, const std::vector<std::string>& classes) {
    std::string out = "<tbody>\n";
    for (const auto& row : table.rows) {
        out += fmt::format("<tr data-csv=\"{}\">", escapeHtml(csvRow(row)));
        for (size_t c = 0; c < row.size(); ++c) {
            out += fmt::format("<td{}>{}</td>", classes[c], escapeHtml(cellText(row[c], table.columns[c])));
        }
        out += "</tr>\n";
    }
    return out + "</tbody>";
}

}  // namespace

std::string cellText(const Cell& cell, const Column& column) {
    return std::visit(Overloaded{[](std::monostate) { return std::string(); },
                                 [](bool value) { return std::string(value ? "yes" : "no"); },
                                 [&](int64_t value) {
                                     return column.show == Show::plain
                                                ? countText(value)
                                                : numberText(static_cast<double>(value), column);
                                 },
                                 [&](double value) { return numberText(value, column); },
                                 [](const std::string& text) { return text; }},
                      cell);
}

std::string toJson(const Table& table) {
    auto rows = nlohmann::ordered_json::array();
    for (const auto& row : table.rows) {
        assert(row.size() == table.columns.size());
        auto object = nlohmann::ordered_json::object();
        for (size_t c = 0; c < row.size(); ++c) object[validUtf8(table.columns[c].key)] = jsonOf(row[c]);
        rows.push_back(std::move(object));
    }
    return rows.dump(1) + "\n";
}

std::string toCsv(const Table& table) {
    std::string out = csvHeading(table) + "\r\n";
    for (const auto& row : table.rows) {
        assert(row.size() == table.columns.size());
        out += csvRow(row) + "\r\n";
    }
    return out;
}

std::string toHtml(const Table& table) {
    const std::string command =
        table.command.empty() ? "" : fmt::format("<code>{}</code>", escapeHtml(table.command));
    const std::vector<std::string> columns = classes(table);
    return fmt::format(
        "<figure class=\"table\"><figcaption><span>{}</span>"
        "<button type=\"button\" class=\"copy\" hidden>Copy as CSV</button></figcaption>\n"
        "<div class=\"scroll\"><table>\n{}{}</table></div>{}</figure>\n",
        escapeHtml(table.caption), headHtml(table, columns), bodyHtml(table, columns), command);
}

}  // namespace filigree::report
