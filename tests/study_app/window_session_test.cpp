// SPDX-License-Identifier: MIT
// Whole sessions as a person sits through them: a real window under Xvfb, real key events. Every
// stimulus is read back from the framebuffer and compared with its codes (--verify-pixels), so any
// session that ends well has shown what was computed.
#include "tests/study_app/window_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>

#include "records/trial_table.h"
#include "study_app/design_file.h"
#include "study_app/recorded_session.h"
#include "study_app/robot_observer.h"
#include "study_app/trial_stimulus.h"
#include "tests/study_app/frame_folder.h"
#include "tests/temporary_folder.h"

namespace tests {
namespace {

using records::Trial;
using records::TrialStatus;

TEST_F(WindowSession, QuickDesignFromSetUpToEndRecordsWhatWasPressed) {
    const std::string pace = write("pace.json", R"({"blank_s": 0.02, "fixation_s": 0.05,
        "too_fast_s": 0, "feedback_s": 0.02, "break_every_trials": 40, "break_minimum_s": 0})");
    WindowPerson person(server_, folder_.path(),
                        {"--design", "quick", "--data", data(), "--participant", "01", "--age",
                         "33", "--presentation", pace});
    std::vector<std::string> pressed, screens;
    for (std::string event; event != "screen end";) {
        event = person.nextEvent();
        const bool practice = event.starts_with("practice");
        if (practice || event.starts_with("stimulus")) {
            // Right in practice; in the trials left and right in turn.
            const bool left = practice ? event.ends_with("left") : pressed.size() % 2 == 0;
            person.press(left ? "Left" : "Right");
            if (!practice) pressed.push_back(left ? "left" : "right");
        } else if (event.starts_with("screen")) {
            screens.push_back(event.substr(7));
            if (event != "screen trials" && event != "screen practice" && event != "screen end") {
                person.press("Return");
            }
        }
    }
    person.press("Return");
    EXPECT_EQ(person.exitCode(), 0) << person.errors();
    EXPECT_THAT(screens, testing::ElementsAre("setup", "calibration", "instructions", "practice",
                                              "practice-over", "trials", "break", "trials", "end"));
    const auto recorded = rows();
    ASSERT_EQ(recorded.size(), pressed.size());
    for (std::size_t i = 0; i < recorded.size(); ++i) {
        EXPECT_EQ(records::toText(recorded[i].response.value()), pressed[i]);
        EXPECT_EQ(recorded[i].status, TrialStatus::ok);
        EXPECT_GT(recorded[i].responseTimeS.value(), 0);
    }
    EXPECT_TRUE(study_app::replayTable(table()).session.finished());
    std::ifstream participants(folder_.path() / "data" / "participants.tsv");
    const std::string text{std::istreambuf_iterator<char>(participants), {}};
    EXPECT_THAT(text, testing::HasSubstr("sub-01\t33"));
}

TEST_F(WindowSession, YesNoTaskTakesTheSameKeys) {
    auto with = arguments();
    with.insert(with.end(), {"--task", "yes_no"});
    WindowPerson person(server_, folder_.path(), with);
    agree(person);
    answerAll(person);
    for (const Trial& row : rows()) EXPECT_EQ(row.response, records::Response::notSeen);
}

TEST_F(WindowSession, AClickSaysWhereTheStepsAre) {
    const auto with = arguments();
    std::ifstream tiny(file("tiny.json"));
    std::string design{std::istreambuf_iterator<char>(tiny), {}};
    design.insert(design.rfind('}'), R"(, "task": "yes_no", "localise": true)");
    write("tiny.json", design);
    WindowPerson person(server_, folder_.path(), with);
    agree(person);
    const auto click = [&](int x, int y) {
        person.xdotool({"mousemove", std::to_string(x), std::to_string(y), "click", "1"});
    };
    // The image has 240 x 240 pixels in the middle of 1280 x 800.
    person.waitFor("stimulus");
    click(300, 400);  // beside it
    click(520 + 100, 280 + 31);
    EXPECT_EQ(person.waitFor("row"), "row 1 ok");
    person.waitFor("stimulus");
    person.press("Right");
    person.waitFor("place 2");
    click(520 + 7, 280 + 200);
    EXPECT_EQ(person.waitFor("row"), "row 2 ok");
    person.waitFor("stimulus");
    person.press("Right");
    person.waitFor("place 3");
    person.press("BackSpace Left");  // not seen after all
    EXPECT_EQ(person.waitFor("row"), "row 3 ok");
    person.waitFor("stimulus");
    person.press("Right");
    person.waitFor("place 4");
    person.press("Escape");
    EXPECT_EQ(person.waitFor("row"), "row 4 repeated");
    const auto recorded = rows();
    EXPECT_EQ(recorded[0].response, records::Response::seen);
    EXPECT_EQ(recorded[0].clickXPx, 100);
    EXPECT_EQ(recorded[0].clickYPx, 31);
    EXPECT_EQ(recorded[1].clickXPx, 7);
    EXPECT_EQ(recorded[1].clickYPx, 200);
    EXPECT_EQ(recorded[2].response, records::Response::notSeen);
    EXPECT_FALSE(recorded[2].clickXPx);
    EXPECT_FALSE(recorded[3].response);
    EXPECT_EQ(study_app::replayTable(table()).session.answered(), 3u);
}

TEST_F(WindowSession, ShowsRenderedFramesAndPractisesWithThePlainest) {
    const std::vector<records::FramePair> pairs = writeFrameFolder(file("frames"), {0.5, 2, 4, 8});
    const std::string design = write("frames.json", R"({
        "schema": {"name": "stairwell design", "major": 1, "minor": 0}, "name": "frames",
        "frames": "frames", "trials_per_condition": 4, "catch_share": 0})");
    WindowPerson person(
        server_, folder_.path(),
        {"--design", design, "--data", data(), "--participant", "01", "--seed", "7", "--start",
         "--presentation", write("pace.json", R"({"blank_s": 0.02, "fixation_s": 0.05,
                             "too_fast_s": 0, "feedback_s": 0.02, "break_every_trials": 0,
                             "practice": {"correct": 2, "of_last": 2}})")});
    agree(person);
    for (int i = 0; i < 2; ++i) {
        const bool left = person.waitFor("practice").ends_with("left");
        person.press(left ? "Left" : "Right");
    }
    person.waitFor("screen practice-over");
    person.press("Return");
    answerAll(person);  // every frame is read back from the screen
    person.press("Return");
    EXPECT_EQ(person.exitCode(), 0) << person.errors();
    for (const Trial& row : rows()) {
        EXPECT_TRUE(std::ranges::any_of(
            pairs, [&](const records::FramePair& pair) { return pair.artifact == row.frame; }));
    }
    EXPECT_TRUE(study_app::replayTable(table()).session.finished());
}

TEST_F(WindowSession, BackspaceTakesTheLastAnswerBack) {
    WindowPerson person(server_, folder_.path(), arguments());
    agree(person);
    for (int i = 0; i < 3; ++i) answer(person, "right");
    person.waitFor("stimulus");
    person.press("BackSpace");
    EXPECT_EQ(person.waitFor("undo"), "undo 3");
    answerAll(person);
    const auto recorded = rows();
    const auto count = [&](TrialStatus status) {
        return std::ranges::count_if(recorded, [&](const Trial& t) { return t.status == status; });
    };
    EXPECT_EQ(recorded[2].status, TrialStatus::undone);
    EXPECT_EQ(recorded[3].status, TrialStatus::undone);  // was on screen, derived from row 3
    EXPECT_EQ(recorded[4].condition, recorded[2].condition);
    EXPECT_EQ(count(TrialStatus::ok), 10);
    EXPECT_TRUE(study_app::replayTable(table()).session.finished());
}

TEST_F(WindowSession, PausesQuitsAndResumesWhereItWas) {
    {
        WindowPerson person(server_, folder_.path(), arguments());
        agree(person);
        for (int i = 0; i < 3; ++i) answer(person, "left");
        person.waitFor("stimulus");
        person.press("Escape");
        person.waitFor("screen pause");
        person.press("Return");
        answer(person, "left");
        person.waitFor("stimulus");
        person.press("Escape");
        person.waitFor("screen pause");
        person.press("q");
        EXPECT_EQ(person.exitCode(), 0) << person.errors();
    }
    EXPECT_EQ(rows()[3].status, TrialStatus::repeated);
    EXPECT_EQ(study_app::replayTable(table()).session.answered(), 4u);
    WindowPerson person(server_, folder_.path(), arguments());
    agree(person);
    answerAll(person);
    EXPECT_TRUE(study_app::replayTable(table()).session.finished());
}

TEST_F(WindowSession, PausesWhereAFrameIsMissingAndGoesOnOnceItIsBack) {
    writeFrameFolder(file("frames"), {0.5, 2, 4, 8});
    const std::string design = write("frames.json", R"({
        "schema": {"name": "stairwell design", "major": 1, "minor": 0}, "name": "frames",
        "frames": "frames", "trials_per_condition": 8, "catch_share": 0})");
    WindowPerson person(server_, folder_.path(),
                        {"--design", design, "--data", data(), "--participant", "01", "--seed", "5",
                         "--start", "--presentation", write("pace.json", kQuickPace)});
    agree(person);
    person.waitFor("stimulus 1");
    std::filesystem::rename(file("frames"), file("away"));
    person.press("Left");
    // What was read ahead is still shown.
    std::string event;
    while (!(event = person.nextEvent()).starts_with("problem")) {
        if (event.starts_with("stimulus")) person.press("Left");
    }
    EXPECT_THAT(event, testing::AllOf(testing::HasSubstr("The next trial cannot be shown"),
                                      testing::HasSubstr("no such file")));
    const std::size_t before = rows().size();
    person.press("Return");
    person.waitFor("problem");
    EXPECT_EQ(rows().size(), before);
    std::filesystem::rename(file("away"), file("frames"));
    person.press("Return");
    answerAll(person);
    EXPECT_TRUE(study_app::replayTable(table()).session.finished());
    EXPECT_EQ(rows().size(), 8u);
}

