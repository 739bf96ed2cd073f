// SPDX-License-Identifier: MIT
// What a slope means for an audience: of the people who look at a shadow filtered at r = s a, how
// many still notice its stair-steps, and how often?
//
// Under the fitted model an observer's log10 c is normal around the worst group's with sd tau, and
// detection at r = s a is F(log10 c - log10 s) with the pattern's beta. So the share of observers
// who detect the artifact on at least a share q of the trials is
//
//     P(q, s) = 1 - Phi((log10 s - m - K(q)) / tau),   K(q) = eps - log10(-ln(1 - q)) / beta,
//
// m the log10 c of the mean observer, eps the offset of the criterion (quest/psychometric.h). Both
// directions are given: the shares at a slope, and the slope that a pair of shares needs ("at c = 5
// one person in ten notices one time in ten").
//
// The interval of a needed slope takes the headline's interval (that of the 90th-percentile
// observer where p is less than a half, moved by the other percentile) and the uncertainty of beta,
// |K| se(ln beta), in quadrature. omega, which differs from condition to condition, is not a
// property of a person and stays out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/random_observer_fit.h"
#include "analysis/worst_group.h"
#include "records/slope_file.h"

namespace analysis {

/// Shares of the trials that the curve is drawn for.
inline constexpr double kTrialShares[] = {0.05, 0.10, 0.25, 0.50};

struct AudienceCurve {
    /// At r = s a.
    struct Point {
        double slope = 0;                    ///< s
        std::vector<double> observerShares;  ///< who detect it on at least kTrialShares[i]
        double detection = 0;                ///< share of all trials of all observers, guesses out
    };
    /// The slope at which at most `observerShare` of the observers detect the artifact on at least
    /// `trialShare` of the trials. A half: the mean observer.
    struct Need {
        double observerShare = 0.5, trialShare = 0.5;
        double log10c = 0;
        std::optional<records::Interval> ci95;  ///< absent with one observer
    };
    double beta = 0, tau = 0, criterion = 0;
    bool populationKnown = false;  ///< false with one observer: shares of observers mean nothing
    std::vector<Point> points;     ///< by rising slope, evenly spaced in its logarithm
    std::vector<Need> needs;       ///< observers a half, a tenth, a hundredth x kTrialShares
};

/// `betaIndex`: of the worst group's pattern in the fit; the other arguments as the headline's.
AudienceCurve audienceCurve(const RandomObserverFit& fit, const WorstGroup& headline,
                            std::size_t betaIndex, double criterion);

/// "At r = c a with c = 5.02 [4.1, 6.2] one person in ten notices the artifact one time in ten ..."
/// Empty where the population is not known.
std::string audienceSentence(const AudienceCurve& curve);

}  // namespace analysis
