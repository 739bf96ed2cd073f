// SPDX-License-Identifier: MIT
#include "demo/growth_exponent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

TEST(GrowthExponent, IsThatOfAPower) {
    for (const double exponent : {0.0, 1.0, 2.0, 3.0}) {
        std::vector<std::pair<double, double>> points;
        for (const double n : {512.0, 728.0, 1024.0, 2048.0, 4096.0})
            points.emplace_back(n, 3.5e-6 * std::pow(n, exponent));
        const demo::GrowthExponent growth = demo::growthExponent(points);
        EXPECT_NEAR(growth.exponent, exponent, 1e-9);
        EXPECT_NEAR(growth.residual, 0, 1e-9);
        EXPECT_EQ(growth.points, 5);
    }
}

TEST(GrowthExponent, SaysHowFarThePointsAreOff) {
    // A tenth up and down in turns.
    const demo::GrowthExponent growth =
        demo::growthExponent({{1, 1.1}, {2, 2 / 1.1}, {4, 4 / 1.1}, {8, 8 * 1.1}});
    EXPECT_NEAR(growth.exponent, 1, 1e-9);
    EXPECT_NEAR(growth.residual, std::log(1.1), 1e-9);
}

TEST(GrowthExponent, HasAnIntervalThatCoversInNineteenOfTwenty) {
    // 2000 straight lines with five points each: the share covered is within .015 of .95 but for
    // three runs in a thousand, and the quantile is good to 1 %.
    std::mt19937 random(5);
    std::normal_distribution<double> noise(0, 0.1);
    int covered = 0;
    constexpr int kLines = 2000;
    for (int i = 0; i < kLines; ++i) {
        std::vector<std::pair<double, double>> points;
        for (const double n : {1.0, 2.0, 4.0, 8.0, 16.0})
            points.emplace_back(n, 3 * std::pow(n, 1.5) * std::exp(noise(random)));
        const demo::GrowthExponent growth = demo::growthExponent(points);
        covered += std::abs(growth.exponent - 1.5) <= growth.halfWidth95;
    }
    EXPECT_NEAR(static_cast<double>(covered) / kLines, 0.95, 0.016);
}

TEST(GrowthExponent, NeedsThreePointsThatAreNumbers) {
    EXPECT_EQ(demo::growthExponent({{1, 1}, {2, 2}, {4, 0}, {8, NAN}, {0, 3}}).points, 0);
    EXPECT_EQ(demo::growthExponent({{1, 1}, {1, 2}, {1, 3}}).points, 0);
    EXPECT_EQ(demo::growthExponent({}).exponent, 0);
}

}  // namespace
