// SPDX-License-Identifier: MIT
// The headline and every other estimate of c beside it, each with what it assumes: what a reader
// must know before preferring one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/slope_analysis.h"

namespace analysis {

struct Estimator {
    std::string name, assumes;
    std::optional<double> log10c;           ///< absent where it cannot be had
    std::optional<records::Interval> ci95;  ///< log10; absent for those that have none
};

std::vector<Estimator> estimators(const SlopeAnalysis& analysis);

}  // namespace analysis