/// What the robot must have answered, by the stimulus images alone; nothing where it drew a coin.
std::optional<records::Response> predicted(const Trial& row, const study_app::Design& design) {
    const study_app::TrialImages images = study_app::trialImages(row, design);
    const double difference =
        study_app::contourBend(images.left) - study_app::contourBend(images.right);
    if (std::abs(difference) < study_app::kNoticeablePx) return {};
    return difference > 0 ? records::Response::left : records::Response::right;
}

/// The largest radius, on a grid of 3 %, at which the robot still notices a condition's artifact,
/// from the stimulus images alone.
double noticedUpTo(const study_app::Design& design, const study_app::Condition& condition) {
    Trial trial;
    trial.pattern = condition.silhouette.pattern;
    trial.artifactPx = condition.artifactPx;
    trial.kernel = condition.kernel;
    trial.encoding = design.encoding;
    trial.side = "left";
    double noticed = 0;
    for (double r = 0.5 * condition.artifactPx; r < design.radius.max; r *= 1.03) {
        trial.filterRadiusPx = r;
        const study_app::TrialImages images = study_app::trialImages(trial, design);
        const double difference =
            study_app::contourBend(images.left) - study_app::contourBend(images.right);
        if (difference > study_app::kNoticeablePx) noticed = r;
    }
    return noticed;
}

