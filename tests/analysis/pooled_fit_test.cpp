// SPDX-License-Identifier: MIT
#include "analysis/pooled_fit.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>

#include "analysis/slope_model.h"
#include "tests/analysis/simulated_study.h"

namespace {

using namespace analysis;
using Eigen::VectorXd;

// The formula written out again, without any of the code under test: theta = (log10 c per group, ln
// beta, lapse).
double probabilityYes(const Model& model, const ModelCell& cell, std::size_t t,
                      const VectorXd& theta, double gamma) {
    const auto groups = model.design.cols();
    const double beta = std::exp(theta[groups]), lapse = theta[groups + 1];
    const double x =
        cell.trials.strength[t] + model.design.row(cell.condition).dot(theta.head(groups));
    const double offset = std::log10(-std::log(1 - model.criterion)) / beta;
    const double detection = 1 - std::exp(-std::pow(10.0, beta * (x + offset)));
    return lapse * gamma + (1 - lapse) * (gamma + (1 - gamma) * detection);
}

template <typename Term>
double sumOverTrials(const Model& model, Term term) {
    double sum = 0;
    for (const ModelObserver& observer : model.observers) {
        for (const ModelCell& cell : observer.cells) {
            for (std::size_t t = 0; t < cell.trials.strength.size(); ++t) {
                sum += term(observer, cell, t);
            }
        }
    }
    return sum;
}

double betaPrior(const VectorXd& theta, Eigen::Index at) {
    return -0.5 * std::pow((theta[at] - std::log(3.5)) / 0.5, 2);
}

double logPosterior(const Model& model, const VectorXd& theta) {
    const auto groups = model.design.cols();
    const double prior = betaPrior(theta, groups) + 19 * std::log1p(-theta[groups + 1]);
    return prior + sumOverTrials(model, [&](const auto& observer, const auto& cell, std::size_t t) {
               const double p = probabilityYes(model, cell, t, theta, observer.gamma);
               return std::log(t < cell.trials.yesCount ? p : 1 - p);
           });
}

// Golden section along one coordinate after the other, until nothing moves.
VectorXd bruteForce(const Model& model, VectorXd theta, const VectorXd& low, const VectorXd& high) {
    const double golden = 0.6180339887498949;
    double reach = 0.3;
    for (int cycle = 0; cycle < 120; ++cycle) {
        for (Eigen::Index j = 0; j < theta.size(); ++j) {
            double a = std::max(low[j], theta[j] - reach), b = std::min(high[j], theta[j] + reach);
            const auto at = [&](double v) {
                VectorXd moved = theta;
                moved[j] = v;
                return logPosterior(model, moved);
            };
            while (b - a > 1e-9) {
                const double left = b - golden * (b - a), right = a + golden * (b - a);
                (at(left) < at(right) ? a : b) = at(left) < at(right) ? left : right;
            }
            theta[j] = 0.5 * (a + b);
        }
        reach = std::max(1e-4, 0.8 * reach);
    }
    return theta;
}

struct Fitted {
    Model model;
    PooledFit fit;
    VectorXd theta;
};

Fitted fitted(std::uint64_t seed) {
    tests::StudyPlan plan{.observers = 3,
                          .sizes = {10},
                          .trials = 50,
                          .tau = 0.02,
                          .omega = 0,
                          .lapse = 0.1,
                          .catchTrials = 40};
    plan.groups = {{records::Pattern::stair, 1, 0.45}, {records::Pattern::stair, 0.5, 0.55}};
    const Study study = tests::simulateStudy(plan, seed);
    Fitted result{slopeModel(study, perGroupDesign(study), quest::kPaperCriterion), {}, {}};
    ModelParameters start;
    start.fixed = VectorXd::Constant(2, 0.5);
    start.beta = {3.5};
    result.fit = fitPooled(result.model, start);
    result.theta.resize(4);
    result.theta << result.fit.fixed, std::log(result.fit.beta.front()), result.fit.lapse;
    return result;
}

TEST(PooledFit, AgreesWithAnIndependentOptimiserToAMillionth) {
    const Fitted f = fitted(41);
    ASSERT_TRUE(f.fit.converged) << f.fit;
    ASSERT_FALSE(f.fit.lapseAtBound) << f.fit;
    VectorXd start(4), low(4), high(4);
    start << 0.4, 0.6, std::log(3.0), 0.03;
    low << -1, -1, 0, kLapseFloor;
    high << 2, 2, 3, kLapseLimit;
    const VectorXd expected = bruteForce(f.model, start, low, high);
    // The tolerance; the curvature is about 3e3, so that 1e-6 is 3e-9 of ln L.
    EXPECT_NEAR(f.theta[0] * std::log(10.0), expected[0] * std::log(10.0), 1e-6);
    EXPECT_NEAR(f.theta[1] * std::log(10.0), expected[1] * std::log(10.0), 1e-6);
    EXPECT_NEAR(f.theta[2], expected[2], 1e-5);
    EXPECT_NEAR(f.theta[3], expected[3], 1e-5);
    EXPECT_NEAR(f.fit.logLikelihood, logPosterior(f.model, expected), 1e-7);
}

TEST(PooledFit, FrozenWeightCovarianceIsTheExpectedInformation) {
    const Fitted f = fitted(42);
    ASSERT_TRUE(f.fit.converged) << f.fit;
    ASSERT_FALSE(f.fit.lapseAtBound) << f.fit;
    // ln L with every answer replaced by its fitted probability; the lapse prior has no share.
    const auto expected = [&](const VectorXd& theta) {
        return betaPrior(theta, 2) +
               sumOverTrials(f.model, [&](const auto& observer, const auto& cell, std::size_t t) {
                   const double p0 = probabilityYes(f.model, cell, t, f.theta, observer.gamma);
                   const double p = probabilityYes(f.model, cell, t, theta, observer.gamma);
                   return p0 * std::log(p) + (1 - p0) * std::log(1 - p);
               });
    };
    Eigen::MatrixXd information(4, 4);
    const double h = 1e-4;
    for (Eigen::Index j = 0; j < 4; ++j) {
        for (Eigen::Index k = 0; k < 4; ++k) {
            const auto at = [&](double dj, double dk) {
                VectorXd theta = f.theta;
                theta[j] += dj;
                theta[k] += dk;
                return expected(theta);
            };
            information(j, k) = -(at(h, h) - at(h, -h) - at(-h, h) + at(-h, -h)) / (4 * h * h);
        }
    }
    const Eigen::MatrixXd covariance = information.inverse();
    ASSERT_EQ(f.fit.covariance.rows(), 4);
    for (Eigen::Index j = 0; j < 4; ++j) {
        // The 1 %; both are exact but for the differences (1e-4).
        EXPECT_NEAR(f.fit.covariance(j, j) / covariance(j, j), 1, 0.01) << j;
    }
}

TEST(PooledFit, HoldsALapseRateAtItsBoundForTheCovariance) {
    tests::StudyPlan plan{
        .observers = 4, .sizes = {10}, .trials = 40, .tau = 0, .omega = 0, .lapse = 0};
    const Study study = tests::simulateStudy(plan, 43);
    const Model model = slopeModel(study, perGroupDesign(study), quest::kPaperCriterion);
    ModelParameters start;
    start.fixed = VectorXd::Constant(1, 0.5);
    start.beta = {3.5};
    const PooledFit fit = fitPooled(model, start);
    ASSERT_TRUE(fit.converged) << fit;
    ASSERT_TRUE(fit.lapseAtBound) << fit;
    EXPECT_EQ(fit.covariance.rows(), 2);
    // 40 trials are worth .0375 log10 at best (lapses 1 %; a little less without); 160 half of
    // that.
    EXPECT_GT(std::sqrt(fit.covariance(0, 0)), 0.017);
    EXPECT_LT(std::sqrt(fit.covariance(0, 0)), 0.04);
}

}  // namespace
