// SPDX-License-Identifier: MIT
// The worst errors of every technique and precision on its hard cases, as technique_errors prints
// them in Markdown, on a report's page.
#pragma once

#include <filesystem>
#include <optional>

#include "records/html_page.h"

namespace demo {

/// Its paragraphs and tables, or, where there is no file, how they are had. Throws
/// std::runtime_error where the file cannot be read.
void addStability(records::HtmlPage& page, const std::optional<std::filesystem::path>& markdown);

}  // namespace demo
