// SPDX-License-Identifier: MIT
#include "analysis/cell_likelihood.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "analysis/exp_minus.h"
#include "quest/random.h"

namespace {

using namespace analysis;
using Jet = ceres::Jet<double, 3>;  // y, ln beta, lapse

CellTrials randomTrials(std::mt19937_64& rng, int count) {
    CellTrials trials;
    for (int t = 0; t < count; ++t) {
        trials.strength.push_back(-0.55 + 0.25 * quest::standardNormal(rng));
    }
    trials.yesCount = static_cast<std::size_t>(quest::uniformBelow(rng, count + 1u));
    return trials;
}

// l by quest's own logarithms, with automatic derivatives.
Jet automatic(const CellTrials& cell, double y, const Curve& curve) {
    const Jet location(y, 0), beta = exp(Jet(std::log(curve.beta), 1));
    const quest::ResponseModelOf<Jet> model{Jet(curve.response.gamma), Jet(curve.response.lapse, 2),
                                            Jet(curve.response.lapseGuess)};
    Jet sum(0.0);
    for (std::size_t t = 0; t < cell.strength.size(); ++t) {
        const Jet x = location + cell.strength[t];
        sum += t < cell.yesCount ? quest::logYes(x, beta, curve.criterion, model)
                                 : quest::logNo(x, beta, curve.criterion, model);
    }
    return sum;
}

std::vector<Curve> curves() {
    return {{.beta = 3.5, .response = {0.5, 0.02, 0.5}},
            {.beta = 1.2, .response = {0.5, 0.15, 0.5}},
            {.beta = 9.0, .response = {0.5, 0.001, 0.5}},
            {.beta = 3.0, .criterion = 0.1, .response = {0.02, 0.05, 0.02}}};
}

TEST(CellLikelihood, IsThePsychometricFunctionsAndSoAreItsDerivatives) {
    std::mt19937_64 rng(11);
    for (const Curve& curve : curves()) {
        const CellTrials cell = randomTrials(rng, 40);
        for (const double y : {-0.6, 0.0, 0.4, 0.55, 0.9, 1.6}) {
            const LocationTerms terms = locationTerms(cell, y, curve);
            const Jet expected = automatic(cell, y, curve);
            // 1e-11: sums of 40 terms of size 10, rounded at 1e-16 each.
            EXPECT_NEAR(terms.value, expected.a, 1e-11 * (1 + std::abs(expected.a)));
            EXPECT_NEAR(terms.first, expected.v[0], 1e-10 * (1 + std::abs(expected.v[0])));
            const double h = 1e-5;
            const double second = (locationTerms(cell, y + h, curve).first -
                                   locationTerms(cell, y - h, curve).first) /
                                  (2 * h);
            EXPECT_NEAR(terms.second, second, 1e-5 * (1 + std::abs(second)) + 1e-4);
        }
    }
}

TEST(CellLikelihood, ManyLocationsAtOnceAreTheSame) {
    std::mt19937_64 rng(12);
    CellPoints points;
    for (const Curve& curve : curves()) {
        for (const int trials : {1, 17, 40}) {
            const CellTrials cell = randomTrials(rng, trials);
            const std::vector<double> y = {-0.4, 0.1, 0.35, 0.5, 0.62, 0.9, 2.5};
            points.evaluate(cell, curve, y);
            for (std::size_t j = 0; j < y.size(); ++j) {
                const Jet expected = automatic(cell, y[j], curve);
                const auto near = [](double found, double wanted) {
                    // Sums of up to 40 terms, each good to 1e-15 of itself; they may cancel.
                    EXPECT_NEAR(found, wanted, 1e-10 * (1 + std::abs(wanted)));
                };
                near(points.value[j], expected.a);
                near(points.perY[j], expected.v[0]);
                near(points.perLnBeta[j], expected.v[1]);
                near(points.perLapse[j] * curve.response.lapse,
                     expected.v[2] * curve.response.lapse);
            }
        }
    }
}

TEST(CellLikelihood, ItsExponentialIsGoodToTheLastBit) {
    for (double x = 0; x < 700; x += 0.0137) {
        EXPECT_NEAR(expMinus(x) / std::exp(-x), 1, 4e-16) << x;
    }
}

TEST(CellLikelihood, StaysFiniteFarFromTheData) {
    std::mt19937_64 rng(13);
    const CellTrials cell = randomTrials(rng, 40);
    for (const double y : {-300.0, -30.0, 30.0, 300.0}) {
        const LocationTerms terms = locationTerms(cell, y, curves().front());
        EXPECT_TRUE(std::isfinite(terms.value) && std::isfinite(terms.first) &&
                    std::isfinite(terms.second))
            << y;
    }
}

}  // namespace
