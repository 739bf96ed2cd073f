// SPDX-License-Identifier: MIT
#include <algorithm>

#include "study_app/session_start.h"
#include "study_app/study_window.h"

namespace study_app {
namespace {

/// What drawing the panel may take on a slow machine: with less time than this before the next
/// change on the observer's screen it waits.
constexpr double kPanelS = 0.1;

}  // namespace

/// Between the trials; never while an answer may come, whose time it would change.
bool StudyWindow::panelMayBeDrawn(double now) const {
    if (!state_.answering()) return true;
    return state_.runner->phase() != TrialPhase::stimulus &&
           state_.runner->secondsUntilChange(now) > kPanelS;
}

void StudyWindow::draw() {
    const double now = Window::now();
    if (state_.answering() && state_.runner->stimulusDue(now) && !state_.runner->prepareImages()) {
        pause("The next trial cannot be shown. " + state_.runner->problem(), true);
    }
    const bool stimuli = state_.answering();
    const bool newStimulus = stimuli && state_.runner->stimulusDue(now);
    // While a stimulus is on, the picture on screen stays as it is: mouse and idle wake-ups cost
    // nothing.
    if (!stimuli || newStimulus || framesWanted_ > 0) {
        framesWanted_ = std::max(0, framesWanted_ - 1);
        window_.showCursor(!stimuli || localises());
        window_.beginFrame(stimuli ? state_.runner->presentation().backgroundCode : kPageGrey);
        std::vector<PlacedImage> images;
        const std::optional<Request> request = drawScreen({window_, now, returnPressed_, images});
        showFrame(images, newStimulus);
        if (request) {
            act(*request, Window::now());
            settle();
        }
    }
    if (panel_.wantsDrawing() && (newStimulus || panelMayBeDrawn(Window::now()))) {
        // Nobody answers that soon after a stimulus has come.
        panel_.draw(state_, screenshots_);
    }
}

std::optional<Request> StudyWindow::drawScreen(const Page& page) {
    switch (state_.flow.screen) {
        case Screen::setup: {
            holdAgainstWindow();
            const auto request = drawSetup(state_, page);
            if (state_.setup.lookedUp != state_.setup.form) {
                lookUp(state_.setup);
                settle();
            }
            return request;
        }
        case Screen::calibration:
            return drawCalibration(state_, page);
        case Screen::instructions:
            return drawInstructions(state_, page);
        case Screen::practice:
            if (!state_.answering()) return drawPracticeOver(state_, page);
            drawStimuli(state_, page);
            return {};
        case Screen::trials:
            drawStimuli(state_, page);
            return {};
        case Screen::rest:
            return drawRest(state_, page);
        case Screen::pause:
            return drawPause(state_, page);
        case Screen::end:
            return drawEnd(state_, page);
        case Screen::closed:
            break;
    }
    return {};
}

void StudyWindow::showFrame(const std::vector<PlacedImage>& images, bool newStimulus) {
    for (const PlacedImage& image : images) {
        painter_.draw(image.codes, image.x, image.y, window_.heightPx());
    }
    window_.renderInterface();
    const bool verify = newStimulus && (run_.verifyPixels || !verified_);
    const bool robotLooks = newStimulus && robot_;
    const std::string name = pictureName(state_, Window::now());
    const bool picture = (framesWanted_ == 0 || newStimulus) && screenshots_.wanted(name);
    cv::Mat frame;
    if (verify || robotLooks || picture) frame = window_.readPixels();
    if (picture) screenshots_.take(name, frame);
    if (verify) {
        for (const PlacedImage& image : images) requireShown(frame, image.codes, image.x, image.y);
        verified_ = true;
    }
    const double shown = window_.endFrame();
    if (!newStimulus) return;
    // What was pressed until here was not pressed at the sight of the stimulus.
    window_.waitForEvents(0);
    window_.input().presses.clear();
    state_.runner->shown(shown);
    if (robotLooks) robot_->look(frame, shown);
    log_.stimulus(state_.runner->trial(), state_.runner->stage() == SessionRunner::Stage::practice);
}

}  // namespace study_app
