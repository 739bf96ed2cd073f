// SPDX-License-Identifier: MIT
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "study_app/study_window.h"

namespace study_app {

/// Presses what the robot has decided on, and Return wherever a person would read first.
void StudyWindow::actAsRobot(double now) {
    if (!robot_) return;
    if (const auto side = robot_->press(now)) {
        const int key = *side == Side::left ? GLFW_KEY_LEFT : GLFW_KEY_RIGHT;
        window_.input().presses.push_back({.key = key});
    } else if (state_.answering() && state_.runner->phase() == TrialPhase::place) {
        // Every edge passes near the middle.
        const Input::Click middle{window_.widthPx() / 2.0, window_.heightPx() / 2.0};
        window_.input().presses.push_back({.click = middle});
    } else if (!state_.answering() && framesWanted_ == 0) {
        window_.input().presses.push_back({.key = GLFW_KEY_ENTER});
    }
}

void StudyWindow::handleInput(double now) {
    panel_.takeInput();
    Input& input = window_.input();
    if (input.exposed || !input.presses.empty() || !input.disturbance.empty()) settle();
    if (input.closeRequested) return act(Request::quit, now);
    if (!input.disturbance.empty()) handleDisturbance();
    for (const Input::Press& press : input.presses) handlePress(press, now);
    input.clear();
}

void StudyWindow::handleDisturbance() {
    if (!state_.answering()) return;
    interrupt("The trial was interrupted: " + window_.input().disturbance + ".");
}

void StudyWindow::handlePress(const Input::Press& press, double now) {
    if (press.click) {
        if (state_.answering()) clickInTrials(*press.click, now);
        return;
    }
    switch (press.key) {
        case GLFW_KEY_F2:
            if (state_.flow.screen == Screen::end) {
                state_.resultsShown = !state_.resultsShown;
            } else {
                panel_.toggle();
            }
            return;
        case GLFW_KEY_ENTER:
        case GLFW_KEY_KP_ENTER:
            returnPressed_ = true;
            return;
        default:
            return state_.answering() ? pressInTrials(press.key, now)
                                      : pressOffTrials(press.key, now);
    }
}

void StudyWindow::answer(Side side, double now) {
    if (const auto event = state_.runner->answer(side, now)) actOnEvent(*event, now);
}

void StudyWindow::clickInTrials(const Input::Click& click, double now) {
    if (localises()) return locate(click, now);
    answer(click.xPx < window_.widthPx() / 2.0 ? Side::left : Side::right, now);
}

void StudyWindow::pressInTrials(int key, double now) {
    switch (key) {
        case GLFW_KEY_LEFT:
            return answer(Side::left, now);
        case GLFW_KEY_RIGHT:
            return answer(Side::right, now);
        case GLFW_KEY_ESCAPE:
        case GLFW_KEY_P:
            return interrupt("");
        case GLFW_KEY_BACKSPACE:
            if (state_.runner->withdrawAnswer()) return settle();
            if (state_.flow.screen == Screen::trials && state_.runner->canUndo()) undo(now);
            return;
        default:
            return;
    }
}

bool StudyWindow::localises() const {
    return state_.runner->session().design().localise;
}

/// A click beside the image says nothing.
void StudyWindow::locate(const Input::Click& click, double now) {
    const Design& design = state_.runner->session().design();
    const cv::Point at = stimulusOrigin(window_, stimulusArea(design.task, design.windowPx));
    const Place place{click.xPx - at.x, click.yPx - at.y};
    const auto inside = [&](double px) { return px >= 0 && px <= design.windowPx; };
    if (!inside(place.xPx) || !inside(place.yPx)) return;
    if (const auto event = state_.runner->locate(place, now)) actOnEvent(*event, now);
}

void StudyWindow::pressOffTrials(int key, double now) {
    const Screen screen = state_.flow.screen;
    const bool resting = screen == Screen::rest || screen == Screen::pause;
    if (key == GLFW_KEY_Q && resting) act(Request::quit, now);
    const bool undoable = (resting || screen == Screen::end) && state_.runner->canUndo();
    if (key == GLFW_KEY_BACKSPACE && undoable && !state_.resultsShown) undo(now);
}

void StudyWindow::tick(double now) {
    if (!state_.answering()) return;
    const TrialPhase before = state_.runner->phase();
    if (const auto event = state_.runner->tick(now)) actOnEvent(*event, now);
    if (state_.runner->phase() != before) settle();
}

}  // namespace study_app
