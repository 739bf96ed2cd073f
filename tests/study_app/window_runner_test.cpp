// SPDX-License-Identifier: MIT
// Sessions with a person whose hands and clock are the test's: practice, rows, undo, breaks,
// stimuli.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "records/participants_table.h"
#include "records/session_sidecar.h"
#include "stimulus/stimulus_image.h"
#include "study_app/display_file.h"
#include "study_app/practice.h"
#include "study_app/session_flags.h"
#include "study_app/session_runner.h"
#include "study_app/session_start.h"
#include "study_app/setup_form.h"
#include "study_app/trial_stimulus.h"
#include "study_app/undo.h"
#include "tests/study_app/frame_folder.h"
#include "tests/temporary_folder.h"

namespace study_app {
namespace {

using records::Response;
using records::Task;
using records::Trial;
using records::TrialStatus;

const Presentation kPace{.blankS = 0.1, .fixationS = 0.1, .breakEveryTrials = 0};

Design smallDesign(Task task = Task::twoAfc) {
    Design d;
    d.name = "small";
    d.windowPx = 64;
    d.artifactPx = {4, 6};
    d.patterns = {{.pattern = records::Pattern::stair}, {.pattern = records::Pattern::step}};
    d.trialsPerCondition = 3;
    d.radius.max = 32;
    d.presentation = kPace;
    return withTask(d, task);
}

SessionRequest requestIn(const tests::TemporaryFolder& folder, Task task = Task::twoAfc) {
    return {.dataFolder = folder.path() / "data",
            .participant = "01",
            .session = {},
            .design = smallDesign(task),
            .seed = 11,
            .displayWidthPx = 1280,
            .displayHeightPx = 800,
            .context = records::currentRunContext("study_app", {"study_app"})};
}

Side sideOf(const Trial& trial, bool right) {
    const bool seen = trial.task == Task::twoAfc ? trial.side == "right"
                                                 : trial.type == records::TrialType::artifact;
    return seen == right ? Side::right : Side::left;
}

/// A person who looks at the clock when the stimulus comes and answers after half a second.
struct Sitting {
    SessionRunner& runner;
    double now = 100;

    void show() {
        for (; !runner.stimulusDue(now); now += 0.05) runner.tick(now);
        runner.images();
        runner.shown(now);
    }
    std::optional<RunnerEvent> answer(bool right, double after = 0.5) {
        const Side side = sideOf(runner.trial(), right);
        now += after;
        return runner.answer(side, now);
    }
    /// Begins the session and answers so many trials.
    void sit(int answers) {
        runner.begin(SessionRunner::Stage::session, now);
        for (int i = 0; i < answers; ++i) {
            show();
            answer(true);
        }
    }
};

TEST(SessionRunner, RecordsEveryAnswerBeforeTheNextTrial) {
    const tests::TemporaryFolder folder;
    SessionRunner runner(requestIn(folder));
    Sitting person{runner};
    runner.begin(SessionRunner::Stage::session, person.now);
    std::optional<RunnerEvent> event;
    for (std::size_t i = 1; event != RunnerEvent::finished; ++i) {
        person.show();
        const Trial shown = runner.trial();
        event = person.answer(i % 3 != 0);
        const auto rows = records::readTrialTable(runner.table()).trials;
        ASSERT_EQ(rows.size(), i);
        EXPECT_EQ(rows.back().filterRadiusPx, shown.filterRadiusPx);
        EXPECT_EQ(rows.back().correct, i % 3 != 0);
        EXPECT_NEAR(rows.back().responseTimeS.value(), 0.5, 1e-6);
    }
    EXPECT_NO_THROW(replayTable(runner.table()));
}

TEST(SessionRunner, RepeatsWhatWasTooFastOrDisturbed) {
    const tests::TemporaryFolder folder;
    SessionRunner runner(requestIn(folder));
    Sitting person{runner};
    runner.begin(SessionRunner::Stage::session, person.now);
    person.show();
    const std::string condition = runner.trial().condition;
    person.answer(true, 0.01);
    EXPECT_TRUE(runner.lastTooFast());
    person.show();
    EXPECT_EQ(runner.trial().condition, condition);
    EXPECT_TRUE(runner.interrupt());
    runner.begin(SessionRunner::Stage::session, person.now);
    person.show();
    EXPECT_EQ(runner.trial().condition, condition);
    person.answer(true);
    const auto rows = records::readTrialTable(runner.table()).trials;
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0].status, TrialStatus::tooFast);
    EXPECT_EQ(rows[1].status, TrialStatus::repeated);
    EXPECT_FALSE(rows[1].responseTimeS);
    EXPECT_EQ(rows[2].status, TrialStatus::ok);
    EXPECT_NO_THROW(replayTable(runner.table()));
}

