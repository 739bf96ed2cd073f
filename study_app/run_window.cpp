// SPDX-License-Identifier: MIT
#include "study_app/run_window.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>

#include "study_app/display_file.h"
#include "study_app/session_start.h"
#include "study_app/study_window.h"

namespace study_app {
namespace {

constexpr double kCursorBlinkS = 0.4, kCountdownS = 0.25;

/// What the calibration screen would have said, for those who leave it out.
void printNotices(const CalibrationState& c) {
    const auto print = [](const std::string& notice) {
        std::fprintf(stderr, "study_app: notice: %s\n", notice.c_str());
    };
    if (!c.warnings.empty()) print(c.warnings);
    if (!pxPerDeg(c.profile)) {
        print(c.profile.name + ", " + std::to_string(c.profile.widthPx) + " x " +
              std::to_string(c.profile.heightPx) +
              ": is not calibrated: the sidecar will not say how large stimuli were to the eye; "
              "leave --start out to calibrate it");
    }
}

}  // namespace

StudyWindow::StudyWindow(const WindowRun& run)
    : run_(run),
      window_(run.window),
      panel_(window_, run.window.uiScale),
      log_(run.eventLog),
      screenshots_(run.screenshots) {
    if (run.robotAnswerS) robot_.emplace(*run.robotAnswerS);
    if (run_.displays.empty()) run_.displays = displayFile();
    run_.context.glRenderer = window_.glRenderer();
    run_.context.glVersion = window_.glVersion();
    run_.context.viewportWidthPx = window_.widthPx();
    run_.context.viewportHeightPx = window_.heightPx();
    state_.setup.form = run.form;
    state_.setup.designs = shippedDesigns();
    state_.calibration = loadCalibration(window_, run_.displays);
    lookUp(state_.setup);
    if (run.startAtOnce) {
        const SetupState& setup = state_.setup;
        if (const std::string problem = missing(setup.form); !problem.empty()) {
            throw std::runtime_error("--start: " + problem);
        }
        if (setup.problem.empty()) leaveSetup(Window::now());
        if (!setup.problem.empty()) throw std::runtime_error(setup.problem);
        printNotices(state_.calibration);
        if (state_.flow.screen == Screen::calibration) act(Request::next, Window::now());
    }
    if (run.panel) panel_.toggle();
}

void StudyWindow::run() {
    draw();
    if (state_.flow.screen == Screen::setup) log_.screen(toText(Screen::setup));
    while (state_.flow.screen != Screen::closed) {
        window_.waitForEvents(idleSeconds(Window::now()));
        const double now = Window::now();
        actAsRobot(now);
        handleInput(now);
        tick(now);
        if (state_.runner) log_.rows(state_.runner->rows());
        if (state_.flow.screen == Screen::closed) break;
        draw();
        returnPressed_ = false;
    }
    const auto latency = state_.runner ? state_.runner->latency() : std::nullopt;
    if (run_.printTiming && latency) std::printf("%s\n", toText(*latency).c_str());
}

double StudyWindow::idleSeconds(double now) const {
    if (framesWanted_ > 0 || (panel_.wantsDrawing() && panelMayBeDrawn(now))) return 0;
    const auto robot = robot_ ? robot_->secondsUntilPress(now) : std::nullopt;
    if (robot) return *robot;
    if (state_.answering()) {
        return state_.runner->stimulusDue(now) ? 0 : state_.runner->secondsUntilChange(now);
    }
    if (robot_) return kCountdownS;
    if (state_.flow.screen == Screen::rest && now < state_.restOver) {
        return std::min(kCountdownS, state_.restOver - now);
    }
    if (ImGui::GetIO().WantTextInput) return kCursorBlinkS;
    return std::numeric_limits<double>::infinity();
}

void runWindow(const WindowRun& run) {
    StudyWindow window(run);
    window.run();
}

}  // namespace study_app
