// SPDX-License-Identifier: MIT
#include "analysis/worst_group.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include "quest/random.h"

namespace {

using namespace analysis;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A fit that found `estimates`, with errors shared between groups (`common`) and their own.
RandomObserverFit fitOf(const VectorXd& estimates, double common, double own, int observers) {
    RandomObserverFit fit;
    fit.converged = true;
    fit.parameters.fixed = estimates;
    fit.parameters.tau = 0.1;
    fit.observers = observers;
    const auto n = estimates.size();
    fit.covariance =
        MatrixXd::Constant(n, n, common * common) + own * own * MatrixXd::Identity(n, n);
    fit.fixedInformation = fit.covariance.inverse();
    return fit;
}

TEST(WorstGroup, OfOneGroupIsThatGroup) {
    const RandomObserverFit fit = fitOf(VectorXd::Constant(1, 0.5), 0.03, 0.01, 10);
    const WorstGroup worst = worstGroup(fit, MatrixXd::Identity(1, 1));
    const LinearEstimate own = linearEstimate(fit, VectorXd::Ones(1));
    EXPECT_EQ(worst.value, 0.5);
    ASSERT_TRUE(worst.ci95 && own.ci95());
    EXPECT_EQ(*worst.ci95, *own.ci95());
    EXPECT_NEAR(worst.value90, 0.5 + 0.12816, 1e-5);
}

TEST(WorstGroup, FarAboveTheOthersIsAlmostThatGroup) {
    VectorXd estimates(4);
    estimates << 0.2, 0.55, 0.25, 0.3;
    const RandomObserverFit fit = fitOf(estimates, 0.03, 0.01, 10);
    const WorstGroup worst = worstGroup(fit, MatrixXd::Identity(4, 4));
    const auto own = linearEstimate(fit, VectorXd::Unit(4, 1)).ci95();
    EXPECT_EQ(worst.index, 1);
    // 20,000 draws: a quantile is good to 2 % of a standard error, .0006.
    EXPECT_NEAR(worst.value, 0.55, 0.0007);
    EXPECT_NEAR(worst.ci95->low, own->low, 0.003);
    EXPECT_EQ(worst.ci95->high, own->high);
}

TEST(WorstGroup, IsTheSameEveryTime) {
    VectorXd estimates(3);
    estimates << 0.5, 0.51, 0.49;
    const RandomObserverFit fit = fitOf(estimates, 0.03, 0.01, 10);
    const WorstGroup a = worstGroup(fit, MatrixXd::Identity(3, 3));
    const WorstGroup b = worstGroup(fit, MatrixXd::Identity(3, 3));
    EXPECT_EQ(a.value, b.value);
    EXPECT_EQ(*a.ci95, *b.ci95);
    EXPECT_EQ(*a.ci95For90, *b.ci95For90);
}

// In the normal model itself: what the head of the header promises.
TEST(WorstGroup, MedianIsRightAndIntervalCoversWhereverTheGroupsLie) {
    const double common = 0.027, own = 0.01;
    const std::vector<std::vector<double>> truths = {{0, 0, 0, 0},
                                                     {0, -0.01, -0.02, -0.03},
                                                     {0, 0, -0.04, -0.04},
                                                     {0, -0.01, -0.01, -0.01},
                                                     {0, 0}};
    std::mt19937_64 rng(51);
    for (const auto& truth : truths) {
        const int repeats = 250;
        int covered = 0;
        std::vector<double> errors;
        for (int r = 0; r < repeats; ++r) {
            VectorXd estimates(static_cast<Eigen::Index>(truth.size()));
            const double shared = common * quest::standardNormal(rng);
            for (std::size_t g = 0; g < truth.size(); ++g) {
                estimates[static_cast<Eigen::Index>(g)] =
                    truth[g] + shared + own * quest::standardNormal(rng);
            }
            const auto n = estimates.size();
            const WorstGroup worst =
                worstGroup(fitOf(estimates, common, own, 100000), MatrixXd::Identity(n, n));
            covered += worst.ci95->low <= 0 && 0 <= worst.ci95->high ? 1 : 0;
            errors.push_back(worst.value);
        }
        // Coverage is at least 95 %: fewer than 225 of 250 have probability 4e-4.
        EXPECT_GE(covered, 225);
        std::nth_element(errors.begin(), errors.begin() + repeats / 2, errors.end());
        // Half of `own`, and 3 standard errors of the median (1.25 x .029 / sqrt(250)).
        EXPECT_LT(std::abs(errors[repeats / 2]), 0.5 * own + 3 * 0.0023);
    }
}

TEST(WorstGroup, OneObserverHasAnEstimateAlone) {
    RandomObserverFit fit = fitOf(VectorXd::Constant(2, 0.5), 0.03, 0.01, 1);
    fit.parameters.fixed[1] = 0.6;
    const WorstGroup worst = worstGroup(fit, MatrixXd::Identity(2, 2));
    EXPECT_EQ(worst.index, 1);
    EXPECT_EQ(worst.value, 0.6);
    EXPECT_FALSE(worst.ci95);
    EXPECT_FALSE(worst.ci95For90);
}

}  // namespace
