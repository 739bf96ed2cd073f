// SPDX-License-Identifier: MIT
#include "analysis/audience_curve.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "analysis/distributions.h"
#include "analysis/number_text.h"

namespace analysis {
namespace {

constexpr double kObserverShares[] = {0.5, 0.1, 0.01};
constexpr int kPoints = 61;
constexpr int kMidpoints = 200;  // of the audience, for its mean detection

// How far above its own log10 c an observer's filter must be for detection to fall to q.
double offsetOf(double q, double beta, double criterion) {
    return quest::criterionOffset(criterion, beta) - quest::criterionOffset(q, beta);
}

double log10cOf(const WorstGroup& headline, double tau, double observerShare) {
    return headline.value + tau * normalQuantile(1 - observerShare);
}

// The headline's interval for that observer, and beta's share in quadrature.
std::optional<records::Interval> intervalOf(const WorstGroup& headline, double tau,
                                            double observerShare, double offset, double seLnBeta) {
    const bool upper = observerShare < 0.5;
    const auto& ci95 = upper ? headline.ci95For90 : headline.ci95;
    if (!ci95) return std::nullopt;
    const double centre = upper ? headline.value90 : headline.value;
    const double fromBeta = normalQuantile(0.975) * std::abs(offset) * seLnBeta;
    // Twice as far from the mean observer, the uncertainty of tau counts twice.
    const double reach = upper ? normalQuantile(1 - observerShare) / kPercentile90 : 1.0;
    const double estimate = log10cOf(headline, tau, observerShare) + offset;
    return records::Interval{estimate - std::hypot(reach * (centre - ci95->low), fromBeta),
                             estimate + std::hypot(reach * (ci95->high - centre), fromBeta)};
}

double meanDetection(double log10s, const WorstGroup& headline, double tau, double beta,
                     double criterion) {
    double sum = 0;
    for (int i = 0; i < kMidpoints; ++i) {
        const double z = normalQuantile((i + 0.5) / kMidpoints);
        sum += quest::detectionProbability(headline.value + tau * z - log10s, beta, criterion);
    }
    return sum / kMidpoints;
}

}  // namespace

AudienceCurve audienceCurve(const RandomObserverFit& fit, const WorstGroup& headline,
                            std::size_t betaIndex, double criterion) {
    AudienceCurve curve;
    curve.beta = fit.parameters.beta.at(betaIndex);
    curve.tau = fit.parameters.tau;
    curve.criterion = criterion;
    curve.populationKnown = fit.observers >= 2;
    const auto lnBeta = fit.parameters.fixed.size() + static_cast<Eigen::Index>(betaIndex);
    const double seLnBeta =
        fit.covariance.size() > 0 ? std::sqrt(fit.covariance(lnBeta, lnBeta)) : 0;
    for (const double p : kObserverShares) {
        if (!curve.populationKnown && p != 0.5) continue;
        for (const double q : kTrialShares) {
            const double offset = offsetOf(q, curve.beta, criterion);
            curve.needs.push_back({p, q, log10cOf(headline, curve.tau, p) + offset,
                                   intervalOf(headline, curve.tau, p, offset, seLnBeta)});
        }
    }
    // From where the mean observer is all but sure to see it to where one in a hundred hardly does.
    const double low = headline.value + offsetOf(0.98, curve.beta, criterion);
    const double high =
        log10cOf(headline, curve.tau, 0.01) + offsetOf(kTrialShares[0], curve.beta, criterion);
    for (int i = 0; i < kPoints; ++i) {
        const double log10s = low + (high - low) * i / (kPoints - 1);
        AudienceCurve::Point point{
            .slope = std::pow(10.0, log10s),
            .observerShares = {},
            .detection = meanDetection(log10s, headline, curve.tau, curve.beta, criterion)};
        for (const double q : kTrialShares) {
            const double over = log10s - headline.value - offsetOf(q, curve.beta, criterion);
            const double share = curve.tau > 0 ? normalCdf(-over / curve.tau) : (over < 0 ? 1 : 0);
            point.observerShares.push_back(share);
        }
        curve.points.push_back(point);
    }
    return curve;
}

std::string audienceSentence(const AudienceCurve& curve) {
    const auto tenth =
        std::find_if(curve.needs.begin(), curve.needs.end(), [](const AudienceCurve::Need& need) {
            return need.observerShare == 0.1 && need.trialShare == 0.1;
        });
    if (!curve.populationKnown || tenth == curve.needs.end()) return "";
    return "At r = c a with c = " + slopeText(tenth->log10c, tenth->ci95) +
           " one person in ten notices the artifact one time in ten or more often (guesses not "
           "counted).";
}

}  // namespace analysis
