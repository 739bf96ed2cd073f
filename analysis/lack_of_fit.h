// SPDX-License-Identifier: MIT
// Whether the model describes the answers: do they scatter more than it says (overdispersion), and
// did thresholds move while the observers worked (practice, fatigue)? And what the staircases
// themselves made of the same trials.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/marginal_likelihood.h"
#include "analysis/random_observer_fit.h"
#include "analysis/study.h"
#include "analysis/thresholds.h"

namespace analysis {

/// A mean over observers with Student's t over them.
struct ObserverMean {
    double value = 0;  ///< log10 units of c
    double standardError = 0;
    int observers = 0;
    std::optional<records::Interval> ci95;  ///< absent with one observer
    std::optional<double> pValue;           ///< of no difference; likewise
};

/// log10 c in the second half of each observer's trials of a condition (in file order, sessions one
/// after the other) less that in the first half. One shift per observer, common to his conditions,
/// by maximum likelihood together with his thresholds, beta and lapse held at the fit's; then a t
/// test over observers. Above 0 artifacts became easier to see: practice; below: fatigue.
/// Observers without two trials in any condition are left out; absent where that leaves nobody.
std::optional<ObserverMean> secondHalfShift(const Study& study, const Model& model,
                                            const RandomObserverFit& fit);

/// Pearson's X^2 = sum over bins of (answers "yes" - expected)^2 / variance; the bins are each
/// observer's trials by strength, small ones joined. Each answer is forecast from those before: the
/// population as fitted, the observer's thresholds as far as his earlier trials tell them (A. P.
/// Dawid, "The prequential approach", J. R. Stat. Soc. A 147, 1984). Under the model the errors of
/// such forecasts add up like independent ones wherever a staircase places the next trial, so that
/// X^2 is chi-squared with a degree of freedom for every bin; a little less, since the population
/// was fitted to the same answers (in simulated studies of the published design X^2/df is .8). Not
/// with thresholds fitted to all answers: where a staircase goes depends on the answers, and X^2/df
/// is then 1.3 where the model holds.
struct Dispersion {
    double pearson = 0;  ///< X^2
    int degreesOfFreedom = 0;
    double pValue = 1;
    double ratio() const { return pearson / degreesOfFreedom; }  ///< 1 where the model holds
};

/// All trials at about one strength, for a residual plot.
struct ResidualBin {
    double strength = 0;  ///< mean of log10(c a / r), c as forecast
    int trials = 0;
    double observed = 0, expected = 0;  ///< shares of "yes"
    double standardError = 0;           ///< of the observed share under the model
};

struct FitCheck {
    std::optional<Dispersion> dispersion;  ///< absent where no bin is informative
    std::vector<ResidualBin> residuals;    ///< by rising strength
};
FitCheck checkFit(const Study& study, const Model& model, const RandomObserverFit& fit);

/// log10 c by the staircases' own last posterior means less that of the maximum-likelihood
/// thresholds of thresholds.h, at the fit's criterion: mean over each observer's conditions, then
/// over observers. The staircases assume one beta and lapse and start from a prior; a study that
/// reads c off them takes this error along.
struct StaircaseComparison {
    ObserverMean difference;
    double scatter = 0;        ///< sd of single differences, log10
    int cells = 0;             ///< with both
    double assumedBeta = 3.5;  ///< by the staircases
};
/// Absent, with the reason in `why`, where the tables hold no posterior or no sidecar says at which
/// criterion.
std::optional<StaircaseComparison> compareStaircases(const Study& study,
                                                     const std::vector<CellThreshold>& thresholds,
                                                     double criterion, std::string& why);

}  // namespace analysis
