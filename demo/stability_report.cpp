// SPDX-License-Identifier: MIT
#include "demo/stability_report.h"

#include <sstream>
#include <string>
#include <vector>

#include "records/whole_file.h"

namespace demo {
namespace {

/// Of a row of a Markdown table, without the blanks around them.
std::vector<std::string> markdownCells(const std::string& line) {
    std::vector<std::string> cells;
    std::size_t begin = 1;
    for (std::size_t end; (end = line.find('|', begin)) != std::string::npos; begin = end + 1) {
        const std::string cell = line.substr(begin, end - begin);
        const std::size_t first = cell.find_first_not_of(' ');
        cells.push_back(first == std::string::npos
                            ? ""
                            : cell.substr(first, cell.find_last_not_of(' ') - first + 1));
    }
    return cells;
}

}  // namespace

void addStability(records::HtmlPage& page, const std::optional<std::filesystem::path>& markdown) {
    page.heading("Numerical stability");
    if (!markdown) {
        page.paragraph(
            "Not here: --stability takes the table that technique_errors prints, "
            "docs/results/technique-errors.md.");
        return;
    }
    std::string text = records::readWholeFile(*markdown);
    std::erase(text, '`');
    std::string paragraph;
    std::vector<std::string> head;
    std::vector<std::vector<std::string>> rows;
    const auto flush = [&] {
        if (!paragraph.empty()) page.paragraph(paragraph);
        if (!head.empty()) page.table(head, rows, "");
        paragraph.clear();
        head.clear();
        rows.clear();
    };
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line.starts_with("#")) {
            flush();
        } else if (!line.starts_with("|")) {
            paragraph += (paragraph.empty() ? "" : " ") + line;
        } else if (head.empty()) {
            head = markdownCells(line);
        } else if (!line.starts_with("|---")) {
            rows.push_back(markdownCells(line));
            rows.back().resize(head.size());
        }
    }
    flush();
}

}  // namespace demo
