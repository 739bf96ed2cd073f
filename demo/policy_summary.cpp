// SPDX-License-Identifier: MIT
#include "demo/policy_summary.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace demo {
namespace {

constexpr std::array<std::string_view, 3> kEngines = {"coverage", "texels_per_pixel", "distance"};

/// Of an entry and what there was before; NaN counts as none.
void takeLess(double& least, double ratio) {
    if (std::isfinite(ratio) && !(least <= ratio)) least = ratio;
}

PolicySummary summaryOf(const PolicyComparison& comparison) {
    PolicySummary summary{.technique = comparison.technique, .bound = comparison.bound, .best = {}};
    if (comparison.ours) {
        summary.c = comparison.ours->parameter;
        summary.smallest = comparison.ours->smallest;
        summary.largest = comparison.ours->largest;
        summary.ms = comparison.ours->geometricMeanMs;
    }
    for (const PolicyComparison::Entry& entry : comparison.entries) {
        if (entry.policy->ours) continue;
        const std::string_view name = entry.policy->name;
        if (name == "fixed") summary.overFixed = entry.timesOurs;
        if (name == "paper") summary.overPublished = entry.timesOurs;
        if (std::find(kEngines.begin(), kEngines.end(), name) != kEngines.end())
            takeLess(summary.overEngines, entry.timesOurs);
        const double before = summary.overBest;
        takeLess(summary.overBest, entry.timesOurs);
        if (!(summary.overBest == before) && std::isfinite(summary.overBest)) summary.best = name;
    }
    return summary;
}

}  // namespace

std::vector<PolicySummary> summarised(const std::vector<PolicyComparison>& comparisons) {
    std::vector<PolicySummary> all;
    for (const PolicyComparison& comparison : comparisons) all.push_back(summaryOf(comparison));
    return all;
}

std::string verdict(double timesOurs) {
    if (!std::isfinite(timesOurs)) return "n/a";
    const double hundredths = std::round(100 * timesOurs);
    return hundredths > 100 ? "faster" : hundredths < 100 ? "slower" : "as fast";
}

double geometricMeanOf(const std::vector<double>& ratios) {
    double logs = 0;
    int count = 0;
    for (const double ratio : ratios) {
        if (!std::isfinite(ratio)) continue;
        logs += std::log(ratio);
        ++count;
    }
    return count == 0 ? PolicySummary::kNone : std::exp(logs / count);
}

}  // namespace demo
