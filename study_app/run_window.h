// SPDX-License-Identifier: MIT
// The study in a window: sessions with people.
//
//   return runWindow({.form = {.dataFolder = "study", .participant = "07", .design = "paper16"}});
#pragma once

#include <filesystem>
#include <optional>

#include "records/run_context.h"
#include "study_app/setup_form.h"
#include "study_app/window.h"

namespace study_app {

struct WindowRun {
    SetupForm form{};  ///< what the set-up screen begins with
    WindowOptions window{};
    records::RunContext context{};
    std::filesystem::path instructions{};  ///< empty: the shipped text for the task
    std::filesystem::path displays{};      ///< calibrations; empty: displayFile()
    /// Begin at the instructions with what form and calibration file hold; what is missing there is
    /// an error.
    bool startAtOnce = false;
    bool panel = false;  ///< the experimenter's window is open from the beginning
    /// For checking a set-up and for tests:
    std::filesystem::path screenshots{};  ///< a PNG of every screen, once each, goes there
    bool verifyPixels = false;            ///< read back every stimulus, not only the first
    /// robot_observer.h sits in front of it and answers that long after each stimulus, s.
    std::optional<double> robotAnswerS{};
    bool printTiming = false;
    std::filesystem::path eventLog{};  ///< see event_log.h
};

/// Runs until the window is closed. Throws std::runtime_error: no display, a session that cannot be
/// written at all, a framebuffer that does not hold the codes it was given.
void runWindow(const WindowRun& run);

}  // namespace study_app
