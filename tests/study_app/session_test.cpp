// SPDX-License-Identifier: MIT
#include "study_app/session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "records/trial_table.h"
#include "study_app/simulated_population.h"
#include "tests/study_app/test_designs.h"

namespace {

using records::Response;
using records::Task;
using records::Trial;
using records::TrialStatus;
using records::TrialType;
using study_app::Design;
using study_app::Session;

constexpr std::uint64_t kSeed = 4;

/// A whole session with a simulated observer.
std::vector<Trial> wholeSession(const Design& design, std::uint64_t seed = kSeed) {
    Session session(design, seed);
    const auto observer = study_app::drawParticipant({}, design, seed);
    std::vector<Trial> rows;
    while (!session.finished()) {
        const std::optional<Trial> last = rows.empty() ? std::nullopt : std::optional(rows.back());
        rows.push_back(session.answer(study_app::simulatedAnswer(observer, session, last)));
    }
    return rows;
}

Session replayed(const Design& design, const std::vector<Trial>& rows, std::size_t count) {
    Session session(design, kSeed);
    for (std::size_t i = 0; i < count; ++i) {
        const auto difference = session.replay(rows[i]);
        if (difference) ADD_FAILURE() << "row " << i << ": " << difference->column;
    }
    return session;
}

class BothTasks : public testing::TestWithParam<Task> {
  protected:
    Design design = tests::variedDesign(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Session, BothTasks, testing::Values(Task::twoAfc, Task::yesNo),
                         [](const auto& p) {
                             return p.param == Task::twoAfc ? "TwoAfc" : "YesNo";
                         });

TEST_P(BothTasks, ResumesAnywhereWithTheBitIdenticalNextTrial) {
    const std::vector<Trial> rows = wholeSession(design);
    ASSERT_EQ(rows.size(), static_cast<std::size_t>(study_app::totalTrials(design)));
    for (std::size_t stop = 0; stop <= rows.size(); ++stop) {
        const Session session = replayed(design, rows, stop);
        ASSERT_EQ(session.finished(), stop == rows.size());
        if (session.finished()) break;
        Trial expected = rows[stop];
        expected.response = {};  // next() is everything but the answer
        expected.correct = false;
        expected.responseTimeS = expected.onsetS = expected.thresholdMean = expected.thresholdSd =
            expected.clickXPx = expected.clickYPx = expected.clickDistancePx = {};
        ASSERT_EQ(session.next(), expected) << "after " << stop << " rows";
    }
}

TEST_P(BothTasks, RowsSurviveTheFileWithEveryBit) {
    const std::vector<Trial> rows = wholeSession(design);
    std::string text = records::trialTableHeader() + "\n";
    for (const Trial& row : rows) text += records::trialTableRow(row) + "\n";
    EXPECT_EQ(records::parseTrialTable(text, "sub-01_task-hideartifact_beh.tsv").trials, rows);
}

TEST_P(BothTasks, GivesEveryStaircaseItsTrials) {
    std::map<std::string, int> trials;
    for (const Trial& row : wholeSession(design)) {
        if (row.staircase) ++trials[*row.staircase];
    }
    EXPECT_EQ(trials.size(), 32u);
    for (const auto& [name, count] : trials) EXPECT_EQ(count, 6) << name;
}

TEST_P(BothTasks, UpdatesTheStaircaseWithTheRadiusShownAndPlacesAtTheQuantile) {
    std::map<std::string, quest::Quest> staircases;
    for (const Trial& row : wholeSession(design)) {
        auto& staircase =
            staircases.try_emplace(row.condition, study_app::staircaseParameters(design))
                .first->second;
        if (row.proposedRadiusPx) {
            EXPECT_EQ(*row.proposedRadiusPx, quest::radiusAt(row.artifactPx, staircase.quantile()));
            EXPECT_EQ(row.filterRadiusPx,
                      study_app::shownRadius(*row.proposedRadiusPx, design.radius));
        }
        if (!row.staircase) continue;
        EXPECT_EQ(*row.staircase, row.condition);
        staircase.update(std::log10(row.artifactPx / row.filterRadiusPx), row.correct);
        EXPECT_EQ(*row.thresholdMean, staircase.mean());
        EXPECT_EQ(*row.thresholdSd, staircase.sd());
        EXPECT_TRUE(staircase.warnings().empty());
    }
}

TEST_P(BothTasks, CatchTrialsTouchNoStaircaseAndAreToldApart) {
    int catches = 0;
    for (const Trial& row : wholeSession(design)) {
        if (row.staircase) {
            EXPECT_EQ(row.type, TrialType::artifact);
            continue;
        }
        ++catches;
        EXPECT_FALSE(row.thresholdMean || row.thresholdSd);
        if (GetParam() == Task::twoAfc) {
            EXPECT_EQ(row.type, TrialType::artifact);
            EXPECT_EQ(row.filterRadiusPx, design.radius.min);
            EXPECT_EQ(row.artifactPx, 8);
            EXPECT_FALSE(row.proposedRadiusPx);
        } else {
            EXPECT_EQ(row.type, TrialType::reference);
            EXPECT_TRUE(row.proposedRadiusPx);
            EXPECT_EQ(row.correct, row.response == Response::notSeen);
        }
    }
    EXPECT_EQ(catches, study_app::catchTrials(design));
}

TEST_P(BothTasks, RovesWithinTheRulesAndUsesTheirWholeRange) {
    std::set<int> quarters, shifts, mirrors;
    std::set<std::string> sides;
    for (const Trial& row : wholeSession(design)) {
        EXPECT_LE(2 * std::abs(*row.shiftPx), row.artifactPx);
        if (row.condition.starts_with("step-vertical")) {
            EXPECT_EQ(*row.orientationQuarter % 2, 1);
        }
        const bool tilted = GetParam() == Task::twoAfc && row.pattern == records::Pattern::step;
        EXPECT_EQ(row.tiltDeg.has_value(), tilted);
        if (tilted) {
            EXPECT_LE(std::abs(*row.tiltDeg), *row.angleDeg);
        }
        EXPECT_EQ(row.side.has_value(), GetParam() == Task::twoAfc);
        if (row.side) sides.insert(*row.side);
        if (row.artifactPx == 8) shifts.insert(*row.shiftPx);
        mirrors.insert(*row.mirror);
        if (row.pattern == records::Pattern::stair) quarters.insert(*row.orientationQuarter);
    }
    // Over 48 draws each: all are hit, except once in 4,000 sessions for the 9 shifts over 120.
    EXPECT_EQ(quarters.size(), 4u);
    EXPECT_EQ(mirrors.size(), 2u);
    EXPECT_THAT(shifts, testing::ElementsAre(-4, -3, -2, -1, 0, 1, 2, 3, 4));
    if (GetParam() == Task::twoAfc) {
        EXPECT_THAT(sides, testing::ElementsAre("left", "right"));
    }
}

TEST_P(BothTasks, RovesNothingWhereTheDesignSaysSo) {
    design.roving = {.shift = false, .quarterTurn = false, .mirror = false, .tilt = false};
    for (const Trial& row : wholeSession(design)) {
        EXPECT_EQ(*row.shiftPx, 0);
        EXPECT_EQ(*row.mirror, false);
        EXPECT_EQ(*row.orientationQuarter, row.condition.starts_with("step-vertical") ? 1 : 0);
        EXPECT_EQ(row.tiltDeg.value_or(0), 0);
    }
}

TEST_P(BothTasks, ReplayFindsTheFirstCellThatWasChanged) {
    const std::vector<Trial> rows = wholeSession(design);
    const auto differs = [&](const char* column, auto change) {
        std::size_t k = 20;
        while (!rows[k].staircase) ++k;  // no catch trial
        Session session = replayed(design, rows, k);
        Trial changed = rows[k];
        change(changed);
        const auto difference = session.replay(changed);
        ASSERT_TRUE(difference) << column;
        EXPECT_EQ(difference->column, column);
        EXPECT_EQ(difference->trial, changed.number);
    };
    const auto nextBit = [](double v) { return std::nextafter(v, 1e9); };
    differs("trial", [](Trial& t) { ++t.number; });
    differs("condition", [](Trial& t) { t.condition += "x"; });
    differs("image_seed", [](Trial& t) { *t.imageSeed ^= 1; });
    differs("dither", [](Trial& t) { t.dither = false; });
    differs("kernel", [](Trial& t) { t.kernel = "gaussian"; });
    differs("proposed_radius_px",
            [&](Trial& t) { t.proposedRadiusPx = nextBit(*t.proposedRadiusPx); });
    differs("filter_radius_px", [&](Trial& t) { t.filterRadiusPx = nextBit(t.filterRadiusPx); });
    // Another answer is another history: the thresholds after it do not fit.
    differs("threshold_mean", [](Trial& t) {
        const bool twoAfc = t.task == Task::twoAfc;
        const Response one = twoAfc ? Response::left : Response::seen;
        const Response other = twoAfc ? Response::right : Response::notSeen;
        t.response = t.response == one ? other : one;
        t.correct = !t.correct;
    });
    differs("orientation_quarter",
            [](Trial& t) { t.orientationQuarter = (*t.orientationQuarter + 1) % 4; });
    differs("shift_px", [](Trial& t) { t.shiftPx = 99; });
    differs("staircase", [](Trial& t) { t.staircase.reset(); });
    differs("threshold_mean", [&](Trial& t) { t.thresholdMean = nextBit(*t.thresholdMean); });
    differs("threshold_sd", [&](Trial& t) { t.thresholdSd = nextBit(*t.thresholdSd); });
    const Task otherTask = GetParam() == Task::twoAfc ? Task::yesNo : Task::twoAfc;
    differs("task", [&](Trial& t) { t.task = otherTask; });
}

TEST_P(BothTasks, ReplayRefusesRowsBeyondTheEnd) {
    const std::vector<Trial> rows = wholeSession(design);
    Session session = replayed(design, rows, rows.size());
    Trial beyond = rows.back();
    ++beyond.number;
    EXPECT_EQ(session.replay(beyond).value().column, "trial");
}

TEST_P(BothTasks, AnotherSeedIsFoundAtTheFirstRows) {
    const std::vector<Trial> rows = wholeSession(design);
    Session session(design, kSeed + 1);
    bool differs = false;
    for (std::size_t i = 0; i < 3 && !differs; ++i) differs = session.replay(rows[i]).has_value();
    EXPECT_TRUE(differs);
}

TEST_P(BothTasks, RepeatsTheTrialAfterARowThatIsNotOk) {
    Session session(design, kSeed), untouched(design, kSeed);
    const Response response = GetParam() == Task::twoAfc ? Response::left : Response::seen;
    std::vector<Trial> rows;
    for (const TrialStatus status : {TrialStatus::tooFast, TrialStatus::repeated}) {
        rows.push_back(session.answer({.response = response, .status = status}));
        EXPECT_EQ(rows.back().status, status);
        EXPECT_FALSE(rows.back().thresholdMean);
    }
    EXPECT_EQ(session.answered(), 0u);
    EXPECT_EQ(session.rows(), 2u);
    EXPECT_EQ(session.next().number, 3);
    EXPECT_EQ(session.next().condition, untouched.next().condition);
    EXPECT_EQ(session.next().proposedRadiusPx, untouched.next().proposedRadiusPx);
    const Session resumed = replayed(design, rows, rows.size());
    EXPECT_EQ(resumed.next(), session.next());
}

TEST_P(BothTasks, AnUndoneRowLeavesTheStaircaseAlone) {
    std::vector<Trial> rows = wholeSession(design);
    std::size_t k = 20;
    while (!rows[k].staircase) ++k;
    const Session before = replayed(design, rows, k);
    rows[k].status = TrialStatus::undone;
    const Session after = replayed(design, rows, k + 1);
    EXPECT_EQ(after.answered(), k);
    EXPECT_EQ(after.next().condition, before.next().condition);
    EXPECT_EQ(after.next().proposedRadiusPx, before.next().proposedRadiusPx);
    EXPECT_EQ(after.next().number, before.next().number + 1);
}

/// A session in which answers are taken back, as undo.h marks them: at random, some after trials
/// that were too fast or disturbed.
std::vector<Trial> sessionWithUndoneRows(const Design& design) {
    std::vector<Trial> rows;
    Session session(design, kSeed);
    std::mt19937 rng(7);
    const bool sides = design.task == Task::twoAfc;
    const auto answer = [&](TrialStatus status) {
        const bool one = rng() % 2 == 0;
        Response response = one ? Response::left : Response::right;
        if (!sides) response = one ? Response::seen : Response::notSeen;
        const bool none = status == TrialStatus::repeated;
        rows.push_back(session.answer(
            {.response = none ? std::nullopt : std::optional(response), .status = status}));
    };
    for (int i = 0; i < 60 && !session.finished(); ++i) {
        if (rng() % 8 == 0) answer(TrialStatus::tooFast);
        answer(TrialStatus::ok);
        const std::size_t last = rows.size() - 1;
        if (rng() % 3 != 0 || session.finished()) continue;
        for (std::uint64_t more = rng() % 3; more > 0; --more) {
            answer(more == 1 ? TrialStatus::repeated : TrialStatus::tooFast);
        }
        for (std::size_t k = last; k < rows.size(); ++k) rows[k].status = TrialStatus::undone;
        session = replayed(design, rows, rows.size());
    }
    return rows;
}

TEST_P(BothTasks, EveryUndoneRowIsDerivedAgain) {
    const std::vector<Trial> rows = sessionWithUndoneRows(design);
    std::size_t undone = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        if (rows[k].status != TrialStatus::undone) continue;
        ++undone;
        for (const auto& [column, change] : std::vector<std::pair<std::string, void (*)(Trial&)>>{
                 {"condition", [](Trial& t) { t.condition = "other"; }},
                 {"filter_radius_px", [](Trial& t) { t.filterRadiusPx += 0.25; }},
                 {"shift_px", [](Trial& t) { t.shiftPx = 99; }},
                 {"image_seed", [](Trial& t) { t.imageSeed = 1; }}}) {
            Session session = replayed(design, rows, k);
            Trial row = rows[k];
            change(row);
            const auto difference = session.replay(row);
            ASSERT_TRUE(difference) << "row " << k << ", " << column;
            EXPECT_EQ(difference->column, column) << "row " << k;
        }
    }
    EXPECT_GT(undone, 20u);
}

TEST_P(BothTasks, AnUndoneRowWithoutAnAnswerFollowsOneWithIt) {
    std::vector<Trial> rows = wholeSession(design);
    Session session = replayed(design, rows, 5);
    rows[5].status = TrialStatus::undone;
    rows[5].response.reset();
    EXPECT_EQ(session.replay(rows[5]).value().column, "response");
}

TEST(Session, RefusesAResponseOfTheOtherTask) {
    Session twoAfc(tests::variedDesign(Task::twoAfc), 1),
        yesNo(tests::variedDesign(Task::yesNo), 1);
    EXPECT_THROW(twoAfc.answer({.response = Response::seen}), std::invalid_argument);
    EXPECT_THROW(yesNo.answer({.response = Response::left}), std::invalid_argument);
    EXPECT_EQ(twoAfc.rows(), 0u);
}

TEST(Session, RefusesAnInvalidDesign) {
    Design design = tests::variedDesign(Task::twoAfc);
    design.artifactPx.clear();
    EXPECT_THROW(Session(design, 1), std::invalid_argument);
}

TEST(Session, HasNoNextTrialWhenFinished) {
    Design design = tests::variedDesign(Task::twoAfc);
    design.trialsPerCondition = 1;
    Session session = replayed(design, wholeSession(design), wholeSession(design).size());
    EXPECT_TRUE(session.finished());
    EXPECT_THROW(session.next(), std::logic_error);
    EXPECT_THROW(session.answer({}), std::logic_error);
}

TEST(Session, ShowsTheNearestRadiusTheDisplayHas) {
    const study_app::RadiusLimits quarter{.min = 1, .max = 300, .step = 0.25},
        whole{.min = 2, .max = 99, .step = 1};
    EXPECT_EQ(study_app::shownRadius(25.608, quarter), 25.5);
    EXPECT_EQ(study_app::shownRadius(25.63, quarter), 25.75);
    EXPECT_EQ(study_app::shownRadius(25.608, whole), 26);
    EXPECT_EQ(study_app::shownRadius(0.01, quarter), 1);
    EXPECT_EQ(study_app::shownRadius(1e9, whole), 99);
}

// An observer who always fails drives the staircase to the display's limit and no further.
TEST(Session, StaysWithinTheDisplayLimits) {
    Design design = tests::shippedDesign("quick");
    design.radius = {.min = 20, .max = 80, .step = 1};
    for (const bool right : {false, true}) {
        Session session(design, 3);
        double last = 0;
        while (!session.finished()) {
            const bool left = (session.next().side == "left") == right;
            const Trial row = session.answer({.response = left ? Response::left : Response::right});
            EXPECT_GE(row.filterRadiusPx, 20);
            EXPECT_LE(row.filterRadiusPx, 80);
            if (row.staircase && row.artifactPx == (right ? 20 : 10)) last = row.filterRadiusPx;
        }
        EXPECT_EQ(last, right ? 80 : 20);
    }
}

TEST(Session, CountsFailedCatchTrials) {
    const Design design = tests::shippedDesign("quick");
    Session session(design, 3);
    while (!session.finished()) {
        const bool left = session.next().side == "left";
        session.answer({.response = left ? Response::right : Response::left});
    }
    EXPECT_EQ(session.catchAnswered(), study_app::catchTrials(design));
    EXPECT_EQ(session.catchFailed(), session.catchAnswered());
}

}  // namespace
