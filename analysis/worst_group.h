// SPDX-License-Identifier: MIT
// The headline: the largest of several estimated slopes, with an interval that accounts for having
// taken the maximum, and the same for an observer at the 90th percentile.
//
// The largest of several noisy estimates is too large on average: by one standard error of the
// differences where four groups are equal, not at all where one lies clearly above the rest. All of
// it follows from the joint sampling distribution of the estimates, which are correlated (they
// share the observers) and have the tails of Student's t; it is drawn by parametric bootstrap.
//
//   estimate   max(estimates) less the median error of a maximum. The error depends on how far the
//              groups really lie apart; the estimates themselves lie too far apart, so they are
//              drawn together until their spread is what is left of it when the sampling variance
//              is taken away. In the normal model the median bias that remains is below half a
//              standard error of a group difference whatever the truth is: 0 for equal groups, +.4
//              for three of four equal, -.4 for one slightly above three.
//   interval   covers at least 95 % whatever the truth is (and 97 % at most where observers differ
//              more than groups do). Lower end: max(estimates) less the 97.5 % quantile of the
//              largest error of any group, which is the worst case, all groups equal; groups more
//              than 3 standard errors below the largest are not in question. Upper end: the highest
//              upper end of a group's own t interval, which is the worst case, one group above all.
//              A plug-in interval around the estimate covers 74 to 93 % where groups differ by
//              about as much as their errors and observers agree.
//   90th       estimate + 1.28 tau. The interval redraws tau with the same chi-squared that gives
//   percentile the t its tails (generalised interval: S. Weerahandi, J. Am. Stat. Assoc. 88, 1993).
//
// With one group all of it is that group's estimate and t interval.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "analysis/random_observer_fit.h"
#include "records/slope_file.h"

namespace analysis {

inline constexpr double kPercentile90 = 1.2815515655446004;  ///< of the standard normal
inline constexpr int kBootstrapDraws = 20000;                ///< in pairs of opposite sign
inline constexpr std::uint64_t kBootstrapSeed = 0x57A1;      ///< any; fixed so that runs agree

/// All in log10 units of c.
struct WorstGroup {
    int index = 0;                          ///< row with the largest estimate
    double value = 0;                       ///< bias-corrected maximum, mean observer
    std::optional<records::Interval> ci95;  ///< absent with one observer
    double value90 = 0;                     ///< value + 1.28 tau
    std::optional<records::Interval> ci95For90;
    double biasCorrection = 0;  ///< max(estimates) - value
};

/// `targets`: one row of weights on b per slope. Without a covariance (a fit that did not converge)
/// the intervals are absent and no bias is corrected.
WorstGroup worstGroup(const RandomObserverFit& fit, const Eigen::MatrixXd& targets,
                      std::uint64_t seed = kBootstrapSeed);

}  // namespace analysis
