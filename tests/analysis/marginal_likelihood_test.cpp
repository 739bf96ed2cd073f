// SPDX-License-Identifier: MIT
#include "analysis/marginal_likelihood.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/slope_model.h"
#include "tests/analysis/simulated_study.h"

namespace {

using namespace analysis;
using Eigen::VectorXd;

Model smallModel(int observers, int trials) {
    tests::StudyPlan plan;
    plan.observers = observers;
    plan.groups = {{records::Pattern::stair, 1, 0.5}, {records::Pattern::step, 1, 0.6}};
    plan.sizes = {10, 20};
    plan.trials = trials;
    const Study study = tests::simulateStudy(plan, 21);
    return slopeModel(study, perGroupDesign(study), quest::kPaperCriterion);
}

ModelParameters someParameters(const Model& model) {
    ModelParameters at;
    at.fixed = VectorXd::Constant(model.design.cols(), 0.56);
    at.beta.assign(static_cast<std::size_t>(model.betaCount), 3.2);
    at.lapse = 0.03;
    at.tau = 0.09;
    at.omega = 0.06;
    return at;
}

double logPrior(const ModelParameters& at) {
    double sum = 19 * std::log1p(-at.lapse);
    for (const double beta : at.beta) sum -= 0.5 * std::pow(std::log(beta / 3.5) / 0.5, 2);
    return sum;
}

TEST(MarginalLikelihood, GradientIsThatOfTheValue) {
    const Model model = smallModel(5, 20);
    for (const LikelihoodForm form : {LikelihoodForm::plain, LikelihoodForm::restricted}) {
        MarginalLikelihood likelihood(model);
        const VectorXd x = toCoordinates(someParameters(model));
        ASSERT_TRUE(likelihood.adapt(x));
        VectorXd gradient;
        likelihood.evaluate(x, form, &gradient);
        for (Eigen::Index j = 0; j < x.size(); ++j) {
            const double h = 1e-5;
            VectorXd up = x, down = x;
            up[j] += h;
            down[j] -= h;
            const double difference = (likelihood.evaluate(up, form, nullptr) -
                                       likelihood.evaluate(down, form, nullptr)) /
                                      (2 * h);
            // Of the differences: rounding 1e-13 / h, third derivatives h^2 (1e5 times the slope).
            EXPECT_NEAR(gradient[j], difference, 1e-5 * (1 + std::abs(difference))) << j;
        }
    }
}

// The double integral by brute force.
double integrated(const Model& model, const ModelParameters& at) {
    double sum = logPrior(at);
    const double step = 0.1;  // in prior sds
    for (const ModelObserver& observer : model.observers) {
        double overU = 0;
        for (double u = -6; u <= 6; u += step) {
            double product = -0.5 * u * u;
            for (const ModelCell& cell : observer.cells) {
                const Curve curve{.beta = at.beta[static_cast<std::size_t>(
                                      model.betaIndex[static_cast<std::size_t>(cell.condition)])],
                                  .criterion = model.criterion,
                                  .response = {observer.gamma, at.lapse, observer.lapseGuess}};
                const double centre = model.design.row(cell.condition).dot(at.fixed) + at.tau * u;
                double overV = 0;
                for (double v = -6; v <= 6; v += step) {
                    overV +=
                        std::exp(locationTerms(cell.trials, centre + at.omega * v, curve).value -
                                 0.5 * v * v);
                }
                product += std::log(overV * step / std::sqrt(2 * M_PI));
            }
            overU += std::exp(product);
        }
        sum += std::log(overU * step / std::sqrt(2 * M_PI));
    }
    return sum;
}

TEST(MarginalLikelihood, IsTheIntegralOverTheObservers) {
    const Model model = smallModel(4, 15);
    // 5 x 7 points on cells of 15 trials, the fewest worth fitting. At spreads of .09 and .06 log10
    // the log-likelihood is good to .001; at twice that, where a cell says less than the spread, to
    // .03, which moves an estimate by a hundredth of its error.
    for (const auto& [spread, tolerance] : {std::pair(0.5, 1e-4), {1.0, 2e-3}, {2.0, 0.03}}) {
        ModelParameters at = someParameters(model);
        at.tau *= spread;
        at.omega *= spread;
        MarginalLikelihood likelihood(model);
        ASSERT_TRUE(likelihood.adapt(toCoordinates(at)));
        EXPECT_NEAR(likelihood.evaluate(toCoordinates(at), LikelihoodForm::plain, nullptr),
                    integrated(model, at), tolerance)
            << spread;
    }
}

TEST(MarginalLikelihood, CountsAnObserverAsOftenAsItSays) {
    Model twice = smallModel(3, 15);
    twice.observers.push_back(twice.observers[1]);
    Model counted = smallModel(3, 15);
    counted.observers[1].copies = 2;
    const VectorXd x = toCoordinates(someParameters(twice));
    for (const LikelihoodForm form : {LikelihoodForm::plain, LikelihoodForm::restricted}) {
        MarginalLikelihood one(twice), other(counted);
        ASSERT_TRUE(one.adapt(x) && other.adapt(x));
        VectorXd oneGradient, otherGradient;
        // The same terms in another order, rounded at 1e-15 of each.
        EXPECT_NEAR(one.evaluate(x, form, &oneGradient), other.evaluate(x, form, &otherGradient),
                    1e-10);
        EXPECT_LT((oneGradient - otherGradient).norm(), 1e-9 * oneGradient.norm());
        const auto first = one.spreadInformation(), second = other.spreadInformation();
        EXPECT_LT((first.information - second.information).norm(), 1e-9 * first.information.norm());
        EXPECT_LT((first.perTau2 - second.perTau2).norm(), 1e-9 * first.perTau2.norm());
        EXPECT_LT((first.perOmega2 - second.perOmega2).norm(), 1e-9 * first.perOmega2.norm());
    }
}

TEST(MarginalLikelihood, OfFewPointsIsNearThatOfMany) {
    const Model model = smallModel(4, 15);
    const VectorXd x = toCoordinates(someParameters(model));
    MarginalLikelihood likelihood(model);
    ASSERT_TRUE(likelihood.adapt(x));
    const double fine = likelihood.evaluate(x, LikelihoodForm::plain, nullptr);
    likelihood.use(Quadrature::coarse);
    ASSERT_TRUE(likelihood.adapt(x));
    // A search that it leads starts within a tenth of a standard error: twice .005.
    EXPECT_NEAR(likelihood.evaluate(x, LikelihoodForm::plain, nullptr), fine, 0.1);
    likelihood.use(Quadrature::fine);
    ASSERT_TRUE(likelihood.adapt(x));
    EXPECT_NEAR(likelihood.evaluate(x, LikelihoodForm::plain, nullptr), fine, 1e-9);
}

TEST(MarginalLikelihood, WithoutSpreadIsTheSumOverTrials) {
    const Model model = smallModel(4, 15);
    ModelParameters at = someParameters(model);
    at.tau = at.omega = 0;
    double sum = logPrior(at);
    for (const ModelObserver& observer : model.observers) {
        for (const ModelCell& cell : observer.cells) {
            sum += locationTerms(cell.trials, model.design.row(cell.condition).dot(at.fixed),
                                 {.beta = 3.2, .response = {0.5, at.lapse, 0.5}})
                       .value;
        }
    }
    MarginalLikelihood likelihood(model);
    ASSERT_TRUE(likelihood.adapt(toCoordinates(at)));
    // 240 terms, rounded at 1e-15 each.
    EXPECT_NEAR(likelihood.evaluate(toCoordinates(at), LikelihoodForm::plain, nullptr), sum, 1e-10);
}

TEST(MarginalLikelihood, CoordinatesHoldEveryParameter) {
    const Model model = smallModel(2, 5);
    ModelParameters at = someParameters(model);
    for (const double lapse : {kLapseFloor, 0.02, kLapseLimit}) {
        at.lapse = lapse;
        const ModelParameters back = fromCoordinates(toCoordinates(at), model);
        EXPECT_EQ(back.fixed, at.fixed);
        EXPECT_NEAR(back.beta.front(), at.beta.front(), 1e-14);
        EXPECT_NEAR(back.lapse, lapse, 1e-14);
        EXPECT_EQ(back.tau, at.tau);
        EXPECT_EQ(back.omega, at.omega);
    }
}

TEST(MarginalLikelihood, SaysWhereItCannotBeHad) {
    const Model model = smallModel(2, 5);
    MarginalLikelihood likelihood(model);
    VectorXd x = toCoordinates(someParameters(model));
    ASSERT_TRUE(likelihood.adapt(x));
    VectorXd gradient;
    x[0] = std::nan("");
    EXPECT_TRUE(std::isnan(likelihood.evaluate(x, LikelihoodForm::plain, &gradient)));
    EXPECT_FALSE(likelihood.adapt(x));
}

}  // namespace