TEST(SessionRunner, UndoneAnswersLeaveTheStaircasesAsIfTheyHadNotBeenGiven) {
    const tests::TemporaryFolder folder;
    SessionRunner runner(requestIn(folder));
    Sitting person{runner};
    person.sit(4);
    person.show();
    const Trial before = runner.trial();
    const Session stateBefore = runner.session();
    person.answer(false);
    person.show();  // a disturbed trial after it is derived from it, and undone with it
    ASSERT_TRUE(runner.canUndo());
    EXPECT_TRUE(runner.undo());
    EXPECT_FALSE(runner.canUndo());
    const auto rows = records::readTrialTable(runner.table()).trials;
    ASSERT_EQ(rows.size(), 6u);
    EXPECT_EQ(rows[3].status, TrialStatus::ok);
    EXPECT_EQ(rows[4].status, TrialStatus::undone);
    EXPECT_EQ(rows[5].status, TrialStatus::undone);
    EXPECT_EQ(runner.session().answered(), stateBefore.answered());
    EXPECT_EQ(runner.session().next().condition, before.condition);
    EXPECT_EQ(runner.session().next().proposedRadiusPx, before.proposedRadiusPx);
    EXPECT_EQ(runner.session().next().number, 7);
    runner.begin(SessionRunner::Stage::session, person.now);
    person.show();
    person.answer(true);
    EXPECT_EQ(replayTable(runner.table()).session.answered(), 5u);
}

TEST(SessionRunner, IsNotBegunAnewWhereItsFilesAreGone) {
    const tests::TemporaryFolder folder;
    SessionRunner runner(requestIn(folder));
    Sitting person{runner};
    person.sit(2);
    person.show();
    const auto data = folder.path() / "data", away = folder.path() / "away";
    std::filesystem::rename(data, away);
    EXPECT_EQ(person.answer(true), RunnerEvent::notRecorded);
    EXPECT_THAT(runner.problem(), testing::HasSubstr(runner.table().string() + ": is missing"));
    EXPECT_EQ(runner.session().answered(), 2u);
    EXPECT_EQ(runner.rows().size(), 2u);
    EXPECT_FALSE(runner.begin(SessionRunner::Stage::session, person.now));
    EXPECT_FALSE(std::filesystem::exists(data));
    // Somebody else's, or an empty one: not the rows that were recorded.
    std::filesystem::create_directories(runner.table().parent_path());
    std::filesystem::copy(away, data, std::filesystem::copy_options::recursive);
    std::ofstream(runner.table()) << records::trialTableHeader({}) << "\n";
    EXPECT_FALSE(runner.begin(SessionRunner::Stage::session, person.now));
    EXPECT_THAT(runner.problem(), testing::HasSubstr("holds 0 rows"));
    std::filesystem::remove_all(data);
    std::filesystem::rename(away, data);
    ASSERT_TRUE(runner.begin(SessionRunner::Stage::session, person.now));
    EXPECT_EQ(runner.problem(), "");
    person.show();
    person.answer(true);
    EXPECT_EQ(replayTable(runner.table()).session.answered(), 3u);
}

TEST(SessionRunner, TakesNothingBackWhileItsFilesAreGone) {
    for (const bool stimulusOn : {true, false}) {
        const tests::TemporaryFolder folder;
        SessionRunner runner(requestIn(folder));
        Sitting person{runner};
        person.sit(2);
        if (stimulusOn) person.show();
        const auto data = folder.path() / "data", away = folder.path() / "away";
        std::filesystem::rename(data, away);
        for (int i = 0; i < 2; ++i) {
            EXPECT_FALSE(runner.undo());
            EXPECT_THAT(runner.problem(), testing::HasSubstr("is missing"));
            EXPECT_FALSE(std::filesystem::exists(data));
        }
        std::filesystem::rename(away, data);
        EXPECT_EQ(replayTable(runner.table()).session.answered(), 2u);
        EXPECT_TRUE(runner.undo());
        EXPECT_EQ(replayTable(runner.table()).session.answered(), 1u);
    }
}

