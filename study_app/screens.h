// SPDX-License-Identifier: MIT
// The screens of a study. Each function draws the state with ImGui and returns what the person
// asked for; none decides anything about the experiment. Return is the one button that leads on, on
// every screen.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "study_app/app_state.h"
#include "study_app/window.h"

namespace study_app {

/// Codes to be painted pixel for pixel beneath the interface.
struct PlacedImage {
    cv::Mat codes;
    int x = 0, y = 0;  ///< top left, framebuffer pixels from the top left
};

/// What a screen draws on and with.
struct Page {
    const Window& window;
    double now;
    bool returnPressed;
    std::vector<PlacedImage>& images;

    float px(float atScale1) const { return atScale1 * window.uiScale(); }
};

/// What the person asked for on a screen.
enum class Request {
    next,
    back,
    undo,
    quit,
    practiceAgain,
    skipPractice,
    rerun  ///< AppState::rerun says which condition
};

std::optional<Request> drawSetup(AppState& state, const Page& page);
std::optional<Request> drawCalibration(AppState& state, const Page& page);
std::optional<Request> drawInstructions(AppState& state, const Page& page);
/// Practice and trials: the stimulus, or what stands before it.
void drawStimuli(AppState& state, const Page& page);
/// After practice: go on, or once more.
std::optional<Request> drawPracticeOver(AppState& state, const Page& page);
std::optional<Request> drawRest(AppState& state, const Page& page);
std::optional<Request> drawPause(AppState& state, const Page& page);
std::optional<Request> drawEnd(AppState& state, const Page& page);

/// The experimenter's window: all of it at once, nothing to click.
void drawPanel(const AppState& state, const Page& page);

/// The part of the window that a stimulus of this task needs, px.
cv::Size stimulusArea(records::Task task, int windowPx);
/// Why the design's stimuli do not fit into the window; empty where they do.
std::string tooSmall(const Window& window, const Design& design);
/// Where it begins, in framebuffer pixels from the top left: in the middle.
cv::Point stimulusOrigin(const Window& window, cv::Size area);

}  // namespace study_app
