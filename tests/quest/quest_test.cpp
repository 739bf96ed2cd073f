// SPDX-License-Identifier: MIT
#include "quest/quest.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "quest/random.h"
#include "quest/simulated_observer.h"
#include "tests/quest/slow_quest.h"

namespace {

using quest::Quest;
using quest::QuestParameters;
using quest::QuestWarning;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

std::vector<QuestParameters> variedParameters() {
    QuestParameters vague = quest::kPaperParameters, coarse = vague, tight = vague, odd = vague,
                    replaced = vague, noLapse = vague;
    vague.priorSd = 2;
    coarse.grain = 0.05;
    coarse.range = 3.05;  // 61 steps: 62 intervals
    tight.priorSd = 0.01;
    odd.priorMean = 1.2345;
    odd.grain = 0.013;
    odd.range = 2.7;
    odd.beta = 1.7;
    odd.delta = 0.07;
    replaced.gamma = 0.9;
    noLapse.delta = 0;
    return {quest::kPaperParameters,
            quest::kDefaultParameters,
            quest::forYesNo(quest::kDefaultParameters, 0.05),
            quest::forYesNo(quest::kPaperParameters, 0),
            vague,
            coarse,
            tight,
            odd,
            replaced,
            noLapse};
}

/// Strengths around the guess, some of them outside the table.
double someStrength(const QuestParameters& p, std::mt19937_64& rng) {
    return p.priorMean + (quest::uniform01(rng) < 0.1 ? 4 : 0.5) * quest::standardNormal(rng);
}

double sum(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

// The first trials of the paper's set, by the slow reference: quantile order and offset are
// functions of the curve's ends and table alone.
TEST(Quest, QuantileOrderAndThresholdFollowTheCurve) {
    const Quest staircase(quest::kPaperParameters);
    EXPECT_NEAR(staircase.quantileOrder(), 0.590, 0.001) << ".60 is the limit for pL = .5, pH = 1";
    QuestParameters limit = quest::kPaperParameters;
    limit.delta = 0;
    EXPECT_NEAR(Quest(limit).quantileOrder(), 0.6, 1e-9);
    EXPECT_NEAR(Quest(quest::forYesNo(quest::kPaperParameters, 0)).quantileOrder(), 0.5, 0.02);
    EXPECT_EQ(staircase.pdf().size(), 501u);
    EXPECT_NEAR(staircase.mean(), -std::log10(3.0), 1e-12);
    EXPECT_NEAR(staircase.sd(), 0.3, 1e-9);
}

TEST(Quest, AgreesWithTheSlowReferenceTrialByTrial) {
    for (const QuestParameters& p : variedParameters()) {
        std::mt19937_64 rng(42);
        Quest fast(p);
        slow::Quest reference(p);
        ASSERT_EQ(fast.pdf().size(), reference.pdf.size());
        EXPECT_NEAR(fast.quantileOrder(), reference.order, 1e-12);
        for (int trial = 0; trial < 120; ++trial) {
            // Answers mostly as a matched observer's at the guess would be, so that no reference
            // value underflows; x includes exact half steps of the grid.
            double x = trial % 3 == 0 ? fast.quantile() : someStrength(p, rng);
            if (trial % 7 == 0)
                x = p.priorMean + (trial % 2 ? -1 : 1) * (trial % 5 + 0.5) * p.grain;
            const bool likelyYes = x > p.priorMean - 0.1;
            const int response = quest::uniform01(rng) < 0.9 ? likelyYes : !likelyYes;
            if (p.delta == 0 && response == 0 && x > p.priorMean) continue;
            fast.update(x, response);
            reference.update(x, response);
            // 1e-11: rounding of sums in another order, times 120 normalisations.
            for (std::size_t j = 0; j < reference.pdf.size(); ++j) {
                ASSERT_NEAR(fast.pdf()[j], reference.pdf[j], 1e-11) << "trial " << trial;
            }
            ASSERT_NEAR(fast.mean(), reference.mean(), 1e-9);
            ASSERT_NEAR(fast.sd(), reference.sd(), 1e-9);
            for (const double order : {0.025, 0.31, 0.5, reference.order, 0.975}) {
                ASSERT_NEAR(fast.quantile(order), reference.quantile(order), 1e-8);
            }
        }
    }
}

TEST(Quest, OffsetIsTheTablesInterpolationAndNotTheClosedForm) {
    // The closed form differs by about 4e-6 at grain .01; a single certain trial tells them apart
    // through the posterior.
    const slow::Quest reference(quest::kPaperParameters);
    const double closed = quest::criterionOffset(quest::kPaperCriterion, 3.5);
    EXPECT_NEAR(std::abs(reference.eps - closed), 4e-6, 2e-6);
    Quest fast(quest::kPaperParameters);
    slow::Quest tabled = reference;
    fast.update(-0.4, 0);
    tabled.update(-0.4, 0);
    for (std::size_t j = 0; j < 501; ++j) EXPECT_NEAR(fast.pdf()[j], tabled.pdf[j], 1e-15);
}

TEST(Quest, PosteriorSumsToOneAndStaysFinite) {
    for (const QuestParameters& p : variedParameters()) {
        std::mt19937_64 rng(1);
        Quest staircase(p);
        for (int trial = 0; trial < 300; ++trial) {
            staircase.update(someStrength(p, rng), quest::uniform01(rng) < 0.7 ? 1 : 0);
            ASSERT_NEAR(sum(staircase.pdf()), 1, 1e-12);
            ASSERT_TRUE(std::isfinite(staircase.quantile()) && std::isfinite(staircase.sd()));
            ASSERT_GE(staircase.mean(), staircase.candidate(0));
            ASSERT_LE(staircase.mean(), staircase.candidate(staircase.pdf().size() - 1));
        }
    }
}

TEST(Quest, TrialsCommute) {
    for (const QuestParameters& p : variedParameters()) {
        std::mt19937_64 rng(9);
        std::vector<quest::QuestTrial> trials;
        for (int i = 0; i < 30; ++i) {
            // Near the guess, where even without lapses no answer is impossible.
            trials.push_back({p.priorMean + 0.02 * quest::standardNormal(rng), i % 4 != 0});
        }
        Quest forward(p), backward(p);
        for (auto t = trials.begin(); t != trials.end(); ++t) forward.update(t->x, t->response);
        for (auto t = trials.rbegin(); t != trials.rend(); ++t) backward.update(t->x, t->response);
        for (std::size_t j = 0; j < forward.pdf().size(); ++j) {
            EXPECT_NEAR(forward.pdf()[j], backward.pdf()[j], 1e-13);
        }
    }
}

TEST(Quest, MovingTheGuessMovesEverything) {
    for (QuestParameters p : variedParameters()) {
        p.priorMean = 0;
        QuestParameters moved = p;
        moved.priorMean = 3.25;  // exact in binary, so that x - g is the same number
        Quest here(p), there(moved);
        std::mt19937_64 rng(4);
        for (int i = 0; i < 50; ++i) {
            const double x = std::ldexp(std::round(std::ldexp(someStrength(p, rng), 20)), -20);
            const int response = x > 0 || i % 2 == 0;
            here.update(x, response);
            there.update(x + 3.25, response);
            ASSERT_NEAR(there.quantile() - 3.25, here.quantile(), 1e-12);
            ASSERT_NEAR(there.mean() - 3.25, here.mean(), 1e-12);
            ASSERT_NEAR(there.sd(), here.sd(), 1e-12);
        }
    }
}

TEST(Quest, YesLowersTheThresholdAndNoRaisesIt) {
    for (const QuestParameters& p : variedParameters()) {
        for (const double step : {-0.3, 0.0, 0.3}) {
            const Quest prior(p);
            Quest yes = prior, no = prior;
            yes.update(p.priorMean + step, 1);
            no.update(p.priorMean + step, 0);
            EXPECT_LT(yes.mean(), prior.mean() + 1e-12);
            EXPECT_GT(no.mean(), prior.mean() - 1e-12);
        }
    }
}

// On the average over answers drawn from the model itself, and nearly always over a long run.
TEST(Quest, SdShrinksWithTrials) {
    for (const QuestParameters& p : {quest::kPaperParameters, quest::kDefaultParameters,
                                     quest::forYesNo(quest::kDefaultParameters, 0.05)}) {
        std::mt19937_64 rng(2);
        const quest::SimulatedObserver observer{.threshold = p.priorMean,
                                                .response = {.gamma = p.gamma, .lapse = p.delta}};
        Quest staircase(p);
        double last = staircase.sd();
        for (const int trials : {25, 100, 400, 1600}) {
            while (staircase.history().size() < std::size_t(trials)) {
                const double x = staircase.quantile();
                staircase.update(x, quest::answer(observer, x, rng) ? 1 : 0);
            }
            EXPECT_LT(staircase.sd(), 0.75 * last);
            last = staircase.sd();
        }
    }
}

TEST(Quest, YesNoPlacesTrialsWhereTheyTellMost) {
    const QuestParameters p = quest::forYesNo(quest::kDefaultParameters, 0.04);
    EXPECT_NEAR(quest::criterion(p), quest::kPaperCriterion, 1e-12);
    EXPECT_GT(p.pThreshold, 0.6);
    EXPECT_LT(p.pThreshold, 0.8);
    std::mt19937_64 rng(8);
    const quest::SimulatedObserver observer{
        .threshold = -0.6, .response = {.gamma = 0.04, .lapse = 0.02, .lapseGuess = 0.04}};
    Quest staircase(p);
    int seen = 0;
    for (int trial = 0; trial < 400; ++trial) {
        const double x = staircase.quantile();
        const bool yes = quest::answer(observer, x, rng);
        if (trial >= 100) seen += yes;
        staircase.update(x, yes ? 1 : 0);
    }
    // sd of the share is .027 over 300 trials.
    EXPECT_GT(seen / 300.0, 0.55);
    EXPECT_LT(seen / 300.0, 0.85);
}

TEST(Quest, RoundsTiesAwayFromZero) {
    QuestParameters p = quest::kPaperParameters;
    p.priorMean = 0;
    p.grain = 0.125;  // exact in binary, so that half steps are exact
    p.range = 8.0;
    for (const auto& [half, whole] :
         {std::pair(2.5, 3.0), {3.5, 4.0}, {-2.5, -3.0}, {-3.5, -4.0}}) {
        Quest tie(p), rounded(p);
        tie.update(half * p.grain, 1);
        rounded.update(whole * p.grain, 1);
        EXPECT_THAT(tie.pdf(), testing::ElementsAreArray(rounded.pdf())) << half;
    }
}

TEST(Quest, OutOfRangeUsesTheEndAndSaysSo) {
    const QuestParameters p = quest::kPaperParameters;
    for (const double side : {-1.0, 1.0}) {
        Quest far(p), end(p);
        const double x = p.priorMean + side * 1e300;
        far.update(x, 1);
        end.update(p.priorMean + side * 2.5, 1);
        EXPECT_THAT(far.pdf(), testing::ElementsAreArray(end.pdf()));
        EXPECT_TRUE(end.warnings().empty());
        ASSERT_EQ(far.warnings().size(), 1u);
        EXPECT_EQ(far.warnings()[0].kind, QuestWarning::Kind::outOfRange);
        EXPECT_EQ(far.warnings()[0].trial, 1u);
        EXPECT_EQ(far.warnings()[0].value, x);
        EXPECT_EQ(far.history()[0].x, x) << "the history keeps what was shown";
        EXPECT_THAT(quest::toSentence(far.warnings()[0]), HasSubstr("trial 1"));
        EXPECT_THAT(quest::toSentence(far.warnings()[0]), HasSubstr("1e+300"));
    }
}

TEST(Quest, GammaAboveTheThresholdIsReplacedAndSaysSo) {
    QuestParameters p = quest::kPaperParameters;
    p.gamma = 0.9;
    Quest replaced(p), usual(quest::kPaperParameters);
    ASSERT_EQ(replaced.warnings().size(), 1u);
    EXPECT_EQ(quest::toSentence(replaced.warnings()[0]),
              "gamma is 0.9: above pThreshold, 0.5 is used instead");
    EXPECT_NEAR(quest::criterion(p), quest::kPaperCriterion, 1e-15);
    replaced.update(-0.3, 0);
    usual.update(-0.3, 0);
    EXPECT_THAT(replaced.pdf(), testing::ElementsAreArray(usual.pdf()));
}

TEST(Quest, AnImpossibleAnswerIsKeptOutOfThePosteriorAndSaysSo) {
    QuestParameters p = quest::kPaperParameters;
    p.delta = 0;
    p.priorSd = 0.01;
    Quest sure(p);
    const std::vector<double> before(sure.pdf().begin(), sure.pdf().end());
    // All prior mass lies within .4 of the guess, and -ln P(no) passes 745, beyond which exp() is
    // 0, .8 log units above a threshold.
    sure.update(p.priorMean + 2.4, 0);
    EXPECT_EQ(sure.quantile(), Quest(p).quantile());
    EXPECT_THAT(sure.pdf(), testing::ElementsAreArray(before));
    ASSERT_EQ(sure.warnings().size(), 1u);
    EXPECT_EQ(sure.warnings()[0].kind, QuestWarning::Kind::impossibleResponse);
    EXPECT_THAT(quest::toSentence(sure.warnings()[0]), HasSubstr("delta > 0"));
    EXPECT_EQ(sure.history().size(), 1u);
    sure.update(p.priorMean, 1);
    EXPECT_NEAR(sum(sure.pdf()), 1, 1e-12);
}

TEST(Quest, TenThousandTrialsDoNotUnderflow) {
    QuestParameters p = quest::kPaperParameters;
    p.priorSd = 2;
    std::mt19937_64 rng(77);
    const quest::SimulatedObserver observer{.threshold = -0.2};
    Quest staircase(p);
    // The same posterior in logarithms, which cannot underflow.
    const slow::Quest table(p);
    std::vector<double> logPdf;
    for (const double v : table.pdf) logPdf.push_back(std::log(v));
    for (int trial = 0; trial < 10000; ++trial) {
        const double x = staircase.quantile();
        const int response = quest::answer(observer, x, rng) ? 1 : 0;
        staircase.update(x, response);
        const long k = std::lround((x - p.priorMean) / p.grain);
        for (long j = 0; j <= 500; ++j) {
            const double yes = table.curve[std::size_t(500 + k - (j - 250))];
            logPdf[std::size_t(j)] += std::log(response == 1 ? yes : 1 - yes);
        }
    }
    const double largest = *std::max_element(logPdf.begin(), logPdf.end());
    double total = 0;
    for (double& v : logPdf) total += v = std::exp(v - largest);
    // 1e-9: 10,000 roundings of 1e-16 each, relative, grow to 1e-12.
    for (std::size_t j = 0; j < 501; ++j) EXPECT_NEAR(staircase.pdf()[j], logPdf[j] / total, 1e-9);
    for (const double v : staircase.pdf()) {
        EXPECT_TRUE(v == 0 || v > 1e-300) << "a denormal number would stick, and slow every trial";
    }
    EXPECT_TRUE(staircase.warnings().empty());
    EXPECT_NEAR(staircase.mean(), -0.2, 0.015);  // 5 sd of .0375 sqrt(40 / 10000)
}

TEST(Quest, TwoPassSdHoldsFarFromZero) {
    QuestParameters p = quest::kPaperParameters;
    Quest near(p);
    p.priorMean = 1e6;
    Quest far(p);
    for (int i = 0; i < 400; ++i) {
        near.update(near.parameters().priorMean, i % 5 != 0);
        far.update(far.parameters().priorMean, i % 5 != 0);
    }
    // E[x^2] - E[x]^2 would have lost every digit at 1e12.
    EXPECT_NEAR(far.sd() / near.sd(), 1, 1e-6);
}

TEST(Quest, ReplayGivesTheSameBits) {
    for (const QuestParameters& p : variedParameters()) {
        std::mt19937_64 rng(13);
        Quest original(p);
        for (int i = 0; i < 60; ++i)
            original.update(original.quantile(), quest::uniform01(rng) < 0.8);
        Quest replayed(original.parameters());
        for (const quest::QuestTrial& t : original.history()) replayed.update(t.x, t.response);
        EXPECT_THAT(replayed.pdf(), testing::ElementsAreArray(original.pdf()));
        EXPECT_EQ(replayed.quantile(), original.quantile());
        EXPECT_EQ(replayed.mean(), original.mean());
        EXPECT_EQ(replayed.sd(), original.sd());
    }
}

TEST(Quest, QuantilesRiseWithTheirOrderFromEndToEnd) {
    for (const QuestParameters& p : variedParameters()) {
        Quest staircase(p);
        for (int i = 0; i < 20; ++i) staircase.update(p.priorMean + 0.01 * i, i % 3 != 0);
        double last = staircase.quantile(0);
        EXPECT_EQ(last, staircase.candidate(0));
        for (double order = 0.005; order < 1; order += 0.005) {
            EXPECT_GE(staircase.quantile(order), last);
            last = staircase.quantile(order);
        }
        EXPECT_GE(staircase.quantile(1), last);
        EXPECT_LE(staircase.quantile(1), staircase.candidate(staircase.pdf().size() - 1));
    }
}

TEST(Quest, QuantilesInterpolateOnlyBetweenPointsWhereTheSumRises) {
    // The narrowest prior allowed: 1, and 1e-87 beside it; the next is 0 in double.
    QuestParameters p = quest::kPaperParameters;
    p.priorSd = p.grain / 20;
    const Quest staircase(p);
    const slow::Quest reference(p);
    for (const double order : {1e-90, 1e-88, 1e-80, 1e-9, 0.3, 0.999}) {
        EXPECT_NEAR(staircase.quantile(order), reference.quantile(order), 1e-9) << order;
    }
    EXPECT_LT(staircase.quantile(1e-90), staircase.candidate(1));
}

TEST(Quest, RefusesWhatIsNoTrial) {
    Quest staircase(quest::kPaperParameters);
    const std::vector<double> before(staircase.pdf().begin(), staircase.pdf().end());
    const auto complaint = [&](double x, int response) -> std::string {
        try {
            staircase.update(x, response);
        } catch (const std::invalid_argument& e) {
            return e.what();
        }
        return "nothing thrown";
    };
    EXPECT_EQ(complaint(kNan, 1), "QUEST: x is nan: must be finite");
    EXPECT_EQ(complaint(kInf, 1), "QUEST: x is inf: must be finite");
    EXPECT_EQ(complaint(-kInf, 0), "QUEST: x is -inf: must be finite");
    EXPECT_EQ(complaint(-0.4, 2), "QUEST: response is 2: must be 0 or 1");
    EXPECT_EQ(complaint(-0.4, -1), "QUEST: response is -1: must be 0 or 1");
    EXPECT_TRUE(staircase.history().empty());
    EXPECT_THAT(staircase.pdf(), testing::ElementsAreArray(before));
    for (const double order : {kNan, -0.1, 1.1}) {
        EXPECT_THROW(staircase.quantile(order), std::invalid_argument);
    }
}

TEST(Quest, RefusesUnusableParametersByNameValueAndRule) {
    struct Case {
        std::function<void(QuestParameters&)> spoil;
        std::string says;
    };
    const std::vector<Case> cases{
        {[](auto& p) { p.priorMean = kNan; }, "priorMean is nan: must be finite"},
        {[](auto& p) { p.priorMean = kInf; }, "priorMean is inf: must be finite"},
        {[](auto& p) { p.priorSd = 0; }, "priorSd is 0: must be finite and greater than 0"},
        {[](auto& p) { p.priorSd = -0.3; }, "priorSd is -0.3"},
        {[](auto& p) { p.priorSd = kNan; }, "priorSd is nan"},
        {[](auto& p) { p.priorSd = kInf; }, "priorSd is inf"},
        {[](auto& p) { p.priorSd = 1e-4; }, "at least a twentieth of grain"},
        {[](auto& p) { p.beta = 0; }, "beta is 0"},
        {[](auto& p) { p.beta = -3.5; }, "beta is -3.5"},
        {[](auto& p) { p.beta = kNan; }, "beta is nan"},
        {[](auto& p) { p.grain = 0; }, "grain is 0"},
        {[](auto& p) { p.grain = -0.01; }, "grain is -0.01"},
        {[](auto& p) { p.grain = kInf; }, "grain is inf"},
        {[](auto& p) { p.range = 0.0; }, "range is 0"},
        {[](auto& p) { p.range = kNan; }, "range is nan"},
        {[](auto& p) { p.range = 1e5; }, "at most 1000000 intervals"},
        {[](auto& p) { p.range = 1e9; }, "range is 1000000000: must be within 1000000 log10"},
        {[](auto& p) { p.grain = p.priorSd = 1e308; }, "grain is 1e+308: must be within"},
        {[](auto& p) { p.priorMean = -1e300; }, "priorMean is -1e+300: must be within"},
        {[](auto& p) { p.grain = 1e-300, p.range = 1e5; }, "at most 1000000 intervals"},
        {[](auto& p) { p.pThreshold = 1.2; }, "pThreshold is 1.2: must be a probability in [0, 1]"},
        {[](auto& p) { p.pThreshold = kNan; }, "pThreshold is nan"},
        {[](auto& p) { p.delta = -0.01; }, "delta is -0.01: must be a probability in [0, 1]"},
        {[](auto& p) { p.delta = 1.01; }, "delta is 1.01"},
        {[](auto& p) { p.gamma = -0.5; }, "gamma is -0.5: must be a probability in [0, 1]"},
        {[](auto& p) { p.gamma = 2; }, "gamma is 2"},
        {[](auto& p) { p.pThreshold = 0.999; }, "pThreshold is 0.999: must lie inside the curve"},
        {[](auto& p) { p.pThreshold = 0.3; }, "pThreshold is 0.3: must lie inside the curve"},
        {[](auto& p) { p.pThreshold = p.gamma = 0.5; }, "pThreshold is 0.5: must lie inside"},
        {[](auto& p) { p.delta = 1; }, "must lie inside the curve"},
        {[](auto& p) { p.range = 0.02, p.pThreshold = 0.9; }, "must lie inside the curve"},
    };
    for (const Case& c : cases) {
        QuestParameters p = quest::kPaperParameters;
        c.spoil(p);
        EXPECT_THAT(quest::validate(p), HasSubstr(c.says));
        try {
            Quest staircase(p);
            ADD_FAILURE() << "accepted although " << c.says;
        } catch (const std::invalid_argument& e) {
            EXPECT_THAT(e.what(), HasSubstr(c.says));
        }
    }
}

TEST(Quest, EveryPresetWorksInBothTasksAtThePapersCriterion) {
    for (const quest::QuestPreset& preset : quest::kPresets) {
        EXPECT_EQ(quest::presetNamed(preset.name), preset.parameters);
        EXPECT_EQ(quest::validate(preset.parameters), "");
        EXPECT_NEAR(quest::criterion(preset.parameters), quest::kPaperCriterion, 1e-12);
        for (const double falseAlarms : {0.0, 0.05, 0.2}) {
            const QuestParameters yesNo = quest::forYesNo(preset.parameters, falseAlarms);
            EXPECT_EQ(quest::validate(yesNo), "");
            EXPECT_NEAR(quest::criterion(yesNo), quest::kPaperCriterion, 1e-12);
        }
    }
    EXPECT_EQ(quest::presetNamed("no such"), std::nullopt);
}

}  // namespace
