// SPDX-License-Identifier: MIT
#include "demo/report_tables.h"

#include <cmath>
#include <cstdio>

#include "demo/tsv_journal.h"
#include "records/whole_file.h"

namespace demo {
namespace {

std::string markdownRow(const std::vector<std::string>& cells) {
    std::string row = "|";
    for (const std::string& cell : cells) {
        row += ' ';
        for (const char letter : cell) row += letter == '|' ? "\\|" : std::string(1, letter);
        row += " |";
    }
    return row + "\n";
}

}  // namespace

std::string formatted(const char* format, double value) {
    if (!std::isfinite(value)) return "n/a";
    char text[48];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

void ReportTables::add(const NamedTable& table) {
    page_.table(table.head, table.rows, table.caption + " (" + table.name + ".tsv)");
    TsvTable file(table.name, table.head);
    file.setContext(context_);
    for (const auto& row : table.rows) file.add(row);
    records::writeWholeFile(folder_ / (table.name + ".tsv"), file.toText());
}

std::string markdownTable(const NamedTable& table) {
    std::string text = markdownRow(table.head) + "|";
    for (std::size_t i = 0; i < table.head.size(); ++i) text += "---|";
    text += "\n";
    for (const auto& row : table.rows) text += markdownRow(row);
    return text;
}

}  // namespace demo