TEST(SessionRunner, SaysThatADisturbedTrialCouldNotBeRecorded) {
    const tests::TemporaryFolder folder;
    SessionRunner runner(requestIn(folder));
    Sitting person{runner};
    runner.begin(SessionRunner::Stage::session, person.now);
    person.show();
    std::filesystem::rename(folder.path() / "data", folder.path() / "away");
    EXPECT_TRUE(runner.interrupt());
    EXPECT_THAT(runner.problem(), testing::HasSubstr("is missing"));
}

TEST(SessionRunner, AsksForBreaksByTheNumberOfAnswers) {
    const tests::TemporaryFolder folder;
    SessionRequest request = requestIn(folder);
    request.design.presentation.breakEveryTrials = 4;
    SessionRunner runner(request);
    Sitting person{runner};
    runner.begin(SessionRunner::Stage::session, person.now);
    std::vector<RunnerEvent> events;
    for (int i = 0; i < 8; ++i) {
        person.show();
        events.push_back(person.answer(true).value());
        if (events.back() == RunnerEvent::breakDue) {
            runner.begin(SessionRunner::Stage::session, person.now);
        }
    }
    EXPECT_EQ(events[3], RunnerEvent::breakDue);
    EXPECT_EQ(events[7], RunnerEvent::breakDue);
    EXPECT_EQ(std::ranges::count(events, RunnerEvent::breakDue), 2);
}

TEST(SessionRunner, GoesOnWithItsClockAfterAResume) {
    const tests::TemporaryFolder folder;
    double last = 0;
    {
        SessionRunner runner(requestIn(folder));
        Sitting person{runner};
        runner.begin(SessionRunner::Stage::session, person.now);
        person.show();
        person.answer(true);
        last = runner.rows().back().onsetS.value() + 0.5;
    }
    SessionRunner runner(requestIn(folder));
    Sitting person{runner, 3};  // the clock of another start
    EXPECT_EQ(runner.practice().rule(), kPace.resumedPractice);
    runner.begin(SessionRunner::Stage::session, person.now);
    person.show();
    person.answer(true);
    EXPECT_NEAR(runner.rows().back().onsetS.value(), last + 0.2, 0.06);  // steps of the loop above
}

TEST(SessionRunner, RefusesASecondProgramOnTheSameSession) {
    const tests::TemporaryFolder folder;
    const SessionRunner first(requestIn(folder));
    EXPECT_THROW(SessionRunner(requestIn(folder)), std::runtime_error);
}

TEST(Practice, EndsWhenItsRuleIsMetAndAsksForHelpWhenItIsNot) {
    for (const Task task : {Task::twoAfc, Task::yesNo}) {
        const PracticeRule rule{.correct = 4, .ofLast = 5, .atMost = 10};
        Practice good(smallDesign(task), 1, rule), bad(smallDesign(task), 1, rule);
        for (int i = 0; i < 4; ++i) {
            EXPECT_FALSE(good.ruleMet());
            good.answer(responseFor(sideOf(good.next(), true), task));
        }
        EXPECT_TRUE(good.ruleMet());
        for (int i = 0; i < 10; ++i) bad.answer(responseFor(sideOf(bad.next(), false), task));
        EXPECT_TRUE(bad.exhausted());
        bad.startAgain();
        EXPECT_FALSE(bad.exhausted());
    }
}

TEST(Practice, ShowsArtifactsThatNobodyOverlooks) {
    Practice practice(smallDesign(Task::yesNo), 3, {});
    int references = 0;
    for (int i = 0; i < 40; ++i) {
        const Trial trial = practice.next();
        EXPECT_LE(trial.filterRadiusPx, trial.artifactPx);
        references += trial.type == records::TrialType::reference ? 1 : 0;
        practice.answer(Response::seen);
    }
    EXPECT_EQ(references, 20);
}

TEST(Practice, ShowsTheCoarsestMapsOfFrames) {
    const tests::TemporaryFolder folder;
    tests::writeFrameFolder(folder.path(), {0.75, 1, 2, 4, 8});
    Design d;
    d.name = "frames";
    d.windowPx = tests::kFrameEdgePx;
    d.frames = FrameSet{folder.path(), records::readFrameManifest(folder.path()).pairs};
    d.roving = {.shift = false, .quarterTurn = false, .tilt = false};
    Practice practice(d, 3, {});
    for (int i = 0; i < 30; ++i) {
        const Trial trial = practice.next();
        EXPECT_LE(trial.filterRadiusPx, trial.artifactPx);
        const auto& pairs = d.frames->pairs;
        const auto shown =
            std::ranges::find(pairs, trial.frame.value(), &records::FramePair::artifact);
        EXPECT_EQ(trial.artifactPx, shown->artifactPx);
        practice.answer(Response::left);
    }
}

