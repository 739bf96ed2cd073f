// SPDX-License-Identifier: MIT
#include "quest/simulated_observer.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "quest/random.h"

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

quest::SimulatedObserver carelessYesNoObserver() {
    return {.threshold = -0.5,
            .criterion = 0.5,
            .beta = 3,
            .response = {.gamma = 0.1, .lapse = 0.05, .lapseGuess = 0.4}};
}

TEST(SimulatedObserver, AnswersAsOftenAsTheCurveSays) {
    std::mt19937_64 rng(11);
    const auto observer = carelessYesNoObserver();
    const int n = 40000;
    for (const std::optional<double> x :
         {std::optional<double>(), std::optional(-0.8), std::optional(-0.5), std::optional(0.3)}) {
        int yes = 0;
        for (int i = 0; i < n; ++i) yes += quest::answer(observer, x, rng);
        const double p = quest::yesProbability(observer, x);
        // 4 standard errors: a false alarm for one seed in 4,000.
        EXPECT_NEAR(double(yes) / n, p, 4 * std::sqrt(p * (1 - p) / n));
    }
}

TEST(SimulatedObserver, ThresholdLapsesAndFalseAlarmsAreWhereTheyWereSet) {
    const auto observer = carelessYesNoObserver();
    EXPECT_NEAR(quest::yesProbability(observer, -0.5), 0.05 * 0.4 + 0.95 * (0.1 + 0.9 * 0.5),
                1e-15);
    EXPECT_NEAR(quest::yesProbability(observer, std::nullopt), 0.05 * 0.4 + 0.95 * 0.1, 1e-15);
    EXPECT_EQ(quest::yesProbability(observer, -kInf),
              quest::yesProbability(observer, std::nullopt));
    EXPECT_NEAR(quest::yesProbability(observer, kInf), 0.05 * 0.4 + 0.95, 1e-15);
}

TEST(SimulatedObserver, DefaultIs82PercentCorrectAtThePublishedSlope) {
    const double p = quest::yesProbability({}, quest::strength(1, 3.47));
    EXPECT_NEAR(p, 0.82, 1e-12);
}

TEST(SimulatedObserver, MakesOneEngineCallPerAnswer) {
    std::mt19937_64 answered(5), skipped(5);
    for (int i = 0; i < 100; ++i) {
        quest::answer({}, i % 3 == 0 ? std::nullopt : std::optional(-0.01 * i), answered);
    }
    skipped.discard(100);
    EXPECT_EQ(answered, skipped);
}

TEST(SimulatedObserver, RefusesNanAndUnusableParameters) {
    std::mt19937_64 rng(1);
    EXPECT_THROW(quest::answer({}, kNan, rng), std::invalid_argument);
    EXPECT_EQ(rng, std::mt19937_64(1)) << "a refused call draws nothing";
    EXPECT_THAT(quest::validate(quest::SimulatedObserver{.threshold = kInf}),
                testing::HasSubstr("threshold is inf"));
    EXPECT_THAT(quest::validate(quest::SimulatedObserver{.criterion = 1}),
                testing::HasSubstr("criterion is 1"));
    EXPECT_THAT(quest::validate(quest::SimulatedObserver{.beta = 0}),
                testing::HasSubstr("beta is 0"));
    EXPECT_THAT(quest::validate(quest::SimulatedObserver{.response = {.gamma = -0.1}}),
                testing::HasSubstr("gamma is -0.1"));
}

// The C++ standard fixes the engine; what is made of it must not depend on the library either.
TEST(Random, DrawsAreTheSameEverywhere) {
    std::mt19937_64 rng(5489);
    EXPECT_EQ(quest::uniform01(rng), double(14514284786278117030ull >> 11) * 0x1p-53);
    std::mt19937_64 other(5489);
    other.discard(9999);
    EXPECT_EQ(other(), 9981545732273789042ull);
}

TEST(Random, UniformAndNormalHaveTheirMoments) {
    std::mt19937_64 rng(3);
    const int n = 100000;
    double uniform = 0, first = 0, second = 0, fourth = 0;
    std::array<int, 7> hits{};
    for (int i = 0; i < n; ++i) {
        const double u = quest::uniform01(rng), z = quest::standardNormal(rng);
        ASSERT_TRUE(u >= 0 && u < 1 && std::isfinite(z));
        uniform += u, first += z, second += z * z, fourth += z * z * z * z;
        ++hits.at(quest::uniformBelow(rng, 7));
    }
    // 4 standard errors each: sd of u .289, of z 1, of z^2 1.41, of z^4 sqrt(96), of a count
    // sqrt(n 6) / 7. A false alarm in about one seed of 500 over all eleven.
    const double root = std::sqrt(double(n));
    EXPECT_NEAR(uniform / n, 0.5, 4 * 0.289 / root);
    EXPECT_NEAR(first / n, 0, 4 / root);
    EXPECT_NEAR(second / n, 1, 4 * 1.41 / root);
    EXPECT_NEAR(fourth / n, 3, 4 * 9.8 / root);
    for (const int count : hits) EXPECT_NEAR(count, n / 7.0, 4 * std::sqrt(n * 6.0) / 7);
}

}  // namespace
