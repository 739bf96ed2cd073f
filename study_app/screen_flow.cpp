// SPDX-License-Identifier: MIT
#include "study_app/screen_flow.h"

namespace study_app {
namespace {

Screen trialsOrEnd(const FlowNeeds& needs) {
    return needs.trialsRemain ? Screen::trials : Screen::end;
}

Screen following(const Flow& flow, const FlowNeeds& needs) {
    switch (flow.screen) {
        case Screen::setup:
            return needs.trialsRemain ? Screen::calibration : Screen::end;
        case Screen::calibration:
            return Screen::instructions;
        case Screen::instructions:
            return needs.practice ? Screen::practice : trialsOrEnd(needs);
        case Screen::practice:
        case Screen::rest:
            return trialsOrEnd(needs);
        case Screen::pause:
            return flow.paused;
        case Screen::end:
            return Screen::closed;
        case Screen::trials:
        case Screen::closed:
            break;
    }
    return flow.screen;
}

Screen preceding(Screen screen) {
    if (screen == Screen::calibration) return Screen::setup;
    if (screen == Screen::instructions) return Screen::calibration;
    return screen;
}

}  // namespace

Flow after(const Flow& flow, FlowEvent event, const FlowNeeds& needs) {
    const Screen at = flow.screen;
    const auto to = [&](Screen screen) { return Flow{screen, flow.paused}; };
    switch (event) {
        case FlowEvent::next:
            return to(following(flow, needs));
        case FlowEvent::back:
            return to(preceding(at));
        case FlowEvent::pause:
            return showsStimuli(at) ? Flow{Screen::pause, at} : flow;
        case FlowEvent::breakDue:
            return at == Screen::trials ? to(Screen::rest) : flow;
        case FlowEvent::sessionFinished:
            return at == Screen::trials ? to(Screen::end) : flow;
        case FlowEvent::undone:
            // From a pause or a break one goes on by one's own decision; the end has none to offer.
            return at == Screen::end ? Flow{Screen::pause, Screen::trials} : flow;
        case FlowEvent::rerun:
            // The observer is not at the keys yet.
            return at == Screen::end ? Flow{Screen::pause, Screen::trials} : flow;
        case FlowEvent::quit:
            return to(Screen::closed);
    }
    return flow;
}

const char* toText(Screen screen) {
    switch (screen) {
        case Screen::setup:
            return "setup";
        case Screen::calibration:
            return "calibration";
        case Screen::instructions:
            return "instructions";
        case Screen::practice:
            return "practice";
        case Screen::trials:
            return "trials";
        case Screen::rest:
            return "break";
        case Screen::pause:
            return "pause";
        case Screen::end:
            return "end";
        case Screen::closed:
            return "closed";
    }
    return "";
}

}  // namespace study_app
