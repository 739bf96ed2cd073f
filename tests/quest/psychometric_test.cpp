// SPDX-License-Identifier: MIT
#include "quest/psychometric.h"

#include <ceres/jet.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <limits>

namespace {

using quest::kPaperCriterion;
using quest::ResponseModel;

constexpr std::array<ResponseModel, 6> kModels{{
    {.gamma = 0.5, .lapse = 0.01, .lapseGuess = 0.5},
    {.gamma = 0.5, .lapse = 0.15, .lapseGuess = 0.5},
    {.gamma = 0.06, .lapse = 0.02, .lapseGuess = 0.3},
    {.gamma = 0, .lapse = 0.02, .lapseGuess = 1},
    {.gamma = 0, .lapse = 0, .lapseGuess = 0},
    {.gamma = 0.5, .lapse = 0, .lapseGuess = 0.5},
}};

TEST(Psychometric, ThresholdIsWhereDetectionReachesTheCriterion) {
    for (const double criterion : {0.01, 0.1, kPaperCriterion, 0.9, 0.999}) {
        for (const double beta : {0.5, 2.0, 3.5, 12.0}) {
            EXPECT_NEAR(quest::detectionProbability(0.0, beta, criterion), criterion, 1e-14);
        }
    }
}

TEST(Psychometric, PaperCriterionIs82PercentCorrect) {
    EXPECT_NEAR(quest::responseProbability(kPaperCriterion, kModels[0]), 0.82, 1e-15);
    EXPECT_NEAR(kPaperCriterion, 0.6465, 5e-5);
}

TEST(Psychometric, RadiusFollowsTheCriterion) {
    // At the radius for criterion F, an observer whose c holds at F* detects with probability F.
    const double c = 3.47, beta = 3.5;
    const double hidden = c * quest::slopeFactor(kPaperCriterion, 0.10, beta);
    EXPECT_NEAR(hidden / c, 1.92, 0.005);
    const double x = quest::strength(1.0, hidden), x0 = quest::strength(1.0, c);
    EXPECT_NEAR(quest::detectionProbability(x - x0, beta, kPaperCriterion), 0.10, 1e-14);
}

TEST(Psychometric, StrengthFallsWithRadiusAndInverts) {
    EXPECT_GT(quest::strength(10, 25), quest::strength(10, 26));
    EXPECT_NEAR(quest::radiusAt(10, quest::strength(10, 34.7)), 34.7, 1e-12);
    EXPECT_NEAR(quest::radiusAt(1, -0.5403294747908737), 3.47, 1e-12);
}

// In long double and by the textbook; good to 1e-17 where P is not next to 0 or 1.
long double directYes(double x, double beta, const ResponseModel& m) {
    const long double hazard =
        -std::log1p((long double)-kPaperCriterion) * std::pow(10.0L, (long double)beta * x);
    return (long double)m.lapse * m.lapseGuess +
           (1 - (long double)m.lapse) *
               (m.gamma + (1 - (long double)m.gamma) * -std::expm1(-hazard));
}

TEST(Psychometric, LogarithmsAgreeWithTheDirectFormula) {
    for (const ResponseModel& model : kModels) {
        for (double x = -1; x < 0.4; x += 0.01) {
            const long double yes = directYes(x, 3.5, model);
            if (yes <= 0 || yes >= 1 - 1e-6L) continue;
            // 1e-11: the direct 1 - yes loses six digits of long double's 19.
            EXPECT_NEAR(quest::logYes(x, 3.5, kPaperCriterion, model), (double)std::log(yes),
                        1e-11);
            EXPECT_NEAR(quest::logNo(x, 3.5, kPaperCriterion, model), (double)std::log1p(-yes),
                        1e-11 * (1 + (double)-std::log1p(-yes)));
        }
    }
}

TEST(Psychometric, YesAndNoAddUpToOneEverywhere) {
    for (const ResponseModel& model : kModels) {
        for (double x = -120; x < 80; x += 0.37) {
            EXPECT_NEAR(std::exp(quest::logYes(x, 3.5, kPaperCriterion, model)) +
                            std::exp(quest::logNo(x, 3.5, kPaperCriterion, model)),
                        1, 1e-15);
        }
    }
}

TEST(Psychometric, LogarithmsKeepTheirDigitsInTheTails) {
    const ResponseModel pure{.gamma = 0, .lapse = 0, .lapseGuess = 0};
    const double beta = 3.5;
    for (const double x : {-100.0, -30.0, -9.0, -4.0}) {
        // F = h (1 - h/2 ...) and h is far below 1e-13 there.
        const double logHazard = std::log(quest::detectionHazard(0.0, beta, kPaperCriterion)) +
                                 std::log(10.0) * beta * x;
        EXPECT_NEAR(quest::logYes(x, beta, kPaperCriterion, pure) / logHazard, 1, 1e-14);
        // log1p(-F) = -h to all digits where 1 - F rounds to 1.
        const double h = std::exp(logHazard);
        if (h > 0) {
            EXPECT_NEAR(quest::logNo(x, beta, kPaperCriterion, pure) / -h, 1, 1e-12);
        }
    }
    for (const double x : {1.0, 2.0, 20.0}) {
        const double h = quest::detectionHazard(x, beta, kPaperCriterion);
        EXPECT_NEAR(quest::logNo(x, beta, kPaperCriterion, pure) / -h, 1, 1e-14);
        EXPECT_LE(quest::logYes(x, beta, kPaperCriterion, pure), 0);
    }
}

TEST(Psychometric, LogarithmsAreContinuousWhereTheirFormChanges) {
    const double beta = 3.5;
    const double eps = quest::criterionOffset(kPaperCriterion, beta);
    for (const ResponseModel& model : kModels) {
        for (const double logHazard : {quest::kLogHazardOfUnderflow, quest::kLogHazardOfTail}) {
            const double x = logHazard / std::log(10.0) / beta - eps;
            for (const auto f : {+[](double at, const ResponseModel&m) {
                                     return quest::logYes(at, 3.5, kPaperCriterion, m);
                                 },
                                 +[](double at, const ResponseModel&m) {
                                     return quest::logNo(at, 3.5, kPaperCriterion, m);
                                 }}) {
                const double below = f(x - 1e-12, model), above = f(x + 1e-12, model);
                EXPECT_NEAR(above, below, 1e-10 * (1e-3 + std::abs(below)));
            }
        }
    }
}

TEST(Psychometric, ImpossibleAnswersHaveMinusInfinity) {
    const ResponseModel alwaysYes{.gamma = 1, .lapse = 0, .lapseGuess = 1};
    const double x = 0.1;
    EXPECT_EQ(quest::logNo(x, 3.5, kPaperCriterion, alwaysYes),
              -std::numeric_limits<double>::infinity());
    EXPECT_EQ(quest::logYes(x, 3.5, kPaperCriterion, alwaysYes), 0);
}

// The contract with the fit: strength, slope, gamma and lapse may all be dual numbers.
TEST(Psychometric, DerivativesByCeresAgreeWithDifferences) {
    using Jet = ceres::Jet<double, 4>;
    const auto evaluate = [](const auto& parameters, bool yes) {
        using T = std::decay_t<decltype(parameters[0])>;
        const quest::ResponseModelOf<T> model{parameters[2], parameters[3], parameters[2]};
        return yes ? quest::logYes(parameters[0], parameters[1], kPaperCriterion, model)
                   : quest::logNo(parameters[0], parameters[1], kPaperCriterion, model);
    };
    for (const double x : {-2.0, -0.6, -0.1, 0.0, 0.2, 0.45, 0.9}) {
        for (const bool yes : {false, true}) {
            const std::array<double, 4> at{x, 3.2, 0.3, 0.04};
            std::array<Jet, 4> dual;
            for (int i = 0; i < 4; ++i) dual[std::size_t(i)] = Jet(at[std::size_t(i)], i);
            const Jet result = evaluate(dual, yes);
            EXPECT_EQ(result.a, evaluate(at, yes));
            for (std::size_t i = 0; i < 4; ++i) {
                auto low = at, high = at;
                const double step = 1e-6;
                low[i] -= step, high[i] += step;
                const double difference = (evaluate(high, yes) - evaluate(low, yes)) / (2 * step);
                // Central difference: step^2 times a third derivative of some thousands, plus
                // rounding 1e-16 / step.
                EXPECT_NEAR(result.v[int(i)], difference, 1e-6 * (1 + std::abs(difference)));
            }
        }
    }
}

TEST(Psychometric, DerivativesStayFiniteFarFromTheData) {
    using Jet = ceres::Jet<double, 2>;
    for (const ResponseModel& model : kModels) {
        for (const double x : {-80.0, -20.0, 20.0, 80.0}) {
            for (const Jet& value :
                 {quest::logYes(Jet(x, 0), Jet(3.5, 1), kPaperCriterion, model),
                  quest::logNo(Jet(x, 0), Jet(3.5, 1), kPaperCriterion, model)}) {
                EXPECT_TRUE(std::isfinite(value.v[0]) && std::isfinite(value.v[1])) << x;
            }
        }
    }
}

TEST(Psychometric, RefusesWhatIsNoProbability) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(quest::validate(ResponseModel{}), "");
    EXPECT_EQ(quest::validate(ResponseModel{.gamma = 1.5}),
              "gamma is 1.5: must be a probability in [0, 1]");
    EXPECT_THAT(quest::validate(ResponseModel{.lapse = 1}), testing::HasSubstr("lapse is 1"));
    EXPECT_THAT(quest::validate(ResponseModel{.lapseGuess = nan}), testing::HasSubstr("nan"));
    EXPECT_EQ(quest::validateCurve(3.5, 0.5), "");
    for (const double bad : {0.0, -1.0, nan}) EXPECT_NE(quest::validateCurve(bad, 0.5), "");
    for (const double bad : {0.0, 1.0, -1.0, nan}) EXPECT_NE(quest::validateCurve(3.5, bad), "");
}

}  // namespace
