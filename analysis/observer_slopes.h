// SPDX-License-Identifier: MIT
// How each observer differs from the mean observer, for the forest plot and its table: from the
// observer's own thresholds (thresholds.h), and as the one-stage fit has it.
#pragma once

#include <optional>
#include <vector>

#include "analysis/slope_analysis.h"

namespace analysis {

inline constexpr double kNormal95 = 1.959963984540054;  ///< half an interval, in standard errors

struct ObserverSlope {
    /// log10 of the observer's c over the mean observer's, and its standard error: the mean over
    /// the cells with a threshold, each weighted by 1 / (omega^2 + its squared error). Absent where
    /// every cell is censored.
    std::optional<double> own;
    double standardError = 0;
    double shrunken = 0;  ///< posterior mean of u_i: drawn to 0, the more the fewer the trials
    int cells = 0, censored = 0;
};

/// By observer of analysis.study.
std::vector<ObserverSlope> observerSlopes(const SlopeAnalysis& analysis);

/// Indices of the observers by rising c (the shrunken one: everybody has it).
std::vector<std::size_t> observersByRisingSlope(const std::vector<ObserverSlope>& slopes);

}  // namespace analysis