TEST_F(WindowSession, ARobotThatSeesOnlyPixelsHasTheThresholdsOfTheStimuli) {
    const std::string pace = write("pace.json", R"({"blank_s": 0, "fixation_s": 0,
        "too_fast_s": 0, "feedback_s": 0, "break_every_trials": 0})");
    WindowPerson person(server_, folder_.path(),
                        {"--design", "quick", "--data", data(), "--participant", "01", "--seed",
                         "3", "--robot", "0", "--presentation", pace});
    while (person.nextEvent() != "screen end") {  // a time limit for each event, not for all
    }
    EXPECT_EQ(person.exitCode(), 0) << person.errors();
    const study_app::Session session = study_app::replayTable(table()).session;
    int seen = 0;
    for (const Trial& row : rows()) {
        const auto answer = predicted(row, session.design());
        if (!answer) continue;
        ++seen;
        EXPECT_EQ(row.response, answer) << "trial " << row.number;
    }
    EXPECT_GT(seen, 20);
    std::map<std::string, double> measured;
    for (std::size_t k = 0; k < session.conditions().size(); ++k) {
        const double radius = study_app::thresholds(session)[k].radiusPx;
        const double direct = noticedUpTo(session.design(), session.conditions()[k]);
        // Every answer was held against the images above, exactly. This is about the staircase:
        // after 15 trials a threshold is off by .10 log10 (sd; `study_app --check quick`), so 2 sd.
        EXPECT_NEAR(std::log10(radius), std::log10(direct), 0.2) << session.conditions()[k].name;
        measured[session.conditions()[k].name] = radius;
    }
    EXPECT_LT(measured["stair-a10-lit1"], measured["stair-a20-lit1"]);
    EXPECT_LT(measured["step-a10-lit1"], measured["step-a20-lit1"]);
}

TEST_F(WindowSession, WaitsWithoutUsingTheProcessor) {
    WindowPerson person(server_, folder_.path(), arguments());
    agree(person);
    person.waitFor("stimulus");
    const double before = person.processorSeconds();
    ::usleep(2000000);
    // Less than 5 % of a core, whatever else the machine does: it is the program's own time.
    EXPECT_LT(person.processorSeconds() - before, 0.1);
}

}  // namespace
}  // namespace tests
