// SPDX-License-Identifier: MIT
#include "analysis/audience_curve.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "analysis/beta_analysis.h"
#include "analysis/observer_bootstrap.h"
#include "analysis/slope_analysis.h"
#include "analysis/slope_model.h"
#include "quest/random.h"
#include "tests/analysis/simulated_study.h"

namespace {

using namespace analysis;

const tests::StudyPlan kPlan{.observers = 6, .sizes = {10, 20}, .trials = 30};

TEST(AudienceCurve, IsWhatAPopulationOfSimulatedObserversSees) {
    const SlopeAnalysis result = analyseSlope(tests::simulateStudy(kPlan, 501));
    ASSERT_TRUE(result.audience);
    const AudienceCurve& curve = *result.audience;
    const auto& point = curve.points[curve.points.size() / 2];
    std::mt19937_64 rng(502);
    const int people = 20000;
    double detected = 0;
    std::vector<double> often(std::size(kTrialShares), 0.0);
    for (int i = 0; i < people; ++i) {
        const double log10c = result.slope.headline.value + curve.tau * quest::standardNormal(rng);
        const double f = quest::detectionProbability(log10c - std::log10(point.slope), curve.beta,
                                                     curve.criterion);
        detected += f / people;
        for (std::size_t q = 0; q < often.size(); ++q) {
            often[q] += f >= kTrialShares[q] ? 1.0 / people : 0;
        }
    }
    EXPECT_NEAR(point.detection, detected, 4 * 0.5 / std::sqrt(people));
    for (std::size_t q = 0; q < often.size(); ++q) {
        EXPECT_NEAR(point.observerShares[q], often[q], 4 * 0.5 / std::sqrt(people));
    }
}

TEST(AudienceCurve, NeedsAreItsInverse) {
    const SlopeAnalysis result = analyseSlope(tests::simulateStudy(kPlan, 503));
    for (const AudienceCurve::Need& need : result.audience->needs) {
        // An observer at that percentile detects just that share of the trials.
        const double z = (need.observerShare == 0.5   ? 0.0
                          : need.observerShare == 0.1 ? 1.2815515655446004
                                                      : 2.3263478740408408);
        const double log10c = result.slope.headline.value + result.audience->tau * z;
        EXPECT_NEAR(quest::detectionProbability(log10c - need.log10c, result.audience->beta,
                                                result.audience->criterion),
                    need.trialShare, 1e-9);
        ASSERT_TRUE(need.ci95);
        EXPECT_LT(need.ci95->low, need.log10c);
        EXPECT_GT(need.ci95->high, need.log10c);
    }
    EXPECT_THAT(audienceSentence(*result.audience),
                testing::HasSubstr("one person in ten notices the artifact one time in ten"));
}

TEST(AudienceCurve, KnowsNoPopulationFromOneObserver) {
    const SlopeAnalysis result =
        analyseSlope(tests::simulateStudy({.observers = 1, .sizes = {10, 20}}, 504));
    ASSERT_TRUE(result.audience);
    EXPECT_FALSE(result.audience->populationKnown);
    EXPECT_EQ(audienceSentence(*result.audience), "");
    for (const auto& need : result.audience->needs) EXPECT_EQ(need.observerShare, 0.5);
}

TEST(BetaAnalysis, PilotTrialsOfOnePersonSayHowLittleTheyTell) {
    // The published study's 60 trials: beta is known to a factor of about 2, most of it the prior.
    const SlopeAnalysis pilot =
        analyseSlope(tests::simulateStudy({.observers = 1, .sizes = {10}, .trials = 60}, 505));
    ASSERT_EQ(pilot.betas.size(), 1u);
    EXPECT_GT(pilot.betas[0].priorShare, 0.2);
    EXPECT_GT(pilot.betas[0].ci95.high / pilot.betas[0].ci95.low, 2);
    const SlopeAnalysis study =
        analyseSlope(tests::simulateStudy({.observers = 12, .sizes = {5, 10, 20}}, 506));
    const BetaEstimate& beta = study.betas.at(0);
    EXPECT_EQ(beta.trials, 12 * 3 * 40);
    EXPECT_LT(beta.priorShare, 0.3);
    EXPECT_LT(beta.ci95.low, 3.5);  // the truth; misses once in twenty, the seed is fixed
    EXPECT_GT(beta.ci95.high, 3.5);
    ASSERT_TRUE(beta.fromTrialsAlone);
    EXPECT_LT(beta.fromTrialsAloneCi95->low, beta.ci95.low);  // a prior in the middle narrows
}

TEST(ObserverBootstrap, AgreesWithTheIntervalAndNotWithTheNumberOfThreads) {
    const Study study = tests::simulateStudy({.observers = 8, .sizes = {10}, .trials = 30}, 507);
    const SlopeAnalysis result = analyseSlope(study, {.bootstrap = 60, .threads = 1});
    ASSERT_TRUE(result.bootstrap && result.bootstrap->overall);
    EXPECT_EQ(result.bootstrap->failed, 0);
    const auto own = result.overall.ci95();
    const double width = result.bootstrap->overall->high - result.bootstrap->overall->low;
    // sqrt(7/8) x 1.96 / 2.36 of the t interval, .78; percentiles of 60 draws scatter by .15.
    EXPECT_NEAR(width / (own->high - own->low), 0.78, 0.45);
    EXPECT_LT(result.bootstrap->overall->low, result.overall.value);
    EXPECT_GT(result.bootstrap->overall->high, result.overall.value);
    const SlopeAnalysis again = analyseSlope(study, {.bootstrap = 60, .threads = 3});
    EXPECT_EQ(result.bootstrap->headline->low, again.bootstrap->headline->low);
    EXPECT_EQ(result.bootstrap->ninetieth->high, again.bootstrap->ninetieth->high);
    EXPECT_EQ(result.bootstrap->overall->high, again.bootstrap->overall->high);
}

}  // namespace
