// SPDX-License-Identifier: MIT
// What an analysis means in words and as a slope file.
#pragma once

#include <string>
#include <vector>

#include "analysis/slope_analysis.h"
#include "records/slope_file.h"

namespace analysis {

/// slope.json.
records::Slope slopeRecord(const SlopeAnalysis& analysis, const records::RunContext& context);

/// Plain sentences on what the results mean for the user of c: the law, the groups, the observers,
/// the contrast, screening, and what cannot be had. Each with its numbers.
std::vector<std::string> findings(const SlopeAnalysis& analysis);

/// One paragraph on what was done: data, screening, model, estimator, intervals.
std::string methodParagraph(const SlopeAnalysis& analysis);

}  // namespace analysis
