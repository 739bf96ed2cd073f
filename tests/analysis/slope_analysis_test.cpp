// SPDX-License-Identifier: MIT
#include "analysis/slope_analysis.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "analysis/findings.h"
#include "analysis/slope_record.h"
#include "tests/analysis/simulated_study.h"

namespace {

using namespace analysis;
using testing::HasSubstr;

double c(double log10c) {
    return std::pow(10.0, log10c);
}

std::string refusal(const Study& study) {
    try {
        analyseSlope(study);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "(no error)";
}

// A study of one table per observer whose answers are rewritten.
Study rewritten(const tests::StudyPlan& plan,
                const std::function<void(records::Trial&, std::size_t observer)>& rewrite) {
    std::mt19937_64 rng(71);
    auto tables = tests::simulateTables(plan, rng);
    for (std::size_t i = 0; i < tables.size(); ++i) {
        for (records::Trial& trial : tables[i].trials) rewrite(trial, i);
    }
    return studyOf(tables);
}

void answer(records::Trial& trial, bool yes) {
    trial.correct = yes;
    if (trial.task == records::Task::yesNo) {
        trial.response = yes ? records::Response::seen : records::Response::notSeen;
    }
}

TEST(SlopeAnalysis, RecoversTheSimulatedPopulation) {
    const tests::StudyPlan plan{.observers = 12,
                                .groups = tests::fourGroups(0.40, 0.38, 0.54, 0.50)};
    const SlopeAnalysis result = analyseSlope(tests::simulateStudy(plan, 172));
    const auto& slope = result.slope;
    EXPECT_EQ(slope.worstGroup, "step, lit 1");
    // 4 standard errors of about .03.
    EXPECT_NEAR(slope.headline.value, 0.54, 0.12);
    EXPECT_NEAR(result.overall.value, 0.455, 0.12);
    // Two estimators of one quantity: apart by a share of their common error.
    EXPECT_NEAR(result.twoStage.log10c.value(), result.overall.value, 0.02);
    EXPECT_NEAR(slope.kappa->value, 1, 4 * slope.kappa->standardError);
    EXPECT_FALSE(slope.lawRejected);
    EXPECT_LT(result.equalGroupsTest->pValue, 1e-6);  // .14 log10 apart, se .01
    // Half the light: .02 and .04 log10 less, e = .066 and .13.
    EXPECT_NEAR(result.contrastExponent->value, 0.1, 4 * result.contrastExponent->standardError);
    // These tables hold no staircase's posterior.
    EXPECT_THAT(result.absent,
                testing::ElementsAre(HasSubstr("comparison with the staircases' own thresholds")));
    for (const ConditionResult& condition : result.conditions) EXPECT_TRUE(condition.c);
    EXPECT_FALSE(result.everyone);
    // K's 82 % at his lapse rate; a little more or less at the fitted one.
    EXPECT_NEAR(result.percentAtThreshold, 82, 1);
}

TEST(SlopeAnalysis, GivesTheSameBitsEveryTime) {
    const tests::StudyPlan plan{.observers = 5,
                                .groups = tests::fourGroups(0.5, 0.5, 0.5, 0.5),
                                .sizes = {10, 20},
                                .trials = 20};
    const records::RunContext context = records::currentRunContext("test", {});
    const auto record = [&] {
        return slopeRecord(analyseSlope(tests::simulateStudy(plan, 73)), context);
    };
    EXPECT_EQ(record(), record());
}

TEST(SlopeAnalysis, AnotherCriterionIsTheSameCurveReadElsewhere) {
    const tests::StudyPlan plan{.observers = 6, .sizes = {10, 20}};
    const Study study = tests::simulateStudy(plan, 74);
    AnalysisOptions hidden;
    hidden.criterion = 0.1;
    const SlopeAnalysis published = analyseSlope(study), other = analyseSlope(study, hidden);
    const double beta = published.slope.law.parameters.beta.front();
    // Closed-form offset. The quadrature's points follow each criterion's own c, and the two maxima
    // are each within .01 standard errors (9 % of c) of the integral's.
    const double offset = quest::slopeFactor(quest::kPaperCriterion, 0.1, beta);
    EXPECT_NEAR(c(other.slope.headline.value) / c(published.slope.headline.value), offset,
                2 * 0.01 * 0.09 * offset);
    EXPECT_NEAR(other.slope.law.parameters.tau, published.slope.law.parameters.tau, 1e-3);
    EXPECT_THROW(analyseSlope(study, {.criterion = 1.0}), std::invalid_argument);
    EXPECT_THROW(analyseSlope(study, {.criterion = std::nan("")}), std::invalid_argument);
}

TEST(SlopeAnalysis, WhereTheLawBendsTheHeadlineIsTheLargestOverTheMeasuredSizes) {
    const tests::StudyPlan plan{
        .observers = 10, .groups = tests::fourGroups(0.44, 0.44, 0.54, 0.54), .kappa = 0.8};
    const SlopeAnalysis result = analyseSlope(tests::simulateStudy(plan, 75));
    EXPECT_TRUE(result.slope.lawRejected);
    EXPECT_NEAR(result.slope.kappa->value, 0.8, 4 * result.slope.kappa->standardError);
    EXPECT_EQ(result.slope.worstArtifactPx, 5);
    EXPECT_NEAR(result.slope.headline.value, 0.54 + 0.2 * std::log10(2.0), 0.13);
    EXPECT_THAT(slopeRecord(result, {}).method, HasSubstr("rejects r = c a"));
    EXPECT_THAT(findings(result).front().text, HasSubstr("The law is rejected"));
}

TEST(SlopeAnalysis, ScreensAGuesserAndGivesTheSlopeWithAndWithout) {
    tests::StudyPlan plan{.observers = 10, .sizes = {10, 20}, .guessing = 0, .catchTrials = 30};
    const SlopeAnalysis clean = analyseSlope(tests::simulateStudy(plan, 76));
    plan.guessing = 1;
    const SlopeAnalysis result = analyseSlope(tests::simulateStudy(plan, 76));
    EXPECT_EQ(result.study.observers.size(), 9u);
    ASSERT_TRUE(result.everyone);
    // One attentive observer fewer moves the mean by .1/sqrt(90) log10, 2.5 %; twice that at 95 %.
    EXPECT_NEAR(c(result.slope.headline.value) / c(clean.slope.headline.value), 1, 0.05);
}

TEST(SlopeAnalysis, OneObserverHasASlopeAndNamesTheIntervalsThatCannotBeHad) {
    const tests::StudyPlan plan{.observers = 1, .groups = tests::fourGroups(0.5, 0.5, 0.5, 0.5)};
    const SlopeAnalysis result = analyseSlope(tests::simulateStudy(plan, 77));
    EXPECT_FALSE(result.slope.headline.ci95);
    EXPECT_FALSE(result.overall.ci95());
    EXPECT_THAT(result.absent, testing::Contains(HasSubstr("every interval of c: one observer")));
    const records::Slope record = slopeRecord(result, records::currentRunContext("test", {}));
    EXPECT_FALSE(record.c.ci95);
    EXPECT_GT(record.c.estimate, 1);
}

TEST(SlopeAnalysis, OneConditionWorks) {
    const tests::StudyPlan plan{.observers = 6, .sizes = {10}};
    const SlopeAnalysis result = analyseSlope(tests::simulateStudy(plan, 78));
    EXPECT_TRUE(result.slope.headline.ci95);
    EXPECT_NEAR(result.slope.headline.value, 0.54, 0.2);  // 4 standard errors
    EXPECT_FALSE(result.slope.kappa);
    EXPECT_THAT(result.absent, testing::Contains(HasSubstr("exponent kappa")));
    EXPECT_THAT(result.absent, testing::Contains(HasSubstr("spread of observer x condition")));
}

TEST(SlopeAnalysis, RefusesWhereTheLargestSlopeIsNotKnown) {
    const tests::StudyPlan plan{.observers = 2, .sizes = {10}};
    const Study allRight = rewritten(plan, [](records::Trial& t, std::size_t) { answer(t, true); });
    EXPECT_THAT(refusal(allRight), HasSubstr("stair, lit 1: 80 of 80 answers right at r/a from"));
    EXPECT_THAT(refusal(allRight), HasSubstr("the threshold lies above every radius shown"));
    const Study allWrong =
        rewritten(plan, [](records::Trial& t, std::size_t) { answer(t, false); });
    EXPECT_THAT(refusal(allWrong), HasSubstr("no slope can be fitted"));
    EXPECT_THAT(refusal(allWrong), HasSubstr("0 of 80 answers right"));
    const Study oneTrial = tests::simulateStudy({.observers = 1, .sizes = {10}, .trials = 1}, 79);
    EXPECT_THAT(refusal(oneTrial), HasSubstr("of 1 answers right"));
}

TEST(SlopeAnalysis, LeavesOutAGroupBelowEveryRadiusShown) {
    const tests::StudyPlan plan{
        .observers = 4, .groups = tests::fourGroups(0.5, 0.5, 0.5, 0.5), .sizes = {10}};
    const Study study = rewritten(plan, [n = 0](records::Trial& t, std::size_t) mutable {
        if (t.pattern == records::Pattern::step) answer(t, ++n % 2 == 0);  // chance
    });
    const SlopeAnalysis result = analyseSlope(study);
    EXPECT_EQ(result.groups.size(), 2u);
    EXPECT_THAT(result.notices, testing::Contains(HasSubstr("step, lit 1: ")));
    EXPECT_THAT(result.notices, testing::Contains(HasSubstr("group left out")));
}

TEST(SlopeAnalysis, KeepsSeparatedRunsInTheFitAndMarksThemInTheTwoStageTable) {
    const tests::StudyPlan plan{.observers = 6, .sizes = {10, 20}};
    const Study study = rewritten(plan, [](records::Trial& t, std::size_t observer) {
        if (observer == 0 && t.artifactPx == 10) answer(t, true);
        if (observer == 1 && t.artifactPx == 20) answer(t, false);
    });
    const SlopeAnalysis result = analyseSlope(study);
    EXPECT_TRUE(result.slope.law.converged) << result.slope.law;
    EXPECT_EQ(result.thresholds[0].state, ThresholdState::allYes);
    EXPECT_EQ(result.thresholds[3].state, ThresholdState::allNo);
    EXPECT_EQ(result.twoStage.censored, 2);
    EXPECT_TRUE(result.slope.headline.ci95);
}

TEST(SlopeAnalysis, FlagsASlopeFromOneRadius) {
    const tests::StudyPlan plan{.observers = 4, .sizes = {10}};
    const Study study = rewritten(plan, [n = 0](records::Trial& t, std::size_t) mutable {
        t.filterRadiusPx = 30;
        answer(t, ++n % 5 != 0);  // 80 %
    });
    const SlopeAnalysis result = analyseSlope(study);
    EXPECT_THAT(result.groups[0].flag, HasSubstr("one radius only"));
    // 80 % right is a little less than the 82 % at the threshold.
    EXPECT_NEAR(c(result.groups[0].c.value), 3.0, 0.3);
}

TEST(SlopeAnalysis, SurvivesAnObserverWhoAlwaysPressesLeft) {
    const tests::StudyPlan plan{.observers = 6, .sizes = {10, 20}};
    const Study study = rewritten(plan, [n = 0](records::Trial& t, std::size_t observer) mutable {
        if (observer == 0) answer(t, ++n % 2 == 0);  // sides are random: right every other time
    });
    const SlopeAnalysis result = analyseSlope(study);
    EXPECT_TRUE(std::isfinite(result.slope.headline.value));
    // He has no catch trials to fail, so that he shows as spread between observers.
    EXPECT_GT(result.slope.law.parameters.tau, 0.15);
}

TEST(SlopeAnalysis, RefusesWhenScreeningLeavesNobody) {
    const tests::StudyPlan plan{
        .observers = 2, .sizes = {10}, .trials = 20, .yesNo = true, .references = 0};
    EXPECT_THAT(refusal(tests::simulateStudy(plan, 80)),
                HasSubstr("no observer passes the screening: participant 001: no reference trial"));
}

TEST(SlopeAnalysis, LeastSquaresThroughTheOriginIsThePublishedFormula) {
    const tests::StudyPlan plan{.observers = 3, .sizes = {10, 20}};
    const Study study = tests::simulateStudy(plan, 81);
    const SlopeAnalysis result = analyseSlope(study);
    double ar = 0, aa = 0;
    for (const CellThreshold& cell : result.thresholds) {
        const double a = study.conditions[cell.condition].artifactPx;
        EXPECT_NEAR(cell.radiusPx, a * c(cell.log10c), 1e-9);
        ar += a * cell.radiusPx;
        aa += a * a;
    }
    EXPECT_NEAR(result.lines.throughOrigin.value(), ar / aa, 1e-12);
}

TEST(SlopeAnalysis, WorksInYesNo) {
    const tests::StudyPlan plan{.observers = 10, .sizes = {10, 20}, .yesNo = true};
    const SlopeAnalysis result = analyseSlope(tests::simulateStudy(plan, 82));
    EXPECT_NEAR(result.slope.headline.value, 0.54, 0.14);  // 4 standard errors
    EXPECT_EQ(slopeRecord(result, {}).task, records::Task::yesNo);
    // F* = .6465 is P(seen) of about .65 there.
    EXPECT_NEAR(result.percentAtThreshold, 65, 3);
}

}  // namespace
