// SPDX-License-Identifier: MIT
#include "study_app/simulated_population.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "study_app/session.h"
#include "tests/study_app/test_designs.h"

namespace {

using records::Task;
using records::Trial;
using study_app::Design;
using study_app::Session;
using study_app::SimulatedPopulation;
using testing::HasSubstr;

std::string errorOf(const std::string& text) {
    try {
        study_app::populationFromText(text);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "no error";
}

TEST(SimulatedPopulation, ReadsWhatItWrites) {
    const SimulatedPopulation population{.c = 1.0 / 3, .kappa = 0.8, .lapse = 0, .stair = 0.5};
    EXPECT_EQ(study_app::populationFromText(study_app::toText(population)), population);
    EXPECT_EQ(study_app::populationFromText("simulated"), SimulatedPopulation{});
    EXPECT_EQ(study_app::populationFromText("simulated:c=2,beta=4").c, 2);
}

TEST(SimulatedPopulation, RefusesBadTextWithKeyValueAndRule) {
    EXPECT_THAT(errorOf("human"), HasSubstr("\"human\""));
    EXPECT_THAT(errorOf("simulatedc=2"), HasSubstr("simulated:key=value"));
    EXPECT_THAT(errorOf("simulated:"), HasSubstr("key=value"));
    EXPECT_THAT(errorOf("simulated:c=2,"), HasSubstr("key=value"));
    EXPECT_THAT(errorOf("simulated:slope=2"), HasSubstr("\"slope\""));
    EXPECT_THAT(errorOf("simulated:c=2,c=2"), HasSubstr("c: stands twice"));
    for (const char* value :
         {"", "x", "0", "-1", "nan", "inf", "1e999", "1e300", "2 ", "+2", "2x"}) {
        EXPECT_THAT(errorOf("simulated:c=" + std::string(value)),
                    HasSubstr("must be a number from 0.001 to 1000"))
            << value;
    }
    EXPECT_THAT(errorOf("simulated:lapse=1"), HasSubstr("lapse"));
    EXPECT_THAT(errorOf("simulated:criterion=0"), HasSubstr("criterion"));
    EXPECT_THAT(errorOf("simulated:observer_sd=-0.1"), HasSubstr("observer_sd"));
}

TEST(SimulatedPopulation, EveryKeyIsDescribed) {
    for (const char* key : {"c=3.47", "kappa=1", "criterion=", "beta=3.5",
                            "lapse=", "false_alarms=", "observer_sd=0.1", "condition_sd=0.05",
                            "stair=", "step=1", "line=1", "contrast_exponent="}) {
        EXPECT_THAT(study_app::describeKeys(), HasSubstr(key));
    }
}

TEST(SimulatedPopulation, IsTheLawWhereNothingVaries) {
    Design design = tests::variedDesign(Task::twoAfc);
    const SimulatedPopulation population{.c = 3, .kappa = 0.7, .observerSd = 0, .conditionSd = 0};
    const auto observer = study_app::drawParticipant(population, design, 1);
    const double a0 = std::sqrt(8.0 * 3.0);
    const auto conditions = study_app::conditions(design);
    for (std::size_t k = 0; k < conditions.size(); ++k) {
        const study_app::Condition& c = conditions[k];
        const double factor = c.silhouette.pattern == records::Pattern::stair ? 0.72 : 1;
        const double radius =
            3 * factor * std::pow(c.litLevel, 0.07) * a0 * std::pow(c.artifactPx / a0, 0.7);
        EXPECT_NEAR(study_app::trueSlope(observer, k), radius / c.artifactPx, 1e-13);
    }
}

// Sample sd of n draws: relative standard error 1 / sqrt(2 n); 5 of them, once in 2 million.
TEST(SimulatedPopulation, SpreadsOverObserversAndConditionsAsAsked) {
    const Design design = tests::shippedDesign("quick");
    const SimulatedPopulation population{.stair = 1};
    constexpr int kObservers = 4000;
    double sumU = 0, sumU2 = 0, sumV2 = 0;
    for (std::uint64_t i = 0; i < kObservers; ++i) {
        const auto observer = study_app::drawParticipant(population, design, i);
        double mean = 0;
        for (const double x0 : observer.threshold) mean += -(x0 + std::log10(3.47)) / 4;
        for (const double x0 : observer.threshold) {
            const double v = -(x0 + std::log10(3.47)) - mean;
            sumV2 += v * v;
        }
        sumU += mean;
        sumU2 += mean * mean;
    }
    const double expected = std::sqrt(0.1 * 0.1 + 0.05 * 0.05 / 4);  // of the mean of 4 conditions
    EXPECT_NEAR(sumU / kObservers, 0, 5 * expected / std::sqrt(kObservers));
    EXPECT_NEAR(std::sqrt(sumU2 / kObservers) / expected, 1, 5 / std::sqrt(2.0 * kObservers));
    EXPECT_NEAR(std::sqrt(sumV2 / (3.0 * kObservers)) / 0.05, 1, 5 / std::sqrt(6.0 * kObservers));
}

struct Simulated {
    std::vector<Trial> rows;
    Session session;
    study_app::SimulatedParticipant observer;
};

Simulated simulated(const Design& design, const SimulatedPopulation& population,
                    std::uint64_t seed) {
    Simulated result{
        {}, Session(design, seed), study_app::drawParticipant(population, design, seed)};
    while (!result.session.finished()) {
        const std::optional<Trial> last =
            result.rows.empty() ? std::nullopt : std::optional(result.rows.back());
        result.rows.push_back(result.session.answer(
            study_app::simulatedAnswer(result.observer, result.session, last)));
    }
    return result;
}

TEST(SimulatedAnswers, DependOnSeedAndRowAlone) {
    const Design design = tests::variedDesign(Task::yesNo);
    const auto first = simulated(design, {}, 3), second = simulated(design, {}, 3);
    EXPECT_EQ(first.rows, second.rows);
    EXPECT_NE(first.rows, simulated(design, {}, 4).rows);
}

TEST(SimulatedAnswers, TakeTimeInWholeMillisecondsAndInOrder) {
    const auto rows = simulated(tests::shippedDesign("quick"), {}, 3).rows;
    double last = 0;
    for (const Trial& row : rows) {
        EXPECT_GT(*row.onsetS, last);
        EXPECT_GT(*row.responseTimeS, 0.3);
        EXPECT_EQ(*row.responseTimeS, std::round(*row.responseTimeS * 1000) / 1000);
        last = *row.onsetS + *row.responseTimeS;
    }
}

// Shares of answers against their probabilities: 4.5 standard errors, both together wrong once in
// 70,000 draws of seeds.
TEST(SimulatedAnswers, FalseAlarmsAndCatchFailuresComeAsOftenAsAsked) {
    Design design = tests::variedDesign(Task::yesNo);
    design.catchShare = 0.5;
    design.trialsPerCondition = 60;
    const SimulatedPopulation population{.lapse = 0.1, .falseAlarms = 0.2};
    const auto expectShare = [](const Session& session, double share) {
        const double n = session.catchAnswered();
        EXPECT_GT(n, 1000);
        EXPECT_NEAR(session.catchFailed() / n, share, 4.5 * std::sqrt(share * (1 - share) / n));
    };
    expectShare(simulated(design, population, 1).session, 0.1 * 0.5 + 0.9 * 0.2);
    Design twoAfc = tests::variedDesign(Task::twoAfc);
    twoAfc.catchShare = 0.5;
    twoAfc.trialsPerCondition = 60;
    expectShare(simulated(twoAfc, population, 1).session, 0.1 * 0.5);
}

// Posterior means of 60 sessions x 4 conditions against the truth, in log10 units. One estimate
// spreads by .055 to .08 at 40 trials, so the mean of 240 has a standard error below .0052. Allowed
// are 4.5 of them (wrong once in 150,000 draws of seeds) and .0026 by which the prior pulls towards
// its guess. Three spreads, .24, hold all but a few: 97 % or more.
void expectRecovery(const Design& design, const SimulatedPopulation& population) {
    double sum = 0;
    int n = 0, close = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const Simulated one = simulated(design, population, seed);
        for (std::size_t k = 0; k < one.session.conditions().size(); ++k, ++n) {
            const double error = one.session.staircase(k).mean() - one.observer.threshold[k];
            sum += error;
            close += std::abs(error) < 0.24;
        }
    }
    EXPECT_NEAR(sum / n, 0, 0.026);
    EXPECT_GE(close, 0.97 * n);
}

TEST(SimulatedStudy, StaircasesRecoverTheThresholdIn2afc) {
    Design design = tests::shippedDesign("quick");
    design.trialsPerCondition = 40;
    expectRecovery(design, {});
}

TEST(SimulatedStudy, StaircasesRecoverTheThresholdInYesNo) {
    Design design = tests::shippedDesign("quick");
    design.task = Task::yesNo;
    design.trialsPerCondition = 40;
    design.staircase = quest::forYesNo(quest::kDefaultParameters, study_app::kYesNoGamma);
    expectRecovery(design, {.falseAlarms = 0.05});
}

}  // namespace
