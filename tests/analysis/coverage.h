// SPDX-License-Identifier: MIT
// How often the intervals of simulated studies contain the truth, and how far the estimates lie off
// it. Study i of a plan is the same whatever the number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "tests/analysis/simulated_study.h"

namespace tests {

/// One simulated study.
struct StudyOutcome {
    bool fitted = false;  ///< converged, with intervals
    bool headlineCovered = false, overallCovered = false, covered90 = false;
    bool kappaCovered = false, kappaRejected = false;
    double headlineError = 0, overallError = 0, error90 = 0;  ///< log10(estimate / truth)
    double tau = 0, omega = 0, beta = 0;
    double seconds = 0;  ///< of the fit
};

StudyOutcome fitOne(const StudyPlan& plan, std::uint64_t seed);

/// `done` is called after each study.
std::vector<StudyOutcome> fitMany(const StudyPlan& plan, int studies, int threads,
                                  std::uint64_t seed, const std::function<void()>& done = {});

double share(const std::vector<StudyOutcome>& outcomes, bool StudyOutcome::*what);
double median(const std::vector<StudyOutcome>& outcomes, double StudyOutcome::*what);
double standardDeviation(const std::vector<StudyOutcome>& outcomes, double StudyOutcome::*what);

/// The plans whose coverage is published in docs/results.
std::vector<StudyPlan> coveragePlans();

}  // namespace tests
