// SPDX-License-Identifier: MIT
#include "analysis/random_observer_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "analysis/slope_model.h"
#include "tests/analysis/simulated_study.h"

namespace {

using namespace analysis;
using Eigen::VectorXd;

ModelParameters startAt(const Model& model, double log10c, double beta, double tau, double omega) {
    ModelParameters start;
    start.fixed = VectorXd::Constant(model.design.cols(), log10c);
    start.beta.assign(static_cast<std::size_t>(model.betaCount), beta);
    start.tau = tau;
    start.omega = omega;
    return start;
}

TEST(RandomObserverFit, RecoversWhatWasSimulated) {
    tests::StudyPlan plan{.observers = 30, .groups = tests::fourGroups(0.4, 0.38, 0.54, 0.5)};
    const Study study = tests::simulateStudy(plan, 31);
    const Model model = slopeModel(study, perGroupDesign(study), quest::kPaperCriterion);
    const RandomObserverFit fit = fitRandomObservers(model, startAt(model, 0.5, 3.5, 0.1, 0.05));
    ASSERT_TRUE(fit.converged) << fit;
    const double truth[] = {0.4, 0.38, 0.54, 0.5};
    for (Eigen::Index g = 0; g < 4; ++g) {
        const LinearEstimate c = linearEstimate(fit, VectorXd::Unit(4, g));
        // 4 standard errors: false alarms 3e-4 for the four.
        EXPECT_NEAR(c.value, truth[g], 4 * c.standardError);
        EXPECT_NEAR(c.standardError, 0.1 / std::sqrt(30.0), 0.006);  // sd(tau) is 13 %
    }
    EXPECT_NEAR(fit.parameters.tau, 0.1, 4 * 0.1 / std::sqrt(58.0));
    EXPECT_NEAR(fit.parameters.omega, 0.05, 4 * 0.004);  // 480 cells, each known to .055
    for (const double beta : fit.parameters.beta) EXPECT_NEAR(std::log(beta / 3.5), 0, 4 * 0.06);
    EXPECT_LT(fit.parameters.lapse, 0.04);
    std::ostringstream text;
    text << fit;
    EXPECT_NE(text.str().find("converged; ln L"), std::string::npos);
}

TEST(RandomObserverFit, FindsTheSameMaximumFromAnywhere) {
    tests::StudyPlan plan{.observers = 6, .sizes = {10, 20}, .trials = 30};
    const Study study = tests::simulateStudy(plan, 32);
    const Model model = slopeModel(study, perGroupDesign(study), quest::kPaperCriterion);
    const RandomObserverFit first = fitRandomObservers(model, startAt(model, 0.5, 3.5, 0.1, 0.05));
    for (const auto& start :
         {startAt(model, 0.2, 2, 0.3, 0.02), startAt(model, 0.9, 6, 0.02, 0.2)}) {
        const RandomObserverFit other = fitRandomObservers(model, start);
        ASSERT_TRUE(other.converged) << other;
        // The last round starts within .01 standard errors of its maximum (se of c is .04).
        EXPECT_NEAR(other.parameters.fixed[0], first.parameters.fixed[0], 1e-3);
        EXPECT_NEAR(other.parameters.tau, first.parameters.tau, 1e-3);
        EXPECT_NEAR(other.logLikelihood, first.logLikelihood, 1e-2);
    }
}

TEST(RandomObserverFit, WhatAnotherFitLearntOfTheCurvaturesSavesStepsAndMovesNothing) {
    const tests::StudyPlan plan{.observers = 8, .groups = tests::fourGroups(0.4, 0.38, 0.54, 0.5)};
    const Study study = tests::simulateStudy(plan, 35);
    const Model model = slopeModel(study, perGroupDesign(study), quest::kPaperCriterion);
    const RandomObserverFit first =
        fitRandomObservers(model, startAt(model, 0.5, 3.5, 0.1, 0.05), {.covariance = false});
    Model drawn = model;
    drawn.observers[0].copies = 2;
    drawn.observers.pop_back();
    const RandomObserverFit cold =
        fitRandomObservers(drawn, first.parameters, {.covariance = false});
    const RandomObserverFit warm = fitRandomObservers(
        drawn, first.parameters, {.covariance = false, .inverseHessian = first.inverseHessian});
    ASSERT_TRUE(cold.converged && warm.converged);
    EXPECT_EQ(warm.observers, 8);
    EXPECT_LT(warm.evaluations, cold.evaluations);
    // Both end within 1e-4 standard errors (.04 log10) of a maximum whose points were adapted
    // within .01 of it.
    for (Eigen::Index g = 0; g < 4; ++g) {
        EXPECT_NEAR(warm.parameters.fixed[g], cold.parameters.fixed[g], 2e-4);
    }
    EXPECT_NEAR(warm.parameters.tau, cold.parameters.tau, 2e-4);
}

TEST(RandomObserverFit, IntervalOfABalancedStudyIsTheTTestOverObservers) {
    tests::StudyPlan plan{.observers = 8, .sizes = {5, 10, 20}, .trials = 60};
    const Study study = tests::simulateStudy(plan, 33);
    const Model model = slopeModel(study, perGroupDesign(study), quest::kPaperCriterion);
    const RandomObserverFit fit = fitRandomObservers(model, startAt(model, 0.5, 3.5, 0.1, 0.05));
    // Cells carry slightly different information, so that the design is balanced to some per cent.
    EXPECT_NEAR(satterthwaite(fit, VectorXd::Ones(1)), 7, 0.3);
    // The restricted tau is the maximum-likelihood one times sqrt(n / (n - 1)).
    const RandomObserverFit plain = fitRandomObservers(model, startAt(model, 0.5, 3.5, 0.1, 0.05),
                                                       {.form = LikelihoodForm::plain});
    const auto between = [](const RandomObserverFit& f) {
        return f.parameters.tau * f.parameters.tau + f.parameters.omega * f.parameters.omega / 3;
    };
    EXPECT_NEAR(between(fit) / between(plain), 8.0 / 7.0, 0.05);
}

// Thousands of trials tell where an observer lies much better than where the population does.
TEST(RandomObserverFit, ManyTrialsOfFewObserversHoldNeitherTheSearchNorTheInterval) {
    std::vector<double> sizes;
    for (int k = 1; k <= 40; ++k) sizes.push_back(k);
    const tests::StudyPlan plan{.observers = 5, .sizes = sizes, .trials = 20};
    const Study study = tests::simulateStudy(plan, 36);
    const Model model = slopeModel(study, perGroupDesign(study), quest::kPaperCriterion);
    const RandomObserverFit fit = fitRandomObservers(model, startAt(model, 0.5, 3.5, 0.1, 0.05));
    ASSERT_TRUE(fit.converged) << fit;
    EXPECT_LT(fit.evaluations, 80);  // 40 here; hundreds where the points hold the search
    const LinearEstimate c = linearEstimate(fit, VectorXd::Ones(1));
    const double between = std::hypot(fit.parameters.tau, fit.parameters.omega / std::sqrt(40.0));
    // The trials' own error, .06 log10 a cell, adds a part in a hundred.
    EXPECT_NEAR(c.standardError, between / std::sqrt(5.0), 0.03 * c.standardError);
    EXPECT_NEAR(c.degreesOfFreedom, 4, 0.1);
}

TEST(RandomObserverFit, OneObserverHasNoInterval) {
    tests::StudyPlan plan{.observers = 1};
    const Study study = tests::simulateStudy(plan, 34);
    const Model model = slopeModel(study, perGroupDesign(study), quest::kPaperCriterion);
    const RandomObserverFit fit =
        fitRandomObservers(model, startAt(model, 0.5, 3.5, 0, 0.05), {.estimateTau = false});
    ASSERT_TRUE(fit.converged) << fit;
    EXPECT_FALSE(linearEstimate(fit, VectorXd::Ones(1)).ci95());
    EXPECT_EQ(fit.parameters.tau, 0);
}

}  // namespace
