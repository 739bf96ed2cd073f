// SPDX-License-Identifier: MIT
#include "quest/observer_screening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace quest {
namespace {

double atLeast(int events, int n, double p) {
    double sum = 0;
    for (int k = events; k <= n; ++k) {
        sum += std::exp(std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1) +
                        k * std::log(p) + (n - k) * std::log1p(-p));
    }
    return sum;
}

TEST(ObserverScreening, LowerBoundIsTheRateAtWhichSoManyEventsHaveProbabilityFivePercent) {
    const std::vector<std::pair<int, int>> seen{
        {14, 77}, {1, 9}, {8, 9}, {300, 5000}, {4990, 5000}};
    for (const auto& [events, n] : seen) {
        EXPECT_NEAR(atLeast(events, n, rateLowerBound(events, n)), 0.05, 1e-9)
            << events;  // lgamma rounds there
    }
    EXPECT_EQ(rateLowerBound(0, 77), 0);
    EXPECT_EQ(rateLowerBound(0, 0), 0);
    EXPECT_NEAR(rateLowerBound(5, 5), std::pow(0.05, 0.2), 1e-12);
}

// 3 of 12: Clopper and Pearson's 7.2 %; 4 of 12: 12.3 %.
TEST(ObserverScreening, LeavesOutWhoseFalseAlarmsCannotBeChance) {
    EXPECT_EQ(falseAlarmProblem(3, 12, {}), "");
    EXPECT_EQ(falseAlarmProblem(4, 12, {}),
              "4 false alarms in 12 reference trials: lower 95 % bound 12.3 %, limit 10 %");
    EXPECT_EQ(falseAlarmProblem(4, 12, {.falseAlarmRate = 0.2}), "");
    EXPECT_NE(falseAlarmProblem(0, 0, {}), "");
}

TEST(ObserverScreening, LeavesOutWhoMissesMoreThanAFifthOfWhatNobodyOverlooks) {
    EXPECT_EQ(catchProblem(2, 10, {}), "");
    EXPECT_EQ(catchProblem(3, 10, {}), "3 of 10 catch trials failed, limit 20 %");
    EXPECT_EQ(catchProblem(0, 0, {}), "");
}

}  // namespace
}  // namespace quest
