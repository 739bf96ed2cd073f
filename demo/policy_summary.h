// SPDX-License-Identifier: MIT
// The comparison of sizing policies (policy_comparison.h) in one line for each technique: how much
// faster the automatic size is than what else there is, and than what it is slower.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "demo/policy_comparison.h"

namespace demo {

struct PolicySummary {
    std::string technique;
    double bound = 0;               ///< edge ripple that all keep to, as in PolicyComparison
    double c = kNone;               ///< that the automatic size takes for it; NaN: it cannot be had
    int smallest = 0, largest = 0;  ///< sizes that it takes
    double ms = kNone;              ///< geometric mean over the scenes

    // Time of the other over that of the automatic size: above 1 the automatic size is faster, NaN
    // where the other cannot keep to the bound.
    double overFixed = kNone;      ///< the best fixed size
    double overEngines = kNone;    ///< the fastest of coverage, texels per pixel, distance
    double overPublished = kNone;  ///< the published rule
    double overBest = kNone;       ///< the fastest of all these ...
    std::string best;              ///< ... and its name; empty for none

    static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
};

/// In the order of the comparisons.
std::vector<PolicySummary> summarised(const std::vector<PolicyComparison>& comparisons);

/// "faster", "as fast" or "slower" than another, as the ratio with two digits tells; "n/a" without.
std::string verdict(double timesOurs);

/// Over the finite ones of some ratios; NaN for none.
double geometricMeanOf(const std::vector<double>& ratios);

}  // namespace demo
