// SPDX-License-Identifier: MIT
// The figures of a slope report as gnuplot scripts with their data inline.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/reference_sizes.h"
#include "analysis/slope_analysis.h"

namespace analysis {

/// What was published for this task (Kreuzer, section 5 and eq. 1): c, and stair-step artifacts of
/// 10 px hidden at about 25 px, of 20 px at 50 px or more.
inline constexpr double kPublishedSlope = 3.47;

/// Threshold radius against artifact size, one panel per pattern (or angle) that was shown at two
/// sizes or more (all, where none was): each condition with its interval, the fitted law with its
/// band, the reference size R1/2, and what was published. Writes `svgName`.
std::string thresholdAgainstSizeScript(const SlopeAnalysis& analysis,
                                       const ReferenceSizes& reference, const std::string& svgName);

/// Every group's c with its interval, the overall slope and the headline.
std::string slopesByGroupScript(const SlopeAnalysis& analysis, const std::string& svgName);

}  // namespace analysis
