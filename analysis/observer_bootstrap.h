// SPDX-License-Identifier: MIT
// Bootstrap over observers (B. Efron, Ann. Statist. 7, 1979): as many observers are drawn with
// replacement, the one-stage fit is done anew, and the percentiles of what comes out are an
// interval that assumes no distribution of the observers. For comparison: with n observers it is
// too short by about sqrt((n - 1) / n), and it knows no Student's t.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>

#include "analysis/random_observer_fit.h"
#include "analysis/worst_group.h"

namespace analysis {

struct ObserverBootstrap {
    int draws = 0, failed = 0;  ///< failed: the fit did not converge, or a group lost its observers
    /// Of log10 c; absent with one observer or where more than one draw in twenty failed.
    std::optional<records::Interval> headline;   ///< largest target of each draw, corrected as the
                                                 ///< headline was
    std::optional<records::Interval> ninetieth;  ///< that + 1.28 tau of the draw
    std::optional<records::Interval> overall;    ///< mean of the targets
};

/// `fit` of `model` is where every draw starts; `targets` as in worst_group.h. Draw d has random
/// numbers of its own, so that the result does not depend on `threads` (parallel.h). `done` is
/// called after each draw, from several threads.
ObserverBootstrap bootstrapObservers(const Model& model, const RandomObserverFit& fit,
                                     const Eigen::MatrixXd& targets, const WorstGroup& headline,
                                     int draws, std::uint64_t seed, int threads = 0,
                                     const std::function<void()>& done = {});

}  // namespace analysis
