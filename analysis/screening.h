// SPDX-License-Identifier: MIT
// Which observers do not enter the slope, by rules that were fixed before any slope was seen
// (METHODS section 5). Results are given with and without them.
//
//   yes/no  the lower 95 % bound of the false-alarm rate on reference trials is above 10 %; or
//           there is no reference trial, so that the rate is unknown
//   2AFC    more than 20 % of the catch trials were answered wrong
//
// A staircase that ran against a display limit is named but stays in: a fit of the radii that were
// really shown is not biased by it, while leaving such runs out would be.
#pragma once

#include <string>
#include <vector>

#include "analysis/study.h"

namespace analysis {

struct ScreeningRules {
    bool apply = true;  ///< off: everyone enters, the table is still made
    ScreeningLimits limits = {};
    double falseAlarmConfidence = 0.95;
};

struct ScreenedObserver {
    std::string id;
    int trials = 0;  ///< artifact trials
    int references = 0, falseAlarms = 0;
    double falseAlarmLowerBound = 0;  ///< one-sided, exact (Clopper and Pearson)
    int catchTrials = 0, catchFailures = 0;
    std::vector<std::string> runsAtLimit = {};  ///< conditions whose staircase ran against a limit
    bool excluded = false;
    std::string reason = {};  ///< empty unless a rule was broken
};

/// One row per observer of the study, in its order.
std::vector<ScreenedObserver> screen(const Study& study, const ScreeningRules& rules = {});

/// The study without the excluded.
Study withoutExcluded(const Study& study, const std::vector<ScreenedObserver>& screening);

}  // namespace analysis
