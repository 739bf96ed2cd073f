// SPDX-License-Identifier: MIT
// The numbers of an analysis as tables: tab-separated files for other programs, and the same rows
// rounded for the report.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/reference_sizes.h"
#include "analysis/slope_analysis.h"

namespace analysis {

struct TextTable {
    std::string name;     ///< of the file, without .tsv
    std::string caption;  ///< what the numbers are and what they assume
    std::vector<std::string> head;
    std::vector<std::vector<std::string>> rows;
};

/// Full digits, `n/a` for what cannot be had: groups, conditions, thresholds (observer x
/// condition), observers, estimators, beta, audience, screening, and with_everyone where screening
/// left somebody out.
std::vector<TextTable> fileTables(const SlopeAnalysis& analysis, const ReferenceSizes& reference);
/// For people, without the empty ones: groups, conditions, estimators, beta, audience, screening,
/// and what the numbers are with everyone.
std::vector<TextTable> reportTables(const SlopeAnalysis& analysis, const ReferenceSizes& reference);

std::string tsvText(const TextTable& table);
/// Aligned columns for a terminal.
std::string alignedText(const TextTable& table);

}  // namespace analysis