TEST(TrialStimulus, IsWhatStimulusComputesOnTheSideThatTheRowNames) {
    Session session(smallDesign(), 5);
    for (int i = 0; i < 12; ++i) {
        const Trial& trial = session.next();
        const TrialImages images = trialImages(trial, session.design());
        stimulus::StimulusOptions o;
        o.silhouette = {.pattern = trial.pattern == records::Pattern::stair
                                       ? stimulus::Pattern::stair
                                       : stimulus::Pattern::step,
                        .artifactPx = trial.artifactPx,
                        .riserSpacingPx = 64};
        o.kernel.radiusPx = trial.filterRadiusPx;
        o.windowPx = 64;
        o.roving = {.straightTiltDeg = trial.tiltDeg,
                    .shiftPx = trial.shiftPx.value(),
                    .mirror = trial.mirror.value(),
                    .quarterTurns = trial.orientationQuarter.value()};
        const cv::Mat& artifact = trial.side == "left" ? images.left : images.right;
        EXPECT_EQ(cv::countNonZero(artifact != stimulus::artifactImage(o)), 0);
        const cv::Mat& straight = trial.side == "left" ? images.right : images.left;
        EXPECT_EQ(cv::countNonZero(straight != stimulus::straightImage(o)), 0);
        session.answer({.response = i % 2 == 0 ? Response::left : Response::right});
    }
}

TEST(StimulusPrefetcher, HoldsWhicheverTrialComesNext) {
    Session session(smallDesign(), 5);
    StimulusPrefetcher prefetcher(session.design());
    for (int i = 0; i < 12; ++i) {
        EXPECT_TRUE(prefetcher.take(session.next()) ==
                    trialImages(session.next(), session.design()));
        const std::vector<Trial> coming = possibleNext(session);
        prefetcher.request(coming);
        session.answer({.response = i % 3 == 0 ? Response::left : Response::right,
                        .status = i % 4 == 1 ? TrialStatus::tooFast : TrialStatus::ok});
        if (session.finished()) break;
        EXPECT_THAT(coming, testing::Contains(session.next()));
    }
}

TEST(StimulusPrefetcher, PassesErrorsOn) {
    const Design design = smallDesign();
    Trial trial = Session(design, 5).next();
    trial.kernel = "star";
    StimulusPrefetcher prefetcher(design);
    EXPECT_THROW(prefetcher.take(trial), std::invalid_argument);
    prefetcher.request({trial});
    EXPECT_THROW(prefetcher.take(trial), std::invalid_argument);
}

TEST(Calibration, StoresWhatAPhotometerReadAndNothingThatIsNoReading) {
    const tests::TemporaryFolder folder;
    const auto displays = folder.path() / "displays.json";
    CalibrationState c;
    c.profile = {.name = "desk", .widthPx = 1920, .heightPx = 1080};
    c.blackText = "0";
    c.greyText = "21.5";
    c.whiteText = "98";
    ASSERT_TRUE(storeCalibration(c, displays)) << c.problem;
    EXPECT_EQ(c.profile.luminance,
              (records::ScreenLuminance{.black = 0, .grey = 21.5, .white = 98}));
    EXPECT_EQ(findDisplay(readDisplays(displays), c.profile), c.profile);
    for (const auto& [grey, problem] :
         {std::pair("dim", "Luminance of grey: \"dim\": must be a number"),
          std::pair("120", "luminance_cd_m2: 98: must be greater than luminance_grey_cd_m2, 120"),
          std::pair("1e999", "must be a number"), std::pair("-3", "luminance_grey_cd_m2: -3: ")}) {
        c.greyText = grey;
        EXPECT_FALSE(storeCalibration(c, displays));
        EXPECT_THAT(c.problem, testing::HasSubstr(problem));
        EXPECT_EQ(c.profile.luminance.grey, 21.5);
    }
    c.greyText.clear();  // taken back
    ASSERT_TRUE(storeCalibration(c, displays));
    EXPECT_FALSE(findDisplay(readDisplays(displays), c.profile)->luminance.grey);
    c.gammaGiven = true;
    c.greyCode = 254;  // gamma 176
    EXPECT_FALSE(storeCalibration(c, displays));
    EXPECT_THAT(c.problem, testing::HasSubstr("gamma"));
}

