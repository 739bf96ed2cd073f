// SPDX-License-Identifier: MIT
// A table of words and numbers, as a file for other programs and as columns for a terminal.
#pragma once

#include <string>
#include <vector>

namespace analysis {

struct TextTable {
    std::string name;     ///< of the file, without .tsv
    std::string caption;  ///< what the numbers are and what they assume
    std::vector<std::string> head;
    std::vector<std::vector<std::string>> rows;
};

/// Tab-separated, the head first.
std::string tsvText(const TextTable& table);
/// Aligned columns for a terminal.
std::string alignedText(const TextTable& table);

}  // namespace analysis
