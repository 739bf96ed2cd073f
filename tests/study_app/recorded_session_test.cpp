// SPDX-License-Identifier: MIT
#include "study_app/recorded_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>

#include "records/session_sidecar.h"
#include "records/trial_table.h"
#include "study_app/simulated_population.h"
#include "study_app/simulated_study.h"
#include "tests/study_app/test_designs.h"
#include "tests/temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using study_app::RecordedSession;
using study_app::SessionRequest;
using testing::AllOf;
using testing::HasSubstr;

std::string contents(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

class Recorded : public testing::Test {
  protected:
    SessionRequest request() const {
        study_app::Design design = tests::variedDesign(records::Task::twoAfc);
        design.trialsPerCondition = 2;
        return {.dataFolder = folder.path(),
                .participant = "07",
                .session = {},
                .design = design,
                .seed = 5,
                .displayWidthPx = 600,
                .displayHeightPx = 600,
                .context = records::currentRunContext("test", {"test"})};
    }
    fs::path table() const { return records::trialTablePath(folder.path(), "07", std::nullopt); }

    /// Answers up to `count` trials; leaves the session open on disk when it returns.
    void answerSome(RecordedSession& recorded, int count) const {
        const auto observer = study_app::drawParticipant({}, request().design, 5);
        for (int i = 0; i < count && !recorded.session().finished(); ++i) {
            recorded.answer(
                study_app::simulatedAnswer(observer, recorded.session(), recorded.lastRow()));
        }
    }
    void answerSome(int count) const {
        RecordedSession recorded(request());
        answerSome(recorded, count);
    }

    std::string errorOf(const SessionRequest& changed) const {
        try {
            RecordedSession recorded(changed);
        } catch (const std::exception& error) {
            return error.what();
        }
        return "no error";
    }

    tests::TemporaryFolder folder;
};

TEST_F(Recorded, HasEachRowInTheFileBeforeTheNextTrial) {
    RecordedSession recorded(request());
    for (std::size_t k = 1; !recorded.session().finished(); ++k) {
        answerSome(recorded, 1);
        const records::TrialTable onDisk = records::readTrialTable(table());
        ASSERT_EQ(onDisk.trials.size(), k);
        ASSERT_EQ(onDisk.trials.back(), recorded.lastRow());
    }
}

TEST_F(Recorded, InterruptedAnywhereGivesTheSameFileAsWithoutInterruption) {
    answerSome(1000);
    const std::string whole = contents(table());
    fs::remove_all(folder.path() / "sub-07");
    for (int i = 0; i < 100; ++i) answerSome(1);
    EXPECT_EQ(contents(table()), whole);
}

TEST_F(Recorded, DropsATornLastLineAndGoesOnAsIfItHadNeverBeen) {
    answerSome(1000);
    const std::string whole = contents(table());
    const std::size_t lastLine = whole.rfind('\n', whole.size() - 2) + 1;
    for (const std::size_t kept : {lastLine + 1, lastLine + 30, whole.size() - 1}) {
        write(table(), whole.substr(0, kept));
        RecordedSession recorded(request());
        EXPECT_THAT(recorded.notices(), testing::ElementsAre(HasSubstr("line")));
        EXPECT_FALSE(recorded.session().finished());
        answerSome(recorded, 1);
        EXPECT_EQ(contents(table()), whole) << kept;
    }
}

TEST_F(Recorded, WritesWhatASessionIs) {
    answerSome(3);
    const records::SessionSidecar sidecar = records::readSidecar(records::sidecarPath(table()));
    EXPECT_EQ(sidecar.participant, "07");
    EXPECT_EQ(sidecar.seed, 5u);
    EXPECT_EQ(sidecar.context.seed, 5u);
    EXPECT_EQ(sidecar.kernel, "mixed");
    EXPECT_EQ(sidecar.observer, "human");
    EXPECT_NEAR(sidecar.criterion, quest::kPaperCriterion, 1e-14);
    EXPECT_THAT(contents(folder.path() / "participants.tsv"), HasSubstr("sub-07"));
}

TEST_F(Recorded, SecondProgramOnTheSameSessionIsRefused) {
    RecordedSession recorded(request());
    answerSome(recorded, 3);
    const std::string before = contents(table());
    EXPECT_THAT(errorOf(request()), HasSubstr("another program"));
    EXPECT_EQ(contents(table()), before);
    answerSome(recorded, 1);  // the first goes on
    EXPECT_EQ(records::readTrialTable(table()).trials.size(), 4u);
}

TEST_F(Recorded, GoesOnOnlyAsItBegan) {
    answerSome(3);
    const std::string before = contents(table());
    const std::string sidecarBefore = contents(records::sidecarPath(table()));
    SessionRequest other = request();
    other.seed = 6;
    EXPECT_THAT(errorOf(other), AllOf(HasSubstr("seed"), HasSubstr("5"), HasSubstr("6")));
    other = request();
    other.design.trialsPerCondition = 3;
    EXPECT_THAT(errorOf(other), HasSubstr("trials_per_condition is 2 there and 3 here"));
    other = request();
    other.observer = "simulated:c=3";
    EXPECT_THAT(errorOf(other), AllOf(HasSubstr("observer"), HasSubstr("human")));
    EXPECT_EQ(contents(table()), before);
    EXPECT_EQ(contents(records::sidecarPath(table())), sidecarBefore);
    other = request();
    other.design.description = "a better description";
    EXPECT_EQ(errorOf(other), "no error");
}

TEST_F(Recorded, RefusesATableWithoutItsSidecar) {
    answerSome(3);
    const std::string before = contents(table());
    fs::remove(records::sidecarPath(table()));
    EXPECT_THAT(errorOf(request()), AllOf(HasSubstr("is missing"), HasSubstr("3 trials")));
    EXPECT_EQ(contents(table()), before);
    EXPECT_THROW(study_app::replayTable(table()), std::runtime_error);
}

TEST_F(Recorded, StartsWhereOnlyTheEmptyTableWasLeft) {
    { RecordedSession recorded(request()); }    // killed before the first answer ...
    fs::remove(records::sidecarPath(table()));  // ... and even before the sidecar
    answerSome(3);
    EXPECT_EQ(study_app::replayTable(table()).session.rows(), 3u);
}

TEST_F(Recorded, RefusesTheSidecarOfAnotherParticipant) {
    answerSome(3);
    SessionRequest other = request();
    other.participant = "08";
    const fs::path copy = records::trialTablePath(folder.path(), "08", std::nullopt);
    fs::create_directories(copy.parent_path());
    fs::copy_file(table(), copy);
    fs::copy_file(records::sidecarPath(table()), records::sidecarPath(copy));
    EXPECT_THAT(errorOf(other), AllOf(HasSubstr("participant"), HasSubstr("07"), HasSubstr("08")));
}

TEST_F(Recorded, RefusesATableThatItDoesNotDerive) {
    answerSome(10);
    std::string text = contents(table());
    const std::size_t name = text.find("-lit", text.find("\n5\t"));  // of trial 5's condition
    text[name + 4] = '9';
    write(table(), text);
    EXPECT_THAT(errorOf(request()), AllOf(HasSubstr("line 6"), HasSubstr("cannot go on")));
    EXPECT_EQ(contents(table()), text);
    EXPECT_THROW(study_app::replayTable(table()), std::runtime_error);
}

TEST_F(Recorded, RefusesAForeignOrBrokenFile) {
    fs::create_directories(table().parent_path());
    const std::string foreign = "trial\tcolour\n1\tblue\n";
    write(table(), foreign);
    EXPECT_THAT(errorOf(request()), HasSubstr(table().string()));
    EXPECT_EQ(contents(table()), foreign);
    fs::remove(table());
    answerSome(3);
    const std::string good = contents(table());
    write(records::sidecarPath(table()), "{ \"stairwell\": ");
    EXPECT_THAT(errorOf(request()), HasSubstr(records::sidecarPath(table()).string()));
    EXPECT_EQ(contents(table()), good);
}

TEST_F(Recorded, ReplaysToTheThresholdsOfTheSession) {
    answerSome(20);
    const study_app::ReplayedSession replayed = study_app::replayTable(table());
    RecordedSession recorded(request());
    EXPECT_EQ(replayed.session.rows(), 20u);
    EXPECT_EQ(replayed.session.next(), recorded.session().next());
    const auto a = study_app::thresholds(replayed.session),
               b = study_app::thresholds(recorded.session());
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].mean, b[k].mean);
}

