// SPDX-License-Identifier: MIT
#include "analysis/coverage.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "tests/run_command.h"

namespace {

using namespace analysis;
using testing::HasSubstr;

CoveragePlan smallPlan() {
    CoveragePlan plan;
    plan.design.name = "small";
    plan.design.artifactPx = {10, 20};
    plan.design.patterns = {{.pattern = records::Pattern::stair},
                            {.pattern = records::Pattern::step}};
    plan.design.trialsPerCondition = 30;
    plan.observers = 6;
    return plan;
}

const EstimatorCoverage& row(const Coverage& coverage, const std::string& name) {
    const auto found =
        std::find_if(coverage.estimators.begin(), coverage.estimators.end(),
                     [&](const EstimatorCoverage& one) { return one.name.starts_with(name); });
    if (found == coverage.estimators.end()) throw std::logic_error("no estimator " + name);
    return *found;
}

// docs/results holds what fit_slope --coverage prints for 500 studies of the published design.
TEST(Coverage, IntervalsOfSmallStudiesCoverAndEstimatesAreUnbiased) {
    CoveragePlan plan = smallPlan();
    plan.studies = 100;
    plan.threads = 1;
    const Coverage coverage = simulateCoverage(plan);
    EXPECT_EQ(coverage.withoutSlope, 0) << coverage.firstError;
    for (const char* name : {"headline", "90th", "overall", "group stair", "group step", "kappa"}) {
        const EstimatorCoverage& one = row(coverage, name);
        EXPECT_EQ(one.intervals, 100) << name;
        // At 95 % more than 13 of 100 miss with probability 5e-4.
        EXPECT_GE(one.covered, 87) << name;
    }
    EXPECT_LE(row(coverage, "overall").covered, 99);  // at 99.5 % none would miss
    const EstimatorCoverage& headline = row(coverage, "headline");
    EXPECT_NEAR(headline.truth, std::log10(3.47), 1e-9);
    // 1 %, and 3.5 standard errors of a median.
    EXPECT_LT(std::abs(headline.median), 0.0043 + 3.5 * headline.medianError());
    // What the table is for: taking all trials for independent covers far too seldom, and the line
    // through the origin is biased up.
    EXPECT_LT(row(coverage, "pooled").coverage(), 0.8);
    EXPECT_GT(row(coverage, "line through").bias, row(coverage, "power law").bias);
}

TEST(Coverage, DoesNotDependOnTheNumberOfThreads) {
    CoveragePlan plan = smallPlan();
    plan.studies = 6;
    plan.design.trialsPerCondition = 12;
    plan.threads = 1;
    const Coverage one = simulateCoverage(plan);
    plan.threads = 3;
    const Coverage three = simulateCoverage(plan);
    ASSERT_EQ(one.estimators.size(), three.estimators.size());
    for (std::size_t i = 0; i < one.estimators.size(); ++i) {
        EXPECT_EQ(one.estimators[i].bias, three.estimators[i].bias);
        EXPECT_EQ(one.estimators[i].sd, three.estimators[i].sd);
        EXPECT_EQ(one.estimators[i].covered, three.estimators[i].covered);
    }
}

TEST(Coverage, TruthMovesWithTheCriterionOfTheFit) {
    CoveragePlan plan = smallPlan();
    plan.studies = 2;
    plan.criterion = 0.1;
    const Coverage coverage = simulateCoverage(plan);
    EXPECT_NEAR(row(coverage, "headline").truth,
                std::log10(3.47 * quest::slopeFactor(quest::kPaperCriterion, 0.1, 3.5)), 1e-9);
}

TEST(Coverage, ScreeningKeepsAGuessingObserverFromMovingTheHeadline) {
    CoveragePlan plan = smallPlan();
    plan.design.catchShare = 0.15;
    plan.observers = 8;
    plan.guessing = 1;
    plan.studies = 12;
    const Coverage coverage = simulateCoverage(plan);
    ASSERT_TRUE(coverage.guessing);
    const GuessingEffect& effect = *coverage.guessing;
    // 21 catch trials, a coin each: passes with at most 4 wrong, .4 %; the attentive fail 1 %.
    EXPECT_GT(effect.guessersExcluded, 0.8);
    EXPECT_LT(effect.attentiveExcluded, 0.05);
    // 5 %, and 3 standard errors.
    EXPECT_LT(std::abs(effect.screenedMedian), std::log10(1.05) + 3 * effect.screenedError);
    EXPECT_GT(std::abs(effect.unscreenedMedian), std::abs(effect.screenedMedian));
}

TEST(Coverage, RefusesWhatCannotBeSimulated) {
    CoveragePlan plan = smallPlan();
    plan.observers = 0;
    EXPECT_THROW(simulateCoverage(plan), std::invalid_argument);
    plan = smallPlan();
    plan.guessing = 6;
    EXPECT_THROW(simulateCoverage(plan), std::invalid_argument);
    plan = smallPlan();
    plan.design.kernels = {"disc", "box"};
    EXPECT_THROW(simulateCoverage(plan), std::runtime_error);
}

TEST(Coverage, IsAnOptionOfFitSlope) {
    const tests::CommandResult run = tests::runProgram(
        "fit_slope", {"--coverage", "quick", "--observers", "3", "--studies", "2", "--trials", "10",
                      "--observer", "observer_sd=.05,beta=3", "--seed", "4", "--threads", "1"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("2 studies of design quick: 3 observers x 4 conditions x 10"));
    EXPECT_THAT(run.out, HasSubstr("headline: worst group"));
    const auto code = [](std::vector<std::string> arguments) {
        return tests::runProgram("fit_slope", arguments).exitCode;
    };
    EXPECT_EQ(code({"--coverage", "quick", "--out", "x"}), 2);
    EXPECT_EQ(code({"data", "--out", "x", "--studies", "5"}), 2);
    EXPECT_EQ(code({"--coverage", "quick", "--studies", "1"}), 2);
    EXPECT_EQ(code({"--coverage", "no such design"}), 1);
    EXPECT_EQ(code({"--coverage", "quick", "--observer", "beta=-1"}), 1);
}

}  // namespace
