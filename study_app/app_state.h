// SPDX-License-Identifier: MIT
// The state of the study's window, once, in a plain struct. Screens (screens.h) draw it and say
// what the person asked for; run_window.cpp acts on that.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "study_app/design_file.h"
#include "study_app/instructions.h"
#include "study_app/reruns.h"
#include "study_app/screen_flow.h"
#include "study_app/session_flags.h"
#include "study_app/session_runner.h"
#include "study_app/setup_form.h"
#include "study_app/viewing_geometry.h"

namespace study_app {

struct SetupState {
    SetupForm form;
    std::vector<ShippedDesign> designs;
    std::string designFile;  ///< as typed into the list of designs
    // What follows from the form, found again whenever the form changes:
    std::optional<SetupForm> lookedUp;
    ExistingSession existing;
    std::size_t rowsFound = 0;     ///< the most that `existing` had since the session was chosen
    std::optional<Design> design;  ///< that the session would have
    std::vector<std::string> summary;
    std::vector<std::string> participants;
    std::string problem;   ///< why a session cannot start
    std::string tooSmall;  ///< why its stimuli do not fit into the window, as it is now
    /// What participants.tsv says of this participant and was put into the form, like the form's.
    std::string filledAge, filledGender, filledExpertise;
};

struct CalibrationState {
    DisplayProfile profile;
    bool known = false;  ///< this display was calibrated before
    std::string warnings;
    double cardWidthPx = 324;  ///< as on a display of 96 pixels per inch
    bool cardMatched = false;  ///< the observer's own display, not the starting value
    bool dragging = false;
    double distanceCm = 0;
    bool distanceGiven = false;
    int greyCode = 186;  ///< matches at gamma 2.2
    bool gammaGiven = false;
    /// As typed, cd/m2 of codes 0, records::kMeasuredGreyCode and 255; empty: not measured.
    std::string blackText, greyText, whiteText;
    std::optional<int> patchCode;  ///< shown for the photometer while its reading is typed
    std::string problem;           ///< why it could not be stored
};

/// Of the session that ended and its reruns.
struct Results {
    std::vector<RunResult> conditions;
    CatchResult attention;
    std::string problem = {};  ///< why they cannot be shown
};

struct AppState {
    Flow flow;
    SetupState setup;
    CalibrationState calibration;
    Instructions instructions;
    std::unique_ptr<SessionRunner> runner;  ///< from the observer's consent on
    std::string message;                    ///< above the stimulus, or why there is a pause
    bool messageIsTrouble = false;
    double restOver = 0;  ///< when the break may end
    bool practiceOver = false, practiceStuck = false;
    bool resultsShown = false;  ///< on the last screen
    Results results;            ///< there
    std::string rerun;          ///< the condition that is to be run again

    /// Stimuli are on, not the words between practice and trials.
    bool answering() const { return showsStimuli(flow.screen) && !practiceOver && !practiceStuck; }
};

}  // namespace study_app
