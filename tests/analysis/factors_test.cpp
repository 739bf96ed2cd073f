// SPDX-License-Identifier: MIT
#include "analysis/factors.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "analysis/slope_analysis.h"
#include "analysis/slope_record.h"
#include "tests/analysis/simulated_study.h"
#include "tests/records/scratch_folder.h"

namespace {

using namespace analysis;
using records::TrialTable;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<TrialTable> tablesOf(const tests::StudyPlan& plan, std::uint64_t seed = 301) {
    std::mt19937_64 rng(seed);
    return tests::simulateTables(plan, rng);
}

std::string refusal(const std::function<void()>& action) {
    try {
        action();
    } catch (const std::exception& error) {
        return error.what();
    }
    return "(no error)";
}

std::string refused(std::vector<std::string> asked) {
    return refusal([&] { factorNames(asked); });
}

TEST(Factors, AreColumnsThatSayHowATrialWasShown) {
    const std::string asked[] = {"kernel", "noise", "kernel", "expertise"};
    EXPECT_THAT(factorNames(asked), ElementsAre("kernel", "noise_levels", "expertise"));
    EXPECT_THAT(refused({""}), HasSubstr("--by: \"\": must name a column"));
    EXPECT_THAT(refused({"task"}), HasSubstr("a guess is not the same in both tasks"));
    EXPECT_THAT(refused({"response"}), HasSubstr("--by: \"response\": numbers, places or answers"));
}

TEST(Factors, DivideTheGroupsByAnOwnOrAnExtraColumn) {
    auto tables = tablesOf({.observers = 2, .sizes = {10, 20}, .trials = 8});
    for (TrialTable& table : tables) {
        table.extraColumns = {"surround"};
        for (std::size_t t = 0; t < table.trials.size(); ++t) {
            table.trials[t].kernel = t % 2 == 0 ? "box" : "disc";
            table.trials[t].extra = {"grey"};
        }
    }
    const std::string by[] = {"kernel", "surround"};
    const Study study = studyOf(tables, by);
    ASSERT_EQ(study.groups.size(), 2u);
    EXPECT_EQ(study.groups[0].name, "stair, lit 1, kernel box, surround grey");
    EXPECT_EQ(study.groups[0].kernel, "box");
    EXPECT_THAT(study.groups[1].levels, ElementsAre("disc", "grey"));
    EXPECT_EQ(study.kernel, "box, disc");
    EXPECT_THAT(study.factors, ElementsAre("kernel", "surround"));
    EXPECT_EQ(trialCount(study), 32);
    EXPECT_THAT(refusal([&] { studyOf(tables); }), HasSubstr("--by kernel"));
}

TEST(Factors, KeepTrialsWithNoiseWhereTheyAreDividedByIt) {
    auto tables = tablesOf({.observers = 1, .sizes = {10}, .trials = 10});
    for (std::size_t t = 0; t < 10; ++t) tables[0].trials[t].noiseLevels = t < 4 ? 10.0 : 0.0;
    EXPECT_EQ(trialCount(studyOf(tables)), 6);
    const std::string by[] = {"noise"};
    const Study study = studyOf(tables, by);
    EXPECT_EQ(trialCount(study), 10);
    EXPECT_EQ(study.groups[1].name, "stair, lit 1, noise_levels 10");
}

TEST(Factors, ComeFromTheParticipantsToo) {
    const tests::ScratchFolder folder;
    tests::writeTables(tablesOf({.observers = 3, .sizes = {10}, .trials = 10}), folder.path());
    tests::writeBytes(folder / "participants.tsv",
                      "participant_id\texpertise\nsub-001\texpert\nsub-002\tnovice\n");
    const std::filesystem::path paths[] = {folder.path()};
    const std::string by[] = {"expertise"};
    const Study study = loadStudy(paths, by);
    ASSERT_EQ(study.groups.size(), 3u);
    EXPECT_EQ(study.groups[0].name, "stair, lit 1, expertise expert");
    EXPECT_EQ(study.groups[1].name, "stair, lit 1, expertise n/a");
    const std::string unknown[] = {"handedness"};
    const std::string sentence = refusal([&] { loadStudy(paths, unknown); });
    EXPECT_THAT(sentence, HasSubstr("--by: \"handedness\": no column of the tables or of"));
    EXPECT_THAT(sentence, HasSubstr("expertise"));
    EXPECT_THAT(sentence, testing::Not(HasSubstr("handedness,")));
}

TEST(Factors, AreTestedAndLeaveTheContrastToEachLevel) {
    // Half of the observers need .2 log10 more; se of the difference .06.
    auto tables = tablesOf({.observers = 12, .groups = {{}}, .sizes = {10, 20}, .trials = 30}, 302);
    const auto others = tablesOf(
        {.observers = 12, .groups = {{.log10c = 0.74}}, .sizes = {10, 20}, .trials = 30}, 303);
    for (std::size_t i = 0; i < tables.size(); ++i) {
        const bool expert = i % 2 == 0;
        if (expert) tables[i].trials = others[i].trials;
        tables[i].extraColumns = {"expertise"};
        for (records::Trial& trial : tables[i].trials) trial.extra = {expert ? "expert" : "novice"};
    }
    const std::string by[] = {"expertise"};
    const SlopeAnalysis result = analyseSlope(studyOf(tables, by));
    ASSERT_EQ(result.factorTests.size(), 1u);
    const FactorTest& test = result.factorTests[0];
    EXPECT_EQ(test.test.degreesOfFreedom, 1);
    EXPECT_LT(test.test.pValue, 0.05);
    ASSERT_EQ(test.levels.size(), 2u);
    EXPECT_EQ(test.levels[0].name, "expert");
    // 4 standard errors.
    EXPECT_NEAR(test.levels[0].c.value - test.levels[1].c.value, 0.2, 0.24);
    EXPECT_EQ(result.slope.worstGroup, "stair, lit 1, expertise expert");
    EXPECT_FALSE(result.contrastExponent);
}

TEST(Factors, LeaveNoIntervalWhereNoTwoObserversShareAGroup) {
    auto tables = tablesOf({.observers = 2, .sizes = {10, 20}, .trials = 40});
    for (std::size_t i = 0; i < tables.size(); ++i) {
        for (records::Trial& trial : tables[i].trials) trial.kernel = i == 0 ? "box" : "disc";
    }
    const std::string by[] = {"kernel"};
    const SlopeAnalysis result = analyseSlope(studyOf(tables, by));
    EXPECT_FALSE(result.slope.headline.ci95);
    EXPECT_THAT(result.absent, testing::Contains(HasSubstr("no two observers share a group")));
    EXPECT_NEAR(result.slope.headline.value, 0.54, 0.5);  // 4 sd of an observer
    const records::Slope record = slopeRecord(result, records::currentRunContext("test", {}));
    EXPECT_EQ(record.kernel, result.study.groups[result.slope.worstIndex].kernel);
}

}  // namespace
