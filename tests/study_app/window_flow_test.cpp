// SPDX-License-Identifier: MIT
// What the window decides without a window: the order of the screens, a trial in time, the display.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "study_app/display_file.h"
#include "study_app/instructions.h"
#include "study_app/presentation.h"
#include "study_app/screen_flow.h"
#include "study_app/trial_clock.h"
#include "study_app/viewing_geometry.h"
#include "tests/temporary_folder.h"

namespace study_app {
namespace {

using records::Response;
using records::TrialStatus;

Screen afterAll(std::initializer_list<FlowEvent> events, const FlowNeeds& needs = {}) {
    Flow flow;
    for (const FlowEvent event : events) flow = after(flow, event, needs);
    return flow.screen;
}

constexpr FlowEvent next = FlowEvent::next;

TEST(ScreenFlow, LeadsFromSetUpToEnd) {
    EXPECT_EQ(afterAll({next}), Screen::calibration);
    EXPECT_EQ(afterAll({next, next}), Screen::instructions);
    EXPECT_EQ(afterAll({next, next, next}), Screen::practice);
    EXPECT_EQ(afterAll({next, next, next, next}), Screen::trials);
    EXPECT_EQ(afterAll({next, next, next, next, FlowEvent::sessionFinished}), Screen::end);
    EXPECT_EQ(afterAll({next, next, next, next, FlowEvent::sessionFinished, next}), Screen::closed);
}

TEST(ScreenFlow, LeavesOutPracticeThatIsNotNeededAndTrialsThatAreDone) {
    EXPECT_EQ(afterAll({next, next, next}, {.practice = false}), Screen::trials);
    EXPECT_EQ(afterAll({next}, {.trialsRemain = false}), Screen::end);
}

TEST(ScreenFlow, PausesWhereStimuliAreShownAndGoesBackThere) {
    for (const Screen screen : {Screen::practice, Screen::trials}) {
        const Flow paused = after({.screen = screen}, FlowEvent::pause);
        EXPECT_EQ(paused.screen, Screen::pause);
        EXPECT_EQ(after(paused, next).screen, screen);
    }
    for (const Screen screen : {Screen::setup, Screen::calibration, Screen::instructions,
                                Screen::rest, Screen::pause, Screen::end}) {
        EXPECT_EQ(after({.screen = screen}, FlowEvent::pause).screen, screen);
    }
}

TEST(ScreenFlow, EveryScreenCanBeLeftAndEventsOutOfPlaceChangeNothing) {
    for (int s = 0; s < static_cast<int>(Screen::closed); ++s) {
        const Flow flow{.screen = static_cast<Screen>(s)};
        EXPECT_EQ(after(flow, FlowEvent::quit).screen, Screen::closed);
        if (flow.screen != Screen::trials) {
            EXPECT_EQ(after(flow, FlowEvent::breakDue), flow);
            EXPECT_EQ(after(flow, FlowEvent::sessionFinished), flow);
        }
        if (flow.screen != Screen::end) {
            EXPECT_EQ(after(flow, FlowEvent::rerun), flow);
        }
    }
}

TEST(ScreenFlow, WaitsForTheObserverBeforeAConditionIsRunAgain) {
    const Flow flow = after({.screen = Screen::end}, FlowEvent::rerun);
    EXPECT_EQ(flow.screen, Screen::pause);
    EXPECT_EQ(after(flow, FlowEvent::next).screen, Screen::trials);
}

TEST(ScreenFlow, TakesAnAnswerBackAtTheEnd) {
    const Flow flow = after({.screen = Screen::end}, FlowEvent::undone);
    EXPECT_EQ(flow.screen, Screen::pause);
    EXPECT_EQ(after(flow, next).screen, Screen::trials);
}

constexpr Presentation kPace{.blankS = 0.3, .fixationS = 0.5, .tooFastS = 0.15};

TrialClock shownAt(double onset, const Presentation& pace = kPace) {
    TrialClock clock(pace);
    clock.begin(0);
    clock.tick(onset);
    clock.shown(onset);
    return clock;
}

TEST(TrialClock, ShowsBlankThenFixationThenTheStimulus) {
    TrialClock clock(kPace);
    clock.begin(10);
    EXPECT_EQ(clock.phase(), TrialPhase::blank);
    EXPECT_NEAR(clock.secondsUntilChange(10), 0.3, 1e-12);
    clock.tick(10.3);
    EXPECT_EQ(clock.phase(), TrialPhase::fixation);
    EXPECT_FALSE(clock.stimulusDue(10.79));
    EXPECT_TRUE(clock.stimulusDue(10.8));
    clock.shown(10.81);
    EXPECT_EQ(clock.phase(), TrialPhase::stimulus);
    EXPECT_TRUE(std::isinf(clock.secondsUntilChange(11)));
}

TEST(TrialClock, TakesNoAnswerBeforeTheStimulus) {
    TrialClock clock(kPace);
    clock.begin(0);
    EXPECT_FALSE(clock.answer(Response::left, 0.1));
    clock.tick(0.4);
    EXPECT_FALSE(clock.answer(Response::left, 0.5));
    EXPECT_EQ(clock.phase(), TrialPhase::fixation);
}

TEST(TrialClock, TakesOneAnswerTimedFromTheSwap) {
    TrialClock clock = shownAt(1);
    const auto outcome = clock.answer(Response::right, 1.75);
    ASSERT_TRUE(outcome);
    EXPECT_EQ(outcome->status, TrialStatus::ok);
    EXPECT_EQ(outcome->response, Response::right);
    EXPECT_DOUBLE_EQ(outcome->onset, 1);
    EXPECT_DOUBLE_EQ(outcome->responseTimeS.value(), 0.75);
    EXPECT_FALSE(clock.answer(Response::left, 1.8));
}

TEST(TrialClock, HoldsAnAnswerUntilItsPlaceIsGiven) {
    TrialClock clock = shownAt(1);
    const auto answered = clock.answer(Response::seen, 1.75);
    clock.askForPlace(*answered);
    EXPECT_TRUE(std::isinf(clock.secondsUntilChange(2)));
    EXPECT_FALSE(clock.answer(Response::notSeen, 2));
    const auto placed = clock.locate({.xPx = 3, .yPx = 4});
    ASSERT_TRUE(placed);
    EXPECT_EQ(placed->response, Response::seen);
    EXPECT_DOUBLE_EQ(placed->responseTimeS.value(), 0.75);
    EXPECT_EQ(placed->place->xPx, 3);
    EXPECT_FALSE(clock.locate({}));
    TrialClock disturbed = shownAt(1);
    disturbed.askForPlace(*disturbed.answer(Response::seen, 1.75));
    EXPECT_EQ(disturbed.disturb()->status, TrialStatus::repeated);
}

TEST(TrialClock, AnAnswerWithoutItsPlaceCanBeWithdrawn) {
    TrialClock clock = shownAt(1);
    EXPECT_FALSE(clock.withdraw());
    clock.askForPlace(*clock.answer(Response::seen, 1.75));
    EXPECT_TRUE(clock.withdraw());
    EXPECT_FALSE(clock.locate({.xPx = 3, .yPx = 4}));
    const auto other = clock.answer(Response::notSeen, 3);
    ASSERT_TRUE(other);
    EXPECT_EQ(other->response, Response::notSeen);
    EXPECT_DOUBLE_EQ(other->responseTimeS.value(), 2);
}

TEST(TrialClock, MarksWhatIsTooFast) {
    EXPECT_EQ(shownAt(1).answer(Response::left, 1.14)->status, TrialStatus::tooFast);
    EXPECT_EQ(shownAt(1).answer(Response::left, 1.16)->status, TrialStatus::ok);
}

TEST(TrialClock, HoldsTheTimeLimit) {
    Presentation pace = kPace;
    pace.timeLimitS = 2;
    TrialClock clock = shownAt(1, pace);
    EXPECT_NEAR(clock.secondsUntilChange(1.5), 1.5, 1e-12);
    EXPECT_FALSE(clock.tick(2.9));
    const auto outcome = clock.tick(3);
    ASSERT_TRUE(outcome);
    EXPECT_EQ(outcome->status, TrialStatus::repeated);
    EXPECT_FALSE(outcome->response);
    EXPECT_EQ(shownAt(1, pace).answer(Response::left, 3.1)->status, TrialStatus::repeated);
}

TEST(TrialClock, RepeatsADisturbedTrialOnlyWhereItsStimulusWasOn) {
    TrialClock early(kPace);
    early.begin(0);
    EXPECT_FALSE(early.disturb());
    TrialClock on = shownAt(1);
    EXPECT_EQ(on.disturb()->status, TrialStatus::repeated);
    EXPECT_FALSE(on.disturb());
}

TEST(ViewingGeometry, KnowsTheTextbookNumbers) {
    // 1 cm at 57.3 cm is one degree.
    EXPECT_NEAR(arcMinutes(10, 1, 573), 60, 0.01);
    EXPECT_NEAR(pxPerDeg(1, 573), 10, 0.01);
    EXPECT_NEAR(pxPerMmFromCard(323.5), 96 / 25.4, 1e-3);  // a display of 96 pixels per inch
    EXPECT_EQ(greyCodeOfHalfLight(2.2), 186);
    EXPECT_EQ(greyCodeOfHalfLight(1), 128);
    EXPECT_NEAR(gammaFromGreyCode(greyCodeOfHalfLight(1.8)), 1.8, 0.02);  // codes are whole
}

TEST(ViewingGeometry, FindsTheGammaOfADisplayFromThreeReadings) {
    const double gamma = 1.9, black = 0.4, white = 250;
    const double grey = black + (white - black) * std::pow(128 / 255.0, gamma);
    EXPECT_NEAR(gammaFromLuminance({.black = black, .grey = grey, .white = white}).value(), gamma,
                1e-12);
    EXPECT_FALSE(gammaFromLuminance({.black = black, .white = white}));
    EXPECT_FALSE(gammaFromLuminance({.black = black, .grey = white, .white = grey}));
}

TEST(ViewingGeometry, WarnsOfEverythingThatResamples) {
    const DisplayState good{.windowWidth = 1280,
                            .windowHeight = 800,
                            .framebufferWidthPx = 1280,
                            .framebufferHeightPx = 800,
                            .modeWidthPx = 1920,
                            .modeHeightPx = 1080,
                            .nativeWidthPx = 1920,
                            .nativeHeightPx = 1080};
    EXPECT_EQ(displayWarnings(good), "");
    DisplayState scaled = good;
    scaled.contentScale = 2;
    EXPECT_THAT(displayWarnings(scaled), testing::HasSubstr("scaled by 2"));
    DisplayState low = good;
    low.modeWidthPx = 1280;
    EXPECT_THAT(displayWarnings(low), testing::HasSubstr("below its native 1920 x 1080"));
    DisplayState resampled = good;
    resampled.framebufferWidthPx = 2560;
    EXPECT_THAT(displayWarnings(resampled), testing::HasSubstr("resamples"));
}

TEST(DisplayFile, KeepsOneProfilePerMonitorAndResolution) {
    const tests::TemporaryFolder folder;
    const auto file = folder.path() / "config" / "displays.json";
    EXPECT_TRUE(readDisplays(file).empty());
    DisplayProfile desk{.name = "desk", .widthPx = 1920, .heightPx = 1080, .pxPerMm = 3.7};
    DisplayProfile low{.name = "desk", .widthPx = 1280, .heightPx = 720, .distanceMm = 600};
    storeDisplay(file, desk);
    storeDisplay(file, low);
    desk.gamma = 2.2;
    desk.luminance = {.black = 0.3, .white = 120};
    storeDisplay(file, desk);
    EXPECT_EQ(readDisplays(file).size(), 2u);
    EXPECT_EQ(findDisplay(readDisplays(file), desk), desk);
    EXPECT_EQ(findDisplay(readDisplays(file), low), low);
    desk.name = "other";
    EXPECT_FALSE(findDisplay(readDisplays(file), desk));
    desk.pxPerMm = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(storeDisplay(file, desk), std::invalid_argument);
}

TEST(DisplayFile, RefusesAFileOfAnotherKind) {
    const tests::TemporaryFolder folder;
    const auto file = folder.path() / "displays.json";
    std::ofstream(file) << R"({"schema": {"name": "stairwell slope", "major": 1, "minor": 0}})";
    EXPECT_THROW(readDisplays(file), std::runtime_error);
}

TEST(Presentation, ReadsWhatIsGivenAndKeepsTheRest) {
    const auto json = nlohmann::json::parse(
        R"({"blank_s": 0, "time_limit_s": 3, "between": "mask", "practice": {"correct": 2}})");
    const Presentation p = presentationFromJson(json, "pace.json");
    EXPECT_EQ(p.blankS, 0);
    EXPECT_EQ(p.timeLimitS, 3);
    EXPECT_EQ(p.between, Between::mask);
    EXPECT_EQ(p.practice.correct, 2);
    EXPECT_EQ(p.practice.ofLast, Presentation{}.practice.ofLast);
    EXPECT_EQ(p.fixationS, Presentation{}.fixationS);
    EXPECT_EQ(validate(Presentation{}), "");
}

TEST(Presentation, NamesTheFieldTheValueAndTheRule) {
    const auto problem = [](const char* text) -> std::string {
        try {
            presentationFromJson(nlohmann::json::parse(text), "pace.json");
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return {};
    };
    EXPECT_THAT(problem(R"({"blank_s": -1})"), testing::HasSubstr("blank_s: -1: must be"));
    EXPECT_THAT(problem(R"({"blanks": 1})"), testing::HasSubstr("blanks"));
    EXPECT_THAT(problem(R"({"practice": {"correct": 6}})"),
                testing::HasSubstr("practice.correct: 6: must be at most of_last"));
    EXPECT_THAT(problem(R"({"time_limit_s": 0.1})"), testing::HasSubstr("time_limit_s: 0.1"));
}

TEST(Instructions, AreParagraphsHeadingsAndExamples) {
    using Kind = InstructionBlock::Kind;
    const Instructions blocks =
        parseInstructions("# Hello\nA line\nand its end.\n\n[examples]\r\n\nLast");
    const Instructions expected{{Kind::heading, "Hello"},
                                {Kind::paragraph, "A line and its end."},
                                {Kind::examples, ""},
                                {Kind::paragraph, "Last"}};
    EXPECT_EQ(blocks, expected);
}

TEST(Instructions, AreShippedForEveryTask) {
    Design design;
    EXPECT_FALSE(readInstructions(shippedInstructions(design)).empty());
    design.task = records::Task::yesNo;
    const auto keys = shippedInstructions(design);
    EXPECT_FALSE(readInstructions(keys).empty());
    design.localise = true;
    EXPECT_NE(shippedInstructions(design), keys);
    EXPECT_FALSE(readInstructions(shippedInstructions(design)).empty());
    design.localise = false;
    design.frames.emplace();
    EXPECT_NE(shippedInstructions(design), keys);
    EXPECT_FALSE(readInstructions(shippedInstructions(design)).empty());
    design.task = records::Task::twoAfc;
    EXPECT_FALSE(readInstructions(shippedInstructions(design)).empty());
}

}  // namespace
}  // namespace study_app