TEST(SimulatedStudy, GivesTheSameFilesWhateverRunsBesideIt) {
    const tests::TemporaryFolder together, alone;
    SessionRequest request{.dataFolder = together.path(),
                           .participant = {},
                           .session = "a",
                           .design = tests::shippedDesign("quick"),
                           .seed = 11,
                           .context = records::currentRunContext("test", {"test"})};
    const auto sessions = study_app::runSimulatedStudy(request, {}, 12);
    ASSERT_EQ(sessions.size(), 12u);
    request.dataFolder = alone.path();
    request.participant = "05";
    request.seed = study_app::participantSeed(11, 4);
    const auto fifth = study_app::runSimulatedSession(request, {});
    EXPECT_EQ(contents(fifth.table), contents(sessions[4].table));
    EXPECT_EQ(contents(records::sidecarPath(fifth.table)),
              contents(records::sidecarPath(sessions[4].table)));
    EXPECT_THAT(contents(together.path() / "participants.tsv"),
                HasSubstr("sub-01\nsub-02\nsub-03\nsub-04\nsub-05\nsub-06\n"));
}

TEST(SimulatedStudy, FinishesWhatIsLeftAndTouchesNothingFinished) {
    const tests::TemporaryFolder folder;
    const SessionRequest request{.dataFolder = folder.path(),
                                 .participant = {},
                                 .session = {},
                                 .design = tests::shippedDesign("quick"),
                                 .seed = 11,
                                 .context = records::currentRunContext("test", {"test"})};
    const auto first = study_app::runSimulatedStudy(request, {}, 3);
    const std::string whole = contents(first[1].table);
    write(first[1].table, whole.substr(0, whole.size() / 2));
    const auto second = study_app::runSimulatedStudy(request, {}, 3);
    EXPECT_EQ(second[0].newRows, 0u);
    EXPECT_GT(second[1].newRows, 0u);
    EXPECT_EQ(second[2].newRows, 0u);
    EXPECT_EQ(contents(first[1].table), whole);
}

TEST(SimulatedStudy, NamesParticipantsSoThatTheySort) {
    EXPECT_EQ(study_app::participantName(0, 10), "01");
    EXPECT_EQ(study_app::participantName(9, 10), "10");
    EXPECT_EQ(study_app::participantName(0, 100), "001");
}

}  // namespace
