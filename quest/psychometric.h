// SPDX-License-Identifier: MIT
// The psychometric function: one template for the staircase, the simulated observer and the fit.
//
// Source: A. B. Watson and D. G. Pelli, "QUEST: A Bayesian adaptive psychometric method",
// Perception & Psychophysics 33 (1983), the Weibull function over log intensity, with guessing and
// lapses.
//
// Stimulus strength x = log10(a / r): artifact size over filter radius, so visibility rises with x.
// F is the probability that the artifact is detected, corrected for guessing and lapses:
//
//     F(L) = 1 - exp(-10^(beta (L + eps))),   L = x - x0,   eps = log10(-ln(1 - F*)) / beta,
//
// so that F(0) = F*: the threshold x0 is where detection reaches the criterion F*, whatever gamma,
// delta and beta are. The probability of a "yes" (correct in 2AFC, seen in yes/no) is
//
//     P = delta g + (1 - delta) (gamma + (1 - gamma) F).
//
// The functions take double or any number type with exp, log, expm1 and log1p found by
// argument-dependent lookup and comparison with double (Ceres' Jet), so that the formula exists
// once. They do not check their arguments in the inner loop: validate() once before it.
//
//     const quest::ResponseModel task{.gamma = 0.5, .lapse = 0.02};
//     const double p = quest::responseProbability(
//         quest::detectionProbability(x - x0, beta, quest::kPaperCriterion), task);
//     const double cost = -quest::logNo(x - x0, beta, quest::kPaperCriterion, task);
#pragma once

#include <cmath>
#include <string>

