// SPDX-License-Identifier: MIT
#include "analysis/study.h"

#include <gmock/gmock.h>

#include <functional>

#include "analysis/screening.h"
#include "tests/analysis/simulated_study.h"

namespace {

using namespace analysis;
using records::TrialTable;
using testing::HasSubstr;

std::vector<TrialTable> tablesOf(const tests::StudyPlan& plan, std::uint64_t seed = 61) {
    std::mt19937_64 rng(seed);
    return tests::simulateTables(plan, rng);
}

std::string refusal(const std::vector<TrialTable>& tables) {
    try {
        studyOf(tables);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "(no error)";
}

TEST(Study, GroupsArePatternsAtLitLevelsAndConditionsTheirSizes) {
    const tests::StudyPlan plan{
        .observers = 3, .groups = tests::fourGroups(0.5, 0.5, 0.5, 0.5), .trials = 4};
    const Study study = studyOf(tablesOf(plan));
    ASSERT_EQ(study.groups.size(), 4u);
    EXPECT_EQ(study.groups[0].name, "stair, lit 1");
    EXPECT_EQ(study.groups[1].name, "stair, lit 0.5");
    EXPECT_EQ(study.groups[2].name, "step, lit 1");
    ASSERT_EQ(study.conditions.size(), 16u);
    EXPECT_EQ(conditionName(study, 5), "stair, lit 0.5, a 10");
    EXPECT_EQ(study.observers.size(), 3u);
    EXPECT_EQ(trialCount(study), 3 * 16 * 4);
    EXPECT_EQ(trialCount(study, 1), 3 * 4 * 4);
    EXPECT_EQ(study.encoding, records::Encoding::srgb);
    EXPECT_NEAR(referenceArtifactPx(study), std::pow(5.0 * 10 * 20 * 30, 0.25), 1e-12);
    EXPECT_TRUE(study.notices.empty());
}

TEST(Study, LinesAreGroupedByAngle) {
    auto tables = tablesOf({.observers = 1, .sizes = {8}, .trials = 6});
    const double angles[] = {22.5, 10, 22.5, 10, 22.5, 10};
    for (std::size_t t = 0; t < 6; ++t) {
        tables[0].trials[t].pattern = records::Pattern::line;
        tables[0].trials[t].angleDeg = angles[t];
    }
    const Study study = studyOf(tables);
    ASSERT_EQ(study.groups.size(), 2u);
    EXPECT_EQ(study.groups[0].name, "line 10 deg, lit 1");
    EXPECT_EQ(study.groups[1].name, "line 22.5 deg, lit 1");
    EXPECT_EQ(study.groups[1].angleDeg, 22.5);
}

TEST(Study, DoesNotDependOnTheOrderOfTablesOrRows) {
    auto tables = tablesOf({.observers = 3, .sizes = {10, 20}, .trials = 10});
    const Study study = studyOf(tables);
    std::swap(tables[0], tables[2]);
    std::swap(tables[1].trials.front(), tables[1].trials.back());
    const Study other = studyOf(tables);
    ASSERT_EQ(other.observers.size(), study.observers.size());
    for (std::size_t i = 0; i < study.observers.size(); ++i) {
        EXPECT_EQ(other.observers[i].id, study.observers[i].id);
        EXPECT_EQ(other.observers[i].cells.size(), study.observers[i].cells.size());
    }
}

TEST(Study, JoinsSessionsOfOneParticipant) {
    auto tables = tablesOf({.observers = 2, .sizes = {10}, .trials = 10});
    tables[1].participant = tables[0].participant;
    tables[0].session = "1";
    tables[1].session = "2";
    const Study study = studyOf(tables);
    ASSERT_EQ(study.observers.size(), 1u);
    EXPECT_EQ(trialCount(study), 20);
}

TEST(Study, RefusesTwoObserversWithOneId) {
    auto tables = tablesOf({.observers = 2, .sizes = {10}, .trials = 3});
    tables[1].participant = tables[0].participant;
    EXPECT_EQ(refusal(tables), tables[1].file.string() + ": participant 001 is also in " +
                                   tables[0].file.string() +
                                   ": two observers must not share an id");
}

TEST(Study, RefusesMixedTasksKernelsAndEncodings) {
    const auto spoilt = [](const std::function<void(records::Trial&)>& spoil) {
        auto tables = tablesOf({.observers = 2, .sizes = {10}, .trials = 3});
        for (records::Trial& trial : tables[1].trials) spoil(trial);
        return refusal(tables);
    };
    EXPECT_EQ(
        spoilt([](records::Trial& t) {
            t.task = records::Task::yesNo;
            t.response = records::Response::seen;
        }),
        "sub-002_task-hideartifact_beh.tsv, trial 1: task yes_no, but "
        "sub-001_task-hideartifact_beh.tsv, trial 1 has 2afc: a slope stands for one task; fit "
        "the tables apart");
    EXPECT_THAT(spoilt([](records::Trial& t) { t.kernel = "box"; }),
                HasSubstr("kernel box, but sub-001_task-hideartifact_beh.tsv, trial 1 has disc"));
    EXPECT_THAT(spoilt([](records::Trial& t) { t.encoding.reset(); }),
                HasSubstr("encoding n/a, but"));
}

TEST(Study, LeavesOutWhatDoesNotEnterAndSaysSo) {
    auto tables = tablesOf({.observers = 1, .sizes = {10}, .trials = 10});
    TrialTable& table = tables[0];
    for (records::Trial& trial : table.trials) trial.noiseLevels = 0;
    table.trials[0].noiseLevels = 10;
    table.trials[1].status = records::TrialStatus::undone;
    table.trials[2].litLevel = 0;
    table.trials[3].type = records::TrialType::reference;
    table.trials[4].noiseLevels.reset();
    const Study study = studyOf(tables);
    EXPECT_EQ(trialCount(study), 6);
    EXPECT_THAT(study.notices,
                testing::UnorderedElementsAre(
                    HasSubstr("1 trial left out: image noise was added"),
                    HasSubstr("1 trial left out: status undone"),
                    HasSubstr("1 trial left out: lit level 0 shows no edge"),
                    HasSubstr("1 trial left out: a reference trial in 2AFC tests nothing")));
}

TEST(Study, NeedsAtLeastOneTrial) {
    auto tables = tablesOf({.observers = 1, .sizes = {10}, .trials = 2});
    for (records::Trial& trial : tables[0].trials) trial.litLevel = 0;
    EXPECT_THAT(refusal(tables), HasSubstr("1 table without a trial to fit"));
}

TEST(Study, SubsetRenumbers) {
    const tests::StudyPlan plan{
        .observers = 3, .groups = tests::fourGroups(0.5, 0.5, 0.5, 0.5), .trials = 2};
    const Study study = studyOf(tablesOf(plan));
    std::vector<bool> conditions(16, false);
    conditions[6] = conditions[13] = true;
    const Study part = subset(study, {true, false, true}, conditions);
    ASSERT_EQ(part.observers.size(), 2u);
    EXPECT_EQ(part.observers[1].id, "003");
    ASSERT_EQ(part.conditions.size(), 2u);
    EXPECT_EQ(conditionName(part, 0), conditionName(study, 6));
    EXPECT_EQ(conditionName(part, 1), conditionName(study, 13));
    for (const Observer& observer : part.observers) EXPECT_EQ(observer.cells.size(), 2u);
}

TEST(Screening, FindsTheObserverWhoPressesAtRandomInEitherTask) {
    tests::StudyPlan plan{
        .observers = 5, .sizes = {10}, .trials = 20, .guessing = 1, .catchTrials = 30};
    auto rows = screen(studyOf(tablesOf(plan)));
    // A guesser passes the 2AFC rule with probability 2e-3 (at most 6 of 30 wrong), an attentive
    // one breaks either rule with less than 1e-3; the seed is fixed.
    EXPECT_TRUE(rows[0].excluded);
    EXPECT_THAT(rows[0].reason, HasSubstr("of 30 catch trials failed, limit 20 %"));
    for (std::size_t i = 1; i < rows.size(); ++i) EXPECT_FALSE(rows[i].excluded) << rows[i].reason;

    plan.yesNo = true;
    const Study study = studyOf(tablesOf(plan));
    rows = screen(study);
    EXPECT_TRUE(rows[0].excluded);
    EXPECT_THAT(rows[0].reason, HasSubstr("false alarms in 40 reference trials"));
    for (std::size_t i = 1; i < rows.size(); ++i) EXPECT_FALSE(rows[i].excluded) << rows[i].reason;
    EXPECT_EQ(withoutExcluded(study, rows).observers.size(), 4u);

    rows = screen(study, {.apply = false});
    EXPECT_FALSE(rows[0].excluded);
    EXPECT_NE(rows[0].reason, "");
}

TEST(Screening, NeedsReferenceTrialsInYesNo) {
    const auto rows = screen(studyOf(
        tablesOf({.observers = 1, .sizes = {10}, .trials = 5, .yesNo = true, .references = 0})));
    EXPECT_TRUE(rows[0].excluded);
    EXPECT_THAT(rows[0].reason, HasSubstr("no reference trial"));
}

TEST(Screening, NamesRunsThatRanAgainstALimitButKeepsThem) {
    auto tables = tablesOf({.observers = 1, .sizes = {10, 20}, .trials = 20});
    for (records::Trial& trial : tables[0].trials) {
        if (trial.artifactPx == 20 && *trial.proposedRadiusPx > 40) trial.filterRadiusPx = 40;
    }
    const auto rows = screen(studyOf(tables));
    ASSERT_EQ(rows[0].runsAtLimit.size(), 1u);
    EXPECT_EQ(rows[0].runsAtLimit[0], "stair, lit 1, a 20");
    EXPECT_FALSE(rows[0].excluded);
}

TEST(Screening, GuessingRateIsShrunk) {
    Observer observer;
    observer.references = 77;
    observer.falseAlarms = 14;
    EXPECT_EQ(guessingRate(observer, records::Task::yesNo), 14.5 / 78);
    EXPECT_EQ(guessingRate(observer, records::Task::twoAfc), 0.5);
}

}  // namespace
