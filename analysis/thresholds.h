// SPDX-License-Identifier: MIT
// Two-stage results, for comparison with the one-stage fit: a threshold per observer and condition,
// then means over observers. The published way to a slope goes on from the same thresholds:
// line_fits.h.
//
// The first stage finds the maximum-likelihood location of each cell with beta and lapse held at
// the one-stage fit's values (40 trials cannot tell them). A cell whose answers are all right, all
// wrong, or otherwise without a best location is censored: it is listed, and left out of the means,
// which biases them; the one-stage fit keeps such cells.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/marginal_likelihood.h"
#include "analysis/random_observer_fit.h"
#include "analysis/study.h"

namespace analysis {

enum class ThresholdState { estimated, allYes, allNo, noMaximum };
std::string toText(ThresholdState state);

struct CellThreshold {
    std::size_t observer = 0, condition = 0;
    int trials = 0, yes = 0;
    ThresholdState state = ThresholdState::estimated;
    double log10c = 0;         ///< where estimated
    double standardError = 0;  ///< log10, from the curvature; where estimated
    double radiusPx = 0;       ///< c a
};
/// By observer, then condition. `model` must be the study's (slopeModel, any design).
std::vector<CellThreshold> cellThresholds(const Study& study, const Model& model,
                                          const ModelParameters& curve);

/// Mean over observers of each observer's mean log10 c over the conditions of a group (of all
/// groups: mean of the group means), with the t interval over observers.
struct TwoStage {
    std::optional<double> log10c;  ///< absent where no cell has a threshold
    std::optional<records::Interval> ci95;
    std::optional<double> medianLog10c;
    int observers = 0;
    int censored = 0;  ///< cells left out
};
TwoStage twoStage(const Study& study, const std::vector<CellThreshold>& thresholds,
                  std::optional<std::size_t> group = std::nullopt);

}  // namespace analysis