namespace quest {

/// The published study's criterion: the F at which P = .82 in 2AFC with delta .01 (Kreuzer, "Using
/// Perception-Based Filtering to Hide Shadow Artifacts", section 4.3), about .6465. There the
/// artifact is still seen on two trials of three.
inline constexpr double kPaperCriterion = ((0.82 - 0.01 * 0.5) / (1.0 - 0.01) - 0.5) / (1.0 - 0.5);

/// x of an artifact of size a under a filter of radius r; both > 0, in the same unit. Rises with
/// visibility, so it falls with r.
inline double strength(double artifactSize, double radius) {
    return std::log10(artifactSize / radius);
}

/// The filter radius at which an artifact has strength x. At a threshold and a = 1 it is the slope
/// c.
inline double radiusAt(double artifactSize, double x) {
    return artifactSize * std::pow(10.0, -x);
}

/// How an observer turns detection into an answer. T is double, or the fit's number type where the
/// lapse or the guessing rate is estimated.
template <typename T>
struct ResponseModelOf {
    T gamma{0.5};       ///< P(yes) without detection, [0, 1]: 0.5 in 2AFC, the false-alarm rate in
                        ///< yes/no
    T lapse{0.01};      ///< delta, [0, 1): share of trials answered without looking
    T lapseGuess{0.5};  ///< g, [0, 1]: P(yes) on a lapse
};
using ResponseModel = ResponseModelOf<double>;

/// Empty when the model is usable; else a sentence that names field, value and rule.
std::string validate(const ResponseModel& model);

/// Same for a curve: beta finite and > 0, criterion in (0, 1).
std::string validateCurve(double beta, double criterion);

/// eps of the header, in log10 units. Requires 0 < criterion < 1 and beta > 0.
template <typename T>
T criterionOffset(double criterion, const T& beta) {
    return std::log10(-std::log1p(-criterion)) / beta;
}

/// ln of the hazard of the curve in its natural place, ln(10^(beta u)) = ln(-ln(1 - F)), with u =
/// L + eps in log10 units.
template <typename T>
T logHazard(const T& u, const T& beta) {
    constexpr double ln10 = 2.302585092994045684;
    return ln10 * (beta * u);
}

/// F at u: exact near 0 (expm1), 1 for large u.
template <typename T>
T weibull(const T& u, const T& beta) {
    using std::exp;
    using std::expm1;
    return -expm1(-exp(logHazard(u, beta)));
}

/// The cumulative hazard 10^(beta (L + eps)) = -ln(1 - F). `log10OverThreshold` is L = x - x0.
template <typename T>
T detectionHazard(const T& log10OverThreshold, const T& beta, double criterion) {
    using std::exp;
    const T u = log10OverThreshold + criterionOffset(criterion, beta);
    return exp(logHazard(u, beta));
}

/// F(L), the corrected probability of detection.
template <typename T>
T detectionProbability(const T& log10OverThreshold, const T& beta, double criterion) {
    const T u = log10OverThreshold + criterionOffset(criterion, beta);
    return weibull(u, beta);
}

/// P(yes) from F.
template <typename T, typename M>
T responseProbability(const T& detection, const ResponseModelOf<M>& model) {
    return model.lapse * model.lapseGuess +
           (1.0 - model.lapse) * (model.gamma + (1.0 - model.gamma) * detection);
}

/// P(no) = 1 - P(yes) from the probability of a miss, 1 - F, as a sum of non-negative terms: keeps
/// its relative precision where P(yes) is next to 1.
template <typename T, typename M>
T missProbability(const T& undetected, const ResponseModelOf<M>& model) {
    return model.lapse * (1.0 - model.lapseGuess) +
           (1.0 - model.lapse) * (1.0 - model.gamma) * undetected;
}

inline constexpr double kLogHazardOfUnderflow = 6.5;  ///< exp(-exp(6.5)) = 1e-289
inline constexpr double kLogHazardOfTail = -20.0;  ///< ln F = ln h - h/2 + h^2/24, which is 2e-19

/// ln P(no) at L, and ln P(yes) below: what likelihoods are made of. Both keep their relative
/// precision over the whole axis: where the answer is all but certain (log P is minus a tiny
/// number), and in the far tails, where exp(-hazard) underflows and P only lives as its logarithm.
/// -inf where the answer is impossible (for instance "no" with gamma = 1 and lapse = 0).
/// Derivatives by Jet are finite for |beta (L + eps)| < 300, 150 log10 units from any data.
template <typename T, typename M>
T logNo(const T& log10OverThreshold, const T& beta, double criterion,
        const ResponseModelOf<M>& model) {
    using std::exp;
    using std::expm1;
    using std::log;
    using std::log1p;
    const T u = log10OverThreshold + criterionOffset(criterion, beta);
    const T lnHazard = logHazard(u, beta);
    if (lnHazard > kLogHazardOfUnderflow) {
        const T onLapse(model.lapse * (1.0 - model.lapseGuess));
        if (onLapse > 0.0) return log(onLapse);
        return T(log((1.0 - model.lapse) * (1.0 - model.gamma)) - exp(lnHazard));
    }
    const T hazard = exp(lnHazard);
    const T yes = responseProbability(T(-expm1(-hazard)), model);
    if (yes < 0.5) return log1p(-yes);
    return log(missProbability(T(exp(-hazard)), model));
}

template <typename T, typename M>
T logYes(const T& log10OverThreshold, const T& beta, double criterion,
         const ResponseModelOf<M>& model) {
    using std::exp;
    using std::expm1;
    using std::log;
    using std::log1p;
    const T u = log10OverThreshold + criterionOffset(criterion, beta);
    const T lnHazard = logHazard(u, beta);
    if (lnHazard > kLogHazardOfUnderflow) return log1p(-missProbability(T(0.0), model));
    const T hazard = exp(lnHazard);
    const T miss = missProbability(T(exp(-hazard)), model);
    if (miss < 0.5) return log1p(-miss);
    const T withoutDetection = responseProbability(T(0.0), model);
    if (lnHazard < kLogHazardOfTail && !(withoutDetection > 0.0)) {
        return T(log((1.0 - model.lapse) * (1.0 - model.gamma)) + lnHazard - 0.5 * hazard);
    }
    return log(responseProbability(T(-expm1(-hazard)), model));
}

/// The filter radius factor between two criteria at the same beta:
/// c(F) = c(F*) (ln(1-F*)/ln(1-F))^(1/beta). Requires both criteria in (0, 1), beta > 0.
inline double slopeFactor(double fromCriterion, double toCriterion, double beta) {
    return std::pow(std::log1p(-fromCriterion) / std::log1p(-toCriterion), 1.0 / beta);
}

}  // namespace quest
