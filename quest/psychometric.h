// SPDX-License-Identifier: MIT
// The psychometric function: one template for the staircase, the simulated observer and the fit.
//
// Source: A. B. Watson and D. G. Pelli, "QUEST: A Bayesian adaptive psychometric method", Perception &
// Psychophysics 33 (1983), the Weibull function over log intensity, with guessing and lapses.
//
// Stimulus strength x = log10(a / r): artifact size over filter radius, so visibility rises with x.
// F is the probability that the artifact is detected, corrected for guessing and lapses:
//
//     F(L) = 1 - exp(-10^(beta (L + eps))),    L = x - x0,    eps = log10(-ln(1 - F*)) / beta,
//
// so that F(0) = F*: the threshold x0 is where detection reaches the criterion F*, whatever gamma, delta and beta
// are. The probability of a "yes" (correct in 2AFC, seen in yes/no) is
//
//     P = delta g + (1 - delta) (gamma + (1 - gamma) F).
//
// The functions take double or any number type with exp, log and pow found by argument-dependent lookup (Ceres'
// Jet), so that the formula exists once.
#pragma once

#include <cmath>

namespace quest {

/// The published study's criterion: the F at which P = .82 in 2AFC with delta .01 (Kreuzer, "Using Perception-Based
/// Filtering to Hide Shadow Artifacts", section 4.3), about .6465. There the artifact is still seen on two trials
/// of three.
inline constexpr double kPaperCriterion =
    ((0.82 - 0.01 * 0.5) / (1.0 - 0.01) - 0.5) / (1.0 - 0.5);

/// How an observer turns detection into an answer. Probabilities in [0, 1]; lapse < 1.
struct ResponseModel {
    double gamma = 0.5;       ///< P(yes) without detection: 0.5 in 2AFC, the false-alarm rate in yes/no
    double lapse = 0.01;      ///< delta: share of trials answered without looking
    double lapseGuess = 0.5;  ///< g: P(yes) on a lapse
};

/// eps of the header, in log10 units. Requires 0 < criterion < 1 and beta > 0.
template <typename T>
T criterionOffset(double criterion, const T& beta) {
    return std::log10(-std::log1p(-criterion)) / beta;
}

/// The cumulative hazard 10^(beta (L + eps)) = -ln(1 - F): what the stable logarithms are built from.
/// `log10OverThreshold` is L = x - x0.
template <typename T>
T detectionHazard(const T& log10OverThreshold, const T& beta, double criterion) {
    using std::exp;
    constexpr double ln10 = 2.302585092994045684;
    return exp(ln10 * (beta * (log10OverThreshold + criterionOffset(criterion, beta))));
}

/// F(L), the corrected probability of detection. Exact near 0 (expm1), 1 for large L.
template <typename T>
T detectionProbability(const T& log10OverThreshold, const T& beta, double criterion) {
    using std::expm1;
    return -expm1(-detectionHazard(log10OverThreshold, beta, criterion));
}

/// P(yes) from F.
template <typename T>
T responseProbability(const T& detection, const ResponseModel& model) {
    return model.lapse * model.lapseGuess +
           (1.0 - model.lapse) * (model.gamma + (1.0 - model.gamma) * detection);
}

/// The filter radius factor between two criteria at the same beta: c(F) = c(F*) (ln(1-F*)/ln(1-F))^(1/beta).
/// Requires both criteria in (0, 1), beta > 0.
inline double slopeFactor(double fromCriterion, double toCriterion, double beta) {
    return std::pow(std::log1p(-fromCriterion) / std::log1p(-toCriterion), 1.0 / beta);
}

}  // namespace quest
