// SPDX-License-Identifier: MIT
#include "analysis/beta_analysis.h"

#include <cmath>

#include "analysis/distributions.h"
#include "analysis/slope_model.h"

namespace analysis {
namespace {

constexpr double kMostlyPrior = 0.5;

records::Interval around(double lnBeta, double standardError) {
    const double half = normalQuantile(0.975) * standardError;
    return {std::exp(lnBeta - half), std::exp(lnBeta + half)};
}

}  // namespace

std::vector<BetaEstimate> betaAnalysis(const Study& study, const RandomObserverFit& fit) {
    std::vector<BetaEstimate> estimates;
    if (fit.covariance.size() == 0) return estimates;
    const std::vector<records::Pattern> patterns = betaPatterns(study);
    for (std::size_t j = 0; j < patterns.size(); ++j) {
        const auto at = fit.parameters.fixed.size() + static_cast<Eigen::Index>(j);
        const double variance = fit.covariance(at, at);
        const double lnBeta = std::log(fit.parameters.beta[j]);
        const double priorInformation = 1 / (kBetaPriorLnSd * kBetaPriorLnSd);
        BetaEstimate one;
        one.pattern = patterns[j];
        for (std::size_t g = 0; g < study.groups.size(); ++g) {
            if (study.groups[g].pattern == patterns[j]) one.trials += trialCount(study, g);
        }
        one.beta = fit.parameters.beta[j];
        one.ci95 = around(lnBeta, std::sqrt(variance));
        one.priorShare = priorInformation * variance;
        if (one.priorShare < kMostlyPrior) {
            const double information = 1 / variance - priorInformation;
            const double alone =
                (lnBeta / variance - std::log(kBetaPriorCentre) * priorInformation) / information;
            one.fromTrialsAlone = std::exp(alone);
            one.fromTrialsAloneCi95 = around(alone, 1 / std::sqrt(information));
        }
        estimates.push_back(one);
    }
    return estimates;
}

}  // namespace analysis
