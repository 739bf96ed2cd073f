// SPDX-License-Identifier: MIT
#include "analysis/text_table.h"

#include <algorithm>
#include <cstddef>

namespace analysis {
namespace {

using Row = std::vector<std::string>;

}  // namespace

std::string tsvText(const TextTable& table) {
    std::string text;
    const auto add = [&](const Row& row) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            if (i > 0) text += '\t';
            text += row[i];
        }
        text += '\n';
    };
    add(table.head);
    for (const Row& row : table.rows) add(row);
    return text;
}

std::string alignedText(const TextTable& table) {
    std::vector<std::size_t> width(table.head.size(), 0);
    const auto widen = [&](const Row& row) {
        for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
    };
    widen(table.head);
    for (const Row& row : table.rows) widen(row);
    std::string text;
    const auto add = [&](const Row& row) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i) {
            line += row[i];
            if (i + 1 < row.size()) line.append(width[i] + 2 - row[i].size(), ' ');
        }
        text += line + '\n';
    };
    add(table.head);
    for (const Row& row : table.rows) add(row);
    return text;
}

}  // namespace analysis
