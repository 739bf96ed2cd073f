// SPDX-License-Identifier: MIT
// What an analysis means, in words: for the terminal, the report and slope.json.
#pragma once

#include <string>
#include <vector>

#include "analysis/slope_analysis.h"

namespace analysis {

/// A result in plain sentences, with its numbers and what follows for the user of c.
struct Finding {
    std::string topic;  ///< "Contrast"
    std::string text;
};

/// The law, the groups, the observers, the contrast, screening, and what cannot be had. Nothing
/// about what was not computed.
std::vector<Finding> findings(const SlopeAnalysis& analysis);

/// What a reader must know before believing the headline: the law rejected, a parameter at its
/// bound, a fit that did not converge, one observer. Empty when there is nothing.
std::vector<std::string> warnings(const SlopeAnalysis& analysis);

/// One paragraph on what was done: data, screening, model, estimator, intervals.
std::string methodParagraph(const SlopeAnalysis& analysis);

}  // namespace analysis
