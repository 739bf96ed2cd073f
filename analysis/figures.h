// SPDX-License-Identifier: MIT
// The figures of a slope report. Each is absent where the study has nothing to draw in it, and says
// in its caption what was chosen where a study is too large to be drawn whole.
#pragma once

#include <optional>

#include "analysis/figure.h"
#include "analysis/reference_sizes.h"
#include "analysis/slope_analysis.h"

namespace analysis {

/// Threshold radius against artifact size, one panel per pattern (or angle) that was shown at two
/// sizes or more (all, where none was): each condition with its interval, the fitted law with its
/// band, and what was published (the paper's Fig. 4).
Figure thresholdAgainstSize(const SlopeAnalysis& analysis);
/// The same beside the reference sizes R1/2 and R1, on logarithmic axes.
std::optional<Figure> referenceComparison(const SlopeAnalysis& analysis,
                                          const ReferenceSizes& reference);
/// c against the lit level (the paper's Fig. 5).
std::optional<Figure> slopeAgainstLight(const SlopeAnalysis& analysis);
/// Every group's c with its interval, the overall slope and the headline.
Figure slopesByGroup(const SlopeAnalysis& analysis);
/// Every observer's c with its interval (two observers or more).
std::optional<Figure> slopesByObserver(const SlopeAnalysis& analysis);
/// Share of observers who still notice, against c; absent with one observer.
std::optional<Figure> audienceShares(const SlopeAnalysis& analysis);
/// Answers in bins of r/a with the fitted curve: a panel per condition, or per group where there
/// are many conditions.
Figure psychometricFunctions(const SlopeAnalysis& analysis);
/// Radius from trial to trial, of observers and conditions that are evenly spaced in rank.
Figure staircaseTraces(const SlopeAnalysis& analysis);
/// Thresholds of single observers over those of the fit, against the artifact size.
std::optional<Figure> residualsAgainstSize(const SlopeAnalysis& analysis);
/// Lines of equal display value at the threshold, with the artifact and without it (the paper's
/// Fig. 2), of each pattern.
std::optional<Figure> isoContours(const SlopeAnalysis& analysis);

}  // namespace analysis
