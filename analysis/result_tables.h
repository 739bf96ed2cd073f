// SPDX-License-Identifier: MIT
// The numbers of an analysis as tables: tab-separated files for other programs, and the same rows
// rounded for the report.
#pragma once

#include <vector>

#include "analysis/reference_sizes.h"
#include "analysis/slope_analysis.h"
#include "analysis/text_table.h"

namespace analysis {

/// Full digits, `n/a` for what cannot be had: groups, conditions, thresholds (observer x
/// condition), observers, estimators, beta, audience, screening, and with_everyone where screening
/// left somebody out.
std::vector<TextTable> fileTables(const SlopeAnalysis& analysis, const ReferenceSizes& reference);
/// For people, without the empty ones: groups, conditions, estimators, beta, audience, screening,
/// and what the numbers are with everyone.
std::vector<TextTable> reportTables(const SlopeAnalysis& analysis, const ReferenceSizes& reference);

}  // namespace analysis
