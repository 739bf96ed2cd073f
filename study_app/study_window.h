// SPDX-License-Identifier: MIT
// The window of a study's sessions: one class in three files, by what happened
// (study_window_input.cpp), what is seen (study_window_drawing.cpp) and what follows
// (study_window_flow.cpp). run_window.h is how it is used.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study_app/app_state.h"
#include "study_app/event_log.h"
#include "study_app/page_parts.h"
#include "study_app/panel_window.h"
#include "study_app/robot_observer.h"
#include "study_app/run_window.h"
#include "study_app/screens.h"
#include "study_app/screenshots.h"
#include "study_app/stimulus_painter.h"

namespace study_app {

class StudyWindow {
  public:
    explicit StudyWindow(const WindowRun& run);
    void run();

  private:
    // What happened
    void actAsRobot(double now);
    void handleInput(double now);
    void handlePress(const Input::Press& press, double now);
    void pressInTrials(int key, double now);
    void clickInTrials(const Input::Click& click, double now);
    void answer(Side side, double now);
    bool localises() const;
    void locate(const Input::Click& click, double now);
    void pressOffTrials(int key, double now);
    void handleDisturbance();
    void tick(double now);
    double idleSeconds(double now) const;

    // What is seen
    void draw();
    std::optional<Request> drawScreen(const Page& page);
    void showFrame(const std::vector<PlacedImage>& images, bool newStimulus);
    bool panelMayBeDrawn(double now) const;
    void settle() { framesWanted_ = kFramesToSettle; }

    // What follows
    void act(Request request, double now);
    void actOnEvent(RunnerEvent event, double now);
    void go(FlowEvent event, double now);
    void enter(Screen screen, double now);
    bool begin(SessionRunner::Stage stage, double now);
    void interrupt(const std::string& why);
    void pause(const std::string& why, bool trouble);
    void undo(double now);
    void holdAgainstWindow();
    void leaveSetup(double now);
    void beginSession(double now);
    void rerun(double now);
    void lookUpResults();
    FlowNeeds needs() const;

    WindowRun run_;
    Window window_;
    PanelWindow panel_;
    StimulusPainter painter_;
    AppState state_;
    EventLog log_;
    Screenshots screenshots_;
    std::optional<RobotObserver> robot_;
    int framesWanted_ = kFramesToSettle;
    bool returnPressed_ = false, verified_ = false;
};

}  // namespace study_app
