// SPDX-License-Identifier: MIT
#include "analysis/distributions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using namespace analysis;

TEST(Distributions, AgreeWithPublishedTables) {
    // Tables give six or seven digits.
    EXPECT_NEAR(normalQuantile(0.975), 1.959964, 1e-6);
    EXPECT_NEAR(normalQuantile(0.9), 1.2815516, 1e-7);
    EXPECT_NEAR(studentQuantile(0.975, 1), 12.706205, 1e-6);
    EXPECT_NEAR(studentQuantile(0.975, 4), 2.776445, 1e-6);
    EXPECT_NEAR(studentQuantile(0.975, 9), 2.262157, 1e-6);
    EXPECT_NEAR(studentQuantile(0.975, 1e7), 1.959964, 1e-6);
    EXPECT_NEAR(chiSquaredSurvival(3.841459, 1), 0.05, 1e-7);
    EXPECT_NEAR(chiSquaredSurvival(15.507313, 8), 0.05, 1e-7);
    EXPECT_NEAR(chiSquaredSurvival(139.3, 8) * 1e26, 3.4, 0.1);  // far tail keeps its digits
}

TEST(Distributions, QuantilesInvertProbabilities) {
    for (const double df : {1.0, 2.5, 9.0, 300.0, std::numeric_limits<double>::infinity()}) {
        for (const double p : {1e-6, 0.025, 0.3, 0.5, 0.9, 0.9999}) {
            // 1e-11: bisection to the last bit, cdf exact to 1e-13 relative in the smaller tail.
            EXPECT_NEAR(studentCdf(studentQuantile(p, df), df), p, 1e-11) << df;
        }
    }
}

TEST(Distributions, BetaIsSymmetricAndTheIntegralOfItsDensity) {
    for (const double a : {0.5, 2.0, 40.0}) {
        for (const double b : {0.5, 3.0, 120.0}) {
            EXPECT_NEAR(incompleteBeta(a, b, 0.3), 1 - incompleteBeta(b, a, 0.7), 1e-13);
        }
    }
    EXPECT_NEAR(incompleteBeta(2, 3, 0.4), 0.5248, 1e-14);  // polynomial: 6x^2 - 8x^3 + 3x^4
}

}  // namespace
