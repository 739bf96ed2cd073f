// SPDX-License-Identifier: MIT
#include "tests/analysis/coverage.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

// fit_coverage prints this for 500 studies of every plan; docs/results holds it.
TEST(Coverage, IntervalsOfSmallStudiesCoverAndEstimatesAreUnbiased) {
    const tests::StudyPlan plan = tests::coveragePlans().at(2);  // 6 observers, 2 unequal groups
    const int studies = 120;
    const auto outcomes = tests::fitMany(plan, studies, 1, 91);
    EXPECT_EQ(tests::share(outcomes, &tests::StudyOutcome::fitted), 1);
    const auto missed = [&](bool tests::StudyOutcome::*what) {
        return std::lround(studies * (1 - tests::share(outcomes, what)));
    };
    // At 95 % more than 15 of 120 miss with probability 5e-4; at 99.5 % none would.
    EXPECT_LE(missed(&tests::StudyOutcome::headlineCovered), 15);
    EXPECT_LE(missed(&tests::StudyOutcome::overallCovered), 15);
    EXPECT_LE(missed(&tests::StudyOutcome::covered90), 15);
    EXPECT_LE(missed(&tests::StudyOutcome::kappaCovered), 15);
    EXPECT_GE(missed(&tests::StudyOutcome::overallCovered), 1);
    // 1 %, and 3.5 standard errors of a median.
    const double sd = tests::standardDeviation(outcomes, &tests::StudyOutcome::headlineError);
    EXPECT_LT(std::abs(tests::median(outcomes, &tests::StudyOutcome::headlineError)),
              0.0043 + 3.5 * 1.2533 * sd / std::sqrt(studies));
    EXPECT_NEAR(tests::median(outcomes, &tests::StudyOutcome::beta), 3.5, 0.5);
}

TEST(Coverage, DoesNotDependOnTheNumberOfThreads) {
    const tests::StudyPlan plan{.observers = 4, .sizes = {10}, .trials = 15};
    const auto one = tests::fitMany(plan, 6, 1, 92), three = tests::fitMany(plan, 6, 3, 92);
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(one[i].headlineError, three[i].headlineError);
        EXPECT_EQ(one[i].tau, three[i].tau);
    }
}

}  // namespace
