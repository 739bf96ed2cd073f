// SPDX-License-Identifier: MIT
// Which psychometric slope the trials themselves show, per pattern: what a pilot study is run for.
// The published study took its beta of 3.5 from 60 trials of one author (Kreuzer, section 4.3);
// `fit_slope` on such a table answers how far such trials can tell one.
#pragma once

#include <optional>
#include <vector>

#include "analysis/random_observer_fit.h"
#include "analysis/study.h"
#include "records/slope_file.h"

namespace analysis {

struct BetaEstimate {
    records::Pattern pattern = records::Pattern::stair;
    int trials = 0;
    /// With the weak prior (marginal_likelihood.h), normal in ln beta.
    double beta = 0;
    records::Interval ci95;
    /// Share of the information on ln beta that is the prior's.
    double priorShare = 0;
    /// The prior taken out again, which is exact where the likelihood is normal in ln beta; absent
    /// where more than half of what is known is the prior.
    std::optional<double> fromTrialsAlone;
    std::optional<records::Interval> fromTrialsAloneCi95;
};
/// One per pattern; empty for a fit without a covariance. One observer is enough: the interval is
/// that of the answers, beta being common to all.
std::vector<BetaEstimate> betaAnalysis(const Study& study, const RandomObserverFit& fit);

}  // namespace analysis
