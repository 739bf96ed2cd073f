// SPDX-License-Identifier: MIT
// The experimenter's panel: a window of its own, for a monitor that the observer does not see. It
// asks for no click, since a click would take the keyboard away from the observer's window, and it
// is drawn only when told to, so that it delays neither a stimulus nor an answer. Whatever it does,
// the study's window is the current one again afterwards.
#pragma once

#include <memory>
#include <optional>

#include "study_app/app_state.h"
#include "study_app/screenshots.h"
#include "study_app/window.h"

namespace study_app {

class PanelWindow {
  public:
    /// Beside the study's window, which must outlive it; closed at first.
    explicit PanelWindow(const Window& study, std::optional<double> uiScale)
        : study_(study), uiScale_(uiScale) {}

    /// Opens or closes it. Throws std::runtime_error where there can be no second window.
    void toggle();
    /// Looks at what happened to it; F2 and its own button close it.
    void takeInput();

    /// Something that it shows has changed.
    void noteChange();
    bool wantsDrawing() const { return window_ && framesWanted_ > 0; }
    void draw(const AppState& state, Screenshots& screenshots);

  private:
    const Window& study_;
    std::optional<double> uiScale_;
    std::unique_ptr<Window> window_;
    int framesWanted_ = 0;
    double opened_ = 0;
};

}  // namespace study_app