TEST(SessionFlags, FindAStaircaseAtTheDisplaysLimitAndACarelessObserver) {
    Design d = smallDesign();
    d.trialsPerCondition = 20;
    d.catchShare = 0.2;
    Session session(d, 1);
    while (!session.finished()) {
        const Trial& t = session.next();
        // Never fooled by blur, but blind to the trials that check attention.
        const bool right = !session.nextIsCatch();
        session.answer(
            {.response = (t.side == "left") == right ? Response::left : Response::right});
    }
    const auto results = conditionResults(session);
    EXPECT_TRUE(results[0].atLimit);
    EXPECT_THAT(flagText(results[0]), testing::HasSubstr("display limit"));
    EXPECT_LT(results[0].cLow, results[0].threshold.c);
    EXPECT_GT(results[0].cHigh, results[0].threshold.c);
    EXPECT_THAT(catchResult(d, session.catchAnswered(), session.catchFailed()).problem,
                testing::HasSubstr("of 20 catch trials failed"));
}

TEST(SetupForm, FindsWhatIsThereAndKeepsToIt) {
    const tests::TemporaryFolder folder;
    SetupForm form;
    form.dataFolder = (folder.path() / "data").string();
    form.participant = "01";
    EXPECT_EQ(findExisting(form).state, ExistingSession::State::none);
    {
        SessionRunner runner(requestIn(folder));
        Sitting person{runner};
        runner.begin(SessionRunner::Stage::session, person.now);
        person.show();
        person.answer(true);
    }
    const ExistingSession existing = findExisting(form);
    EXPECT_EQ(existing.state, ExistingSession::State::unfinished);
    EXPECT_EQ(existing.answered, 1u);
    form.design = "paper16";
    DisplayProfile display;
    display.widthPx = display.heightPx = 1;
    const SessionRequest request =
        requestFrom(form, existing, display, 99, requestIn(folder).context);
    EXPECT_EQ(request.design, smallDesign());
    EXPECT_EQ(request.seed, 11u);
    EXPECT_THAT(describeParticipants(form.dataFolder), testing::ElementsAre("01: 1 of 13 trials"));
    std::ofstream(
        records::sidecarPath(records::trialTablePath(form.dataFolder, "01", std::nullopt)))
        << "{";
    EXPECT_EQ(findExisting(form).state, ExistingSession::State::unusable);
}

// A program that was killed between the table's first line and the sidecar has recorded nothing.
TEST(SetupForm, TakesASessionThatWasKilledAsItBeganForNone) {
    const tests::TemporaryFolder folder;
    SetupForm form;
    form.dataFolder = (folder.path() / "data").string();
    form.participant = "01";
    const auto table = records::trialTablePath(form.dataFolder, "01", std::nullopt);
    { const records::TrialJournal begun(table); }
    const std::string header = records::trialTableHeader() + "\n";
    ASSERT_EQ(std::filesystem::file_size(table), header.size());
    const auto write = [&](const std::string& text) { std::ofstream(table) << text; };
    for (const std::string& written :
         {header + "1\tstair", header, header.substr(0, header.size() / 2), std::string()}) {
        write(written);
        const ExistingSession existing = findExisting(form);
        EXPECT_EQ(existing.state, ExistingSession::State::none) << existing.problem;
        EXPECT_THAT(describeParticipants(form.dataFolder), testing::ElementsAre("01: not begun"));
    }
    for (const std::string foreign :
         {"trial\tcolour", "trial\tcolour\n", "trial\tcolour\n1\tblue"}) {
        write(foreign);
        EXPECT_EQ(findExisting(form).state, ExistingSession::State::unusable) << foreign;
    }
    write(header + "1\tstair");
    {
        SessionRunner runner(requestIn(folder));
        Sitting person{runner};
        runner.begin(SessionRunner::Stage::session, person.now);
        person.show();
        person.answer(true);
    }
    EXPECT_EQ(findExisting(form).answered, 1u);
    std::filesystem::remove(records::sidecarPath(table));  // now a row would be lost
    EXPECT_EQ(findExisting(form).state, ExistingSession::State::unusable);
}

