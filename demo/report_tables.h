// SPDX-License-Identifier: MIT
// Tables that stand in three places: on a report's page, as a TSV file beside it with the context
// of what was measured, and, where a document quotes them, as Markdown.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "records/html_page.h"

namespace demo {

/// By a printf format for one double; n/a for what is not finite.
std::string formatted(const char* format, double value);

using TableRows = std::vector<std::vector<std::string>>;

struct NamedTable {
    std::string name;     ///< of its file, without .tsv
    std::string caption;  ///< on the page
    std::vector<std::string> head;
    TableRows rows;
};

class ReportTables {
  public:
    ReportTables(records::HtmlPage& page, std::filesystem::path folder, std::string context)
        : page_(page), folder_(std::move(folder)), context_(std::move(context)) {}

    /// Throws std::runtime_error where the file cannot be written.
    void add(const NamedTable& table);

  private:
    records::HtmlPage& page_;
    std::filesystem::path folder_;
    std::string context_;
};

/// Ends with a new line. Of the cells only | is escaped.
std::string markdownTable(const NamedTable& table);

}  // namespace demo
