// SPDX-License-Identifier: MIT
// Which screen follows which: a function of values, without a window.
//
//   setup -> calibration -> instructions -> practice -> trials -> end
//                                                        |  ^
//                                                  rest, pause (and back)
//
// A resumed session passes practice again (a short one), a session that is finished already goes
// from the set-up to its end, and a rerun of a flagged condition goes from the end to the trials.
#pragma once

namespace study_app {

enum class Screen { setup, calibration, instructions, practice, trials, rest, pause, end, closed };

enum class FlowEvent {
    next,             ///< the screen's own work is done
    back,             ///< one screen back, before the trials
    pause,            ///< by key, or because a trial was disturbed
    breakDue,         ///< the trials' count asks for a break
    sessionFinished,  ///< no trial is left
    undone,           ///< the last answer was taken back: there is a trial to do again
    rerun,            ///< a flagged condition once more
    quit              ///< stop now, resume another day
};

struct Flow {
    Screen screen = Screen::setup;
    Screen paused = Screen::trials;  ///< where a pause goes back to
    bool operator==(const Flow&) const = default;
};

/// What a session needs of the screens before its trials.
struct FlowNeeds {
    bool practice = true;      ///< a practice rule that is not met yet
    bool trialsRemain = true;  ///< false: the session was finished before
    bool operator==(const FlowNeeds&) const = default;
};

/// An event that means nothing on a screen leaves the flow as it is.
Flow after(const Flow& flow, FlowEvent event, const FlowNeeds& needs = {});

/// A screen on which stimuli are answered.
constexpr bool showsStimuli(Screen screen) {
    return screen == Screen::practice || screen == Screen::trials;
}

/// "trials": for file names and tests.
const char* toText(Screen screen);

}  // namespace study_app