TEST(SetupForm, SaysWhatIsMissing) {
    SetupForm form;
    EXPECT_THAT(missing(form), testing::HasSubstr("participant"));
    form.participant = "a b";
    EXPECT_THAT(missing(form), testing::HasSubstr("letters and digits"));
    form.participant = "07";
    EXPECT_EQ(missing(form), "");
    form.seed = "1.5";
    EXPECT_THAT(missing(form), testing::HasSubstr("seed"));
    form.seed = "";
    form.age = "old";
    EXPECT_THAT(missing(form), testing::HasSubstr("age"));
}

/// As the set-up screen does it, with every character.
void type(SetupState& setup, const std::string& participant) {
    for (std::size_t n = 0; n <= participant.size(); ++n) {
        setup.form.participant = participant.substr(0, n);
        lookUp(setup);
    }
}

TEST(SetupForm, DetailsOfOneParticipantDoNotLandOnAnother) {
    const tests::TemporaryFolder folder;
    records::writeParticipant(folder.path(), "01", {.age = 31.5, .gender = "f", .expertise = ""});
    SetupState setup;
    setup.form.dataFolder = folder.path().string();
    type(setup, "01");
    EXPECT_EQ(setup.form.age, "31.5");
    EXPECT_EQ(setup.form.gender, "f");
    setup.form.expertise = "graphics";
    type(setup, "012");
    EXPECT_EQ(setup.form.age, "");
    EXPECT_EQ(setup.form.gender, "");
    EXPECT_EQ(setup.form.expertise, "graphics");  // typed
    EXPECT_EQ(setup.problem, "");
}

TEST(SetupForm, GivenDetailsFillGapsAndContradictNothing) {
    const tests::TemporaryFolder folder;
    records::writeParticipant(folder.path(), "01", {.age = 31, .gender = "", .expertise = ""});
    SetupState setup;
    setup.form.dataFolder = folder.path().string();
    setup.form.participant = "01";
    setup.form.gender = "f";
    setup.form.age = "31.0";
    lookUp(setup);
    EXPECT_EQ(setup.problem, "");
    EXPECT_EQ(setup.form.gender, "f");
    setup.form.age = "40";
    for (int i = 0; i < 2; ++i) {
        lookUp(setup);
        EXPECT_THAT(setup.problem,
                    testing::HasSubstr("participants.tsv: sub-01: age is \"31\" there and \"40\""));
    }
    // What was filled in may be corrected.
    SetupState corrected;
    corrected.form.dataFolder = folder.path().string();
    type(corrected, "01");
    corrected.form.age = "32";
    lookUp(corrected);
    EXPECT_EQ(corrected.problem, "");
}

TEST(SetupForm, ChangesTheTaskAtTheSameCriterion) {
    const Design pair = smallDesign();
    const Design single = withTask(pair, Task::yesNo);
    EXPECT_EQ(validate(single), "");
    EXPECT_NEAR(quest::criterion(single.staircase), quest::criterion(pair.staircase), 1e-12);
    const Design back = withTask(single, Task::twoAfc);
    EXPECT_EQ(validate(back), "");
    EXPECT_NEAR(back.staircase.pThreshold, pair.staircase.pThreshold, 1e-12);
}

TEST(ParticipantsTable, KeepsDetailsBesideWhatOthersWrote) {
    const tests::TemporaryFolder folder;
    std::ofstream(folder.path() / "participants.tsv")
        << "participant_id\thandedness\nsub-01\tleft\n";
    const records::ParticipantDetails details{.age = 31, .gender = "f", .expertise = "graphics"};
    records::writeParticipant(folder.path(), "02", details);
    records::writeParticipant(folder.path(), "01", {.age = 40, .gender = "", .expertise = ""});
    EXPECT_EQ(records::readParticipant(folder.path(), "02"), details);
    EXPECT_EQ(records::readParticipant(folder.path(), "01")->age, 40);
    EXPECT_FALSE(records::readParticipant(folder.path(), "03"));
    std::ifstream file(folder.path() / "participants.tsv");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(text,
              "participant_id\thandedness\tage\tgender\texpertise\n"
              "sub-01\tleft\t40\tn/a\tn/a\n"
              "sub-02\tn/a\t31\tf\tgraphics\n");
    EXPECT_THROW(
        records::writeParticipant(folder.path(), "02", {.age = 500, .gender = "", .expertise = ""}),
        std::invalid_argument);
    EXPECT_THROW(records::writeParticipant(folder.path(), "02",
                                           {.age = {}, .gender = "a\tb", .expertise = ""}),
                 std::invalid_argument);
}

}  // namespace
}  // namespace study_app
