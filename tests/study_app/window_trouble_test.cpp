// SPDX-License-Identifier: MIT
// What goes wrong in front of the window and behind it: impatient hands, a disturbed screen, disks,
// clocks, a second program on the same session.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>

#include "records/session_sidecar.h"
#include "study_app/recorded_session.h"
#include "tests/run_command.h"
#include "tests/study_app/window_session.h"

namespace tests {
namespace {

using records::Trial;
using records::TrialStatus;
using testing::HasSubstr;

class WindowTrouble : public WindowSession {
  protected:
    /// Beside the first program's files.
    std::filesystem::path secondDesk() const {
        std::filesystem::create_directories(file("second"));
        return file("second");
    }
};

TEST_F(WindowTrouble, MashingKeysGivesOneAnswerPerTrial) {
    WindowPerson person(server_, folder_.path(), arguments(R"({"blank_s": 0.3, "fixation_s": 0.2,
        "too_fast_s": 0, "break_every_trials": 0, "practice": {"correct": 0}})"));
    agree(person);
    person.press("Left Right Left");  // before anything is on screen
    person.waitFor("stimulus 1");
    person.press("Right Left Left Right");
    person.waitFor("stimulus 2");
    const auto recorded = rows();
    ASSERT_EQ(recorded.size(), 1u);
    EXPECT_EQ(recorded[0].response, records::Response::right);
}

TEST_F(WindowTrouble, AKeyThatNobodyKnowsIsNoAnswer) {
    WindowPerson person(server_, folder_.path(), arguments());
    agree(person);
    person.waitFor("stimulus 1");
    person.press("XF86AudioRaiseVolume XF86AudioMute Right");
    person.waitFor("stimulus 2");
    ASSERT_EQ(rows().size(), 1u);
    EXPECT_EQ(rows()[0].response, records::Response::right);
}

TEST_F(WindowTrouble, ASecondClickOnTakeBackMeetsNoOtherButton) {
    WindowPerson person(server_, folder_.path(), arguments());
    agree(person);
    answer(person, "left");
    person.waitFor("stimulus");
    person.press("Escape");
    person.waitFor("screen pause");
    // Beside "Go on" at the foot of the page, which is 760 px wide.
    person.xdotool({"mousemove", "450", "727", "click", "--repeat", "3", "--delay", "80", "1"});
    person.press("Return");
    person.waitFor("screen trials");
    person.waitFor("stimulus");
    EXPECT_EQ(rows()[0].status, TrialStatus::undone);
}

TEST_F(WindowTrouble, StaysPausedUntilALostDataFolderIsBack) {
    WindowPerson person(server_, folder_.path(), arguments());
    agree(person);
    answer(person, "left");
    person.waitFor("stimulus 2");
    std::filesystem::rename(data(), file("away"));
    person.press("Right");
    EXPECT_THAT(person.waitFor("problem"), HasSubstr(table().string() + ": is missing"));
    for (const char* key : {"BackSpace", "Return"}) {
        person.press(key);
        if (std::string(key) == "Return") {
            EXPECT_THAT(person.waitFor("problem"), HasSubstr("cannot go on"));
        }
        EXPECT_FALSE(std::filesystem::exists(data()));
    }
    std::filesystem::rename(file("away"), data());
    person.press("Return");
    EXPECT_EQ(answer(person, "left"), "row 2 ok");
    EXPECT_EQ(study_app::replayTable(table()).session.answered(), 2u);
}

TEST_F(WindowTrouble, MarksWhatIsTooFastToBeAnAnswer) {
    WindowPerson person(server_, folder_.path(), arguments(R"({"blank_s": 0.02, "fixation_s": 0.05,
        "too_fast_s": 2, "break_every_trials": 0, "practice": {"correct": 0}})"));
    agree(person);
    EXPECT_EQ(answer(person, "left"), "row 1 too_fast");
    EXPECT_EQ(answer(person, "left"), "row 2 too_fast");
    EXPECT_EQ(rows()[0].condition, rows()[1].condition);
}

TEST_F(WindowTrouble, RepeatsATrialInWhichTheWindowWasDisturbed) {
    WindowPerson person(server_, folder_.path(), arguments());
    agree(person);
    person.waitFor("stimulus");
    person.xdotool({"windowsize", person.window(), "1000", "700"});
    person.waitFor("screen pause");
    EXPECT_EQ(person.waitFor("row"), "row 1 repeated");
    person.press("Return");
    EXPECT_EQ(answer(person, "left"), "row 2 ok");
}

TEST_F(WindowTrouble, DoesNotShowStimuliThatTheWindowCannotHold) {
    WindowPerson person(server_, folder_.path(), arguments());
    person.waitFor("screen instructions");
    person.xdotool({"windowsize", "--sync", person.window(), "500", "400"});
    person.press("Return");
    person.waitFor("screen pause");
    person.xdotool({"windowsize", person.window(), "700", "400"});
    person.press("Return");
    EXPECT_EQ(answer(person, "left"), "row 1 ok");
}

TEST_F(WindowTrouble, SaysAtTheSetUpThatTheWindowIsTooSmallForTheDesign) {
    auto with = arguments();
    with.insert(with.end(), {"--window-size", "500", "400"});
    {
        WindowPerson person(server_, folder_.path(), with);
        EXPECT_EQ(person.exitCode(), 1);
        EXPECT_THAT(person.errors(), HasSubstr("The stimuli need 520 x 240 pixels, the window has "
                                               "500 x 400"));
    }
    std::erase(with, "--start");
    WindowPerson person(server_, folder_.path(), with);
    person.waitFor("screen setup");
    person.press("Return");
    EXPECT_THAT(person.waitFor("problem"), HasSubstr("The stimuli need 520 x 240 pixels"));
    person.xdotool({"windowsize", "--sync", person.window(), "700", "400"});
    person.press("Return");
    person.waitFor("screen calibration");
    EXPECT_FALSE(std::filesystem::exists(data()));
}

TEST_F(WindowTrouble, DoesNotBeginAnewWhereAResumedSessionsFolderWentAwayBeforeConsent) {
    {
        WindowPerson person(server_, folder_.path(), arguments());
        agree(person);
        for (int i = 0; i < 3; ++i) answer(person, "left");
        person.waitFor("stimulus 4");
    }
    WindowPerson person(server_, folder_.path(), arguments());
    person.waitFor("screen instructions");
    std::filesystem::rename(data(), file("away"));
    person.press("Return");
    EXPECT_THAT(person.waitFor("problem"), HasSubstr("must hold the 3 that were there"));
    person.press("Return");  // whoever does not read it
    EXPECT_THAT(person.waitFor("problem"), HasSubstr("must hold the 3 that were there"));
    EXPECT_FALSE(std::filesystem::exists(data()));
    std::filesystem::rename(file("away"), data());
    for (const char* screen : {"screen calibration", "screen instructions", "screen trials"}) {
        person.press("Return");
        person.waitFor(screen);
    }
    EXPECT_EQ(answer(person, "left"), "row 4 ok");
}

TEST_F(WindowTrouble, RepeatsATrialDuringWhichADisplayWasUnplugged) {
    WindowPerson person(server_, folder_.path(), arguments());
    agree(person);
    person.waitFor("stimulus");
    const auto screen = [&](const std::string& state) {
        person.onDisplay("xrandr", {"--current", "--fb", "1280x800", "--output", "screen", state});
    };
    screen("--off");
    person.waitFor("screen pause");
    EXPECT_EQ(person.waitFor("row"), "row 1 repeated");
    screen("--auto");
    person.press("Return");
    EXPECT_EQ(answer(person, "left"), "row 2 ok");
}

TEST_F(WindowTrouble, TakesAFolderThatCannotBeWrittenAsAProblemOfTheSetUp) {
    auto with = arguments();
    write("file", "not a folder");
    *(std::ranges::find(with, data())) = file("file/study").string();
    WindowPerson person(server_, folder_.path(), with);
    EXPECT_EQ(person.exitCode(), 1);
    EXPECT_THAT(
        person.errors(),
        HasSubstr("file/study: cannot be written: " + file("file").string() + " is no folder"));
}

TEST_F(WindowTrouble, GoesBackToTheSetUpWhereTheSessionCannotBegin) {
    WindowPerson person(server_, folder_.path(), arguments());
    person.waitFor("screen instructions");
    write("data", "a file took the folder's place");
    person.press("Return");
    person.waitFor("screen setup");
    EXPECT_THAT(person.waitFor("problem"), HasSubstr(data()));
    std::filesystem::remove(data());
    for (const char* screen : {"screen calibration", "screen instructions", "screen trials"}) {
        person.press("Return");
        person.waitFor(screen);
    }
    EXPECT_EQ(answer(person, "left"), "row 1 ok");
}

TEST_F(WindowTrouble, SaysThatTheDiskIsFullAndGoesOnOnceThereIsRoom) {
    WindowPerson person(server_, folder_.path(), arguments());
    agree(person);
    for (int i = 0; i < 3; ++i) answer(person, "left");
    person.waitFor("stimulus 4");
    // Room for a part of the next row.
    person.limitFileSize(std::filesystem::file_size(table()) + 20);
    person.press("Right");
    person.waitFor("screen pause");
    EXPECT_THAT(person.waitFor("problem"), HasSubstr("could not be saved"));
    EXPECT_EQ(rows().size(), 3u);
    person.limitFileSize(RLIM_INFINITY);
    person.press("Return");
    EXPECT_EQ(answer(person, "left"), "row 4 ok");
    EXPECT_EQ(study_app::replayTable(table()).session.answered(), 4u);
}

TEST_F(WindowTrouble, TimesGoOnWhereTheClockOfTheMachineGoesBack) {
    const std::map<std::string, std::string> backwards{
        {"LD_PRELOAD", STAIRWELL_BACKWARD_CLOCK},
        {"ASAN_OPTIONS", "verify_asan_link_order=0:detect_leaks=0"}};
    for (int sitting = 0; sitting < 2; ++sitting) {
        WindowPerson person(server_, folder_.path(), arguments(), backwards);
        agree(person);
        for (int i = 0; i < 4; ++i) answer(person, "left");
    }
    const auto recorded = rows();
    ASSERT_EQ(recorded.size(), 8u);
    for (std::size_t i = 0; i < recorded.size(); ++i) {
        EXPECT_GT(recorded[i].responseTimeS.value(), 0);
        EXPECT_LT(recorded[i].responseTimeS.value(), 30);  // as long as any test waits
        if (i == 0) continue;
        EXPECT_GT(recorded[i].onsetS.value(),
                  recorded[i - 1].onsetS.value() + recorded[i - 1].responseTimeS.value());
    }
}

TEST_F(WindowTrouble, RefusesASecondProgramOnTheSameSession) {
    WindowPerson first(server_, folder_.path(), arguments());
    first.waitFor("screen instructions");
    // Before either has begun, both may read.
    const XServer other;  // keys go to a window by its name
    WindowPerson reader(other, secondDesk(), arguments());
    reader.waitFor("screen instructions");
    first.press("Return");
    answer(first, "left");
    reader.press("Return");
    reader.waitFor("screen setup");
    EXPECT_THAT(reader.waitFor("problem"), HasSubstr("is open in another program"));
    WindowPerson late(other, secondDesk(), arguments());
    EXPECT_EQ(late.exitCode(), 1);
    EXPECT_THAT(late.errors(), HasSubstr("is open in another program"));
    EXPECT_EQ(rows().size(), 1u);
}

TEST_F(WindowTrouble, RefusesASessionThatBeganWithAnotherDesignOrSeed) {
    {
        WindowPerson person(server_, folder_.path(), arguments());
        agree(person);
        answer(person, "left");
    }
    const auto refusal = [&](const std::vector<std::string>& with) {
        WindowPerson person(server_, folder_.path(), with);
        EXPECT_EQ(person.exitCode(), 1);
        return person.errors();
    };
    EXPECT_THAT(refusal(arguments(kQuickPace, 3)),
                testing::AllOf(HasSubstr("trials_per_condition"), HasSubstr("only as it began")));
    auto otherSeed = arguments();
    *(std::ranges::find(otherSeed, "7")) = "8";
    EXPECT_THAT(refusal(otherSeed), testing::AllOf(HasSubstr("seed"), HasSubstr("7")));
    auto otherTask = arguments();
    otherTask.insert(otherTask.end(), {"--task", "yes_no"});
    EXPECT_THAT(refusal(otherTask), HasSubstr("task"));
    EXPECT_EQ(rows().size(), 1u);
}

TEST_F(WindowTrouble, RefusesASessionOfAnotherMajorVersion) {
    {
        WindowPerson person(server_, folder_.path(), arguments());
        agree(person);
        answer(person, "left");
    }
    const auto sidecar = records::sidecarPath(table());
    std::ifstream in(sidecar);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::string major = "\"major\": ";
    text.replace(text.find(major) + major.size(), 1, "9");
    std::ofstream(sidecar) << text;
    WindowPerson person(server_, folder_.path(), arguments());
    EXPECT_EQ(person.exitCode(), 1);
    EXPECT_THAT(person.errors(), testing::AllOf(HasSubstr(sidecar.string()), HasSubstr("9")));
}

TEST_F(WindowTrouble, TheExperimentersWindowTakesNeitherKeysNorTrials) {
    const XServer wide("2600x900x24");
    WindowPerson person(wide, folder_.path(), arguments());
    agree(person);
    EXPECT_EQ(answer(person, "left"), "row 1 ok");
    person.waitFor("stimulus 2");
    person.press("F2");
    person.xdotool({"search", "--sync", "--onlyvisible", "--name", "Stairwell experimenter"});
    person.press("Right");
    EXPECT_EQ(person.waitFor("row"), "row 2 ok");
    EXPECT_EQ(answer(person, "left"), "row 3 ok");
    person.waitFor("stimulus 4");
    person.press("F2 Left");
    EXPECT_EQ(person.waitFor("row"), "row 4 ok");
}

TEST(WindowProgram, SaysWhatIsMissingInOneSentence) {
    const TemporaryFolder folder;
    ::unsetenv("DISPLAY");
    ::unsetenv("WAYLAND_DISPLAY");
    const CommandResult noDisplay = runProgram("study_app", {"--data", folder.path().string()});
    EXPECT_EQ(noDisplay.exitCode, 1);
    EXPECT_THAT(noDisplay.err, testing::HasSubstr("DISPLAY"));
    const XServer server;
    WindowPerson person(server, folder.path(), {"--start", "--data", folder.path().string()});
    EXPECT_EQ(person.exitCode(), 1);
    EXPECT_THAT(person.errors(), testing::HasSubstr("Give the participant an id"));
}

}  // namespace
}  // namespace tests
