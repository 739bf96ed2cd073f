// SPDX-License-Identifier: MIT
// From what the set-up and calibration screens hold to a session that runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "records/run_context.h"
#include "study_app/app_state.h"
#include "study_app/window.h"

namespace study_app {

/// Finds again what follows from the form: the session that exists already, the design in words,
/// the participants, what is known of this one, why a session cannot start.
void lookUp(SetupState& setup);

/// Empty fields are unknown. Throws std::runtime_error for what is no number.
records::ScreenLuminance luminanceTyped(const CalibrationState& calibration);

/// The display that the window stands on, as it was calibrated before.
CalibrationState loadCalibration(const Window& window, const std::filesystem::path& displays);
/// Puts what was measured into the profile, and a profile that changed into the file. False, with
/// the reason in `problem`, where it is no display or the file cannot be written.
bool storeCalibration(CalibrationState& calibration, const std::filesystem::path& displays);

/// Starts or resumes the form's session. Throws std::runtime_error.
std::unique_ptr<SessionRunner> startSession(const AppState& state,
                                            const records::RunContext& context);

/// This condition once more (reruns.h). Throws std::runtime_error.
std::unique_ptr<SessionRunner> startRerun(const SessionRunner& before,
                                          const std::string& condition);

/// What the last screen shows of the session and its reruns. Throws std::runtime_error.
Results resultsOf(const SessionRunner& runner);

}  // namespace study_app
