// Tables of typed cells, to JSON, CSV and HTML.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace filigree::report {

// Nothing, a truth, a whole number, a number or a text. Texts are UTF-8; bytes that are not show as U+FFFD.
using Cell = std::variant<std::monostate, bool, int64_t, double, std::string>;

// How HTML shows a column's numbers. JSON and CSV always hold the number itself.
enum class Show : uint8_t {
    plain,    // whole numbers grouped by thousands, others with Column::decimals
    bytes,    // "1.50 KiB"
    share,    // a share of one, "97.31 %"
    compact,  // "12.5k"
};

struct Column {
    std::string key;     // in JSON and CSV; unique in its table
    std::string name;    // heading for people
    std::string unit{};  // "bytes", "texels"; empty for none
    Show show = Show::plain;
    int decimals = 2;
};

struct Table {
    std::string caption;
    std::string command;  // that makes it again; empty for none
    std::vector<Column> columns;
    std::vector<std::vector<Cell>> rows;  // each as long as `columns`
};

// An array of objects, one a row, keys in column order, numbers unrounded; empty and non-finite cells are
// null.
std::string toJson(const Table& table);

// RFC 4180: a heading row of "key (unit)", then the rows, CRLF after each. Empty and non-finite cells are
// empty; texts are quoted where they must be.
std::string toCsv(const Table& table);

// A <figure> with the table and its caption; each row carries its CSV, for the page to sort and to copy by.
std::string toHtml(const Table& table);

// What HTML shows in one cell, unescaped.
std::string cellText(const Cell& cell, const Column& column);

}  // namespace filigree::report
