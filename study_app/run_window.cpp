// SPDX-License-Identifier: MIT
#include "study_app/run_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>

#include "study_app/app_state.h"
#include "study_app/display_file.h"
#include "study_app/event_log.h"
#include "study_app/frame_images.h"
#include "study_app/page_parts.h"
#include "study_app/panel_window.h"
#include "study_app/robot_observer.h"
#include "study_app/screens.h"
#include "study_app/screenshots.h"
#include "study_app/session_start.h"
#include "study_app/stimulus_painter.h"

namespace study_app {
namespace {

constexpr double kCursorBlinkS = 0.4, kCountdownS = 0.25;
/// What drawing the panel may take on a slow machine: with less time than this before the next
/// change on the observer's screen it waits.
constexpr double kPanelS = 0.1;

/// Number of the last row that counts; there is one.
int lastAnswer(const std::vector<records::Trial>& rows) {
    return std::ranges::find(rows.rbegin(), rows.rend(), records::TrialStatus::ok,
                             &records::Trial::status)
        ->number;
}

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

void StudyWindow::act(Request request, double now) {
    switch (request) {
        case Request::next:
            if (state_.flow.screen == Screen::setup) return leaveSetup(now);
            if (state_.flow.screen == Screen::calibration) {
                if (!storeCalibration(state_.calibration, run_.displays)) return;
            }
            if (state_.flow.screen == Screen::instructions) return beginSession(now);
            return go(FlowEvent::next, now);
        case Request::back:
            return go(FlowEvent::back, now);
        case Request::undo:
            return undo(now);
        case Request::quit:
            if (state_.runner && state_.answering()) {
                interrupt("");
                // Who quits once more knows what was not recorded.
                if (!state_.runner->problem().empty()) return;
            }
            return go(FlowEvent::quit, now);
        case Request::practiceAgain:
            state_.practiceOver = state_.practiceStuck = false;
            state_.runner->startPracticeAgain();
            return enter(Screen::practice, now);
        case Request::skipPractice:
            return go(FlowEvent::next, now);
        case Request::rerun:
            return rerun(now);
    }
}

void StudyWindow::actOnEvent(RunnerEvent event, double now) {
    settle();
    panel_.noteChange();
    state_.message.clear();
    switch (event) {
        case RunnerEvent::nextTrial:
        case RunnerEvent::feedback:
            return;
        case RunnerEvent::placeWanted:
            return log_.place(state_.runner->trial());
        case RunnerEvent::practiceOver:
            state_.practiceOver = true;
            return log_.screen("practice-over");
        case RunnerEvent::practiceStuck:
            state_.practiceStuck = true;
            return log_.screen("practice-stuck");
        case RunnerEvent::breakDue:
            state_.restOver = now + state_.runner->presentation().breakMinimumS;
            return go(FlowEvent::breakDue, now);
        case RunnerEvent::finished:
            return go(FlowEvent::sessionFinished, now);
        case RunnerEvent::notRecorded:
            return pause("The answer could not be saved, and its trial comes again. " +
                             state_.runner->problem(),
                         true);
    }
}

FlowNeeds StudyWindow::needs() const {
    if (!state_.runner) {
        return {.practice = true,
                .trialsRemain = state_.setup.existing.state != ExistingSession::State::finished};
    }
    return {.practice = state_.runner->practiceNeeded(),
            .trialsRemain = !state_.runner->session().finished()};
}

void StudyWindow::go(FlowEvent event, double now) {
    const Flow next = after(state_.flow, event, needs());
    const bool changed = next.screen != state_.flow.screen;
    state_.flow = next;
    if (changed) enter(next.screen, now);
}

/// Stimuli begin with a blank; where the window cannot hold them there is a pause instead.
void StudyWindow::enter(Screen screen, double now) {
    settle();
    panel_.noteChange();
    log_.screen(toText(screen));
    if (screen != Screen::practice) state_.practiceOver = state_.practiceStuck = false;
    if (screen == Screen::end) lookUpResults();
    if (!showsStimuli(screen)) return;
    const std::string small = tooSmall(window_, state_.runner->session().design());
    if (!small.empty()) return pause(small + " Enlarge it, then go on.", true);
    state_.message.clear();
    begin(
        screen == Screen::practice ? SessionRunner::Stage::practice : SessionRunner::Stage::session,
        now);
}

bool StudyWindow::begin(SessionRunner::Stage stage, double now) {
    if (state_.runner->begin(stage, now)) return true;
    pause("The session cannot go on. " + state_.runner->problem(), true);
    return false;
}

/// A pause in the middle of a trial, which comes again.
void StudyWindow::interrupt(const std::string& why) {
    const bool wasOn = state_.runner->interrupt();
    if (!state_.runner->problem().empty()) {
        return pause(
            "The trial that was interrupted could not be recorded as such, and comes "
            "again. " +
                state_.runner->problem(),
            true);
    }
    pause(wasOn && !why.empty() ? why + " It comes again." : why, false);
}

void StudyWindow::pause(const std::string& why, bool trouble) {
    state_.flow = after(state_.flow, FlowEvent::pause);
    state_.message = why;
    state_.messageIsTrouble = trouble;
    log_.screen(toText(state_.flow.screen));
    if (trouble) log_.problem(why);
    panel_.noteChange();
    settle();
}

void StudyWindow::undo(double now) {
    settle();
    panel_.noteChange();
    const int row = lastAnswer(state_.runner->rows());
    if (!state_.runner->undo()) {
        return pause("The answer could not be taken back. " + state_.runner->problem(), true);
    }
    log_.rows(state_.runner->rows());
    log_.undo(row);
    if (state_.flow.screen == Screen::trials) {
        if (!begin(SessionRunner::Stage::session, now)) return;
    } else {
        go(FlowEvent::undone, now);
    }
    state_.message = "Your last answer is taken back. Its trial comes again.";
    state_.messageIsTrouble = false;
}

/// Results need no stimulus.
void StudyWindow::holdAgainstWindow() {
    SetupState& setup = state_.setup;
    const bool shows = setup.design && setup.existing.state != ExistingSession::State::finished;
    setup.tooSmall = shows ? tooSmall(window_, *setup.design) : "";
    if (!setup.tooSmall.empty()) {
        setup.tooSmall += " Enlarge it or start with --fullscreen, or choose another design.";
    }
}

void StudyWindow::leaveSetup(double now) {
    SetupState& setup = state_.setup;
    lookUp(setup);
    holdAgainstWindow();
    if (setup.problem.empty()) setup.problem = setup.tooSmall;
    if (!setup.problem.empty()) return log_.problem(setup.problem);
    try {
        state_.instructions = readInstructions(
            run_.instructions.empty() ? shippedInstructions(*setup.design) : run_.instructions);
        if (setup.existing.state == ExistingSession::State::finished) {
            state_.runner = startSession(state_, run_.context);
            state_.resultsShown = true;
        } else if (setup.design->frames) {
            requireFrames(*setup.design->frames);
        }
    } catch (const std::runtime_error& error) {
        setup.problem = error.what();
        return log_.problem(setup.problem);
    }
    go(FlowEvent::next, now);
}

/// Where it cannot begin, the set-up screen says why.
void StudyWindow::beginSession(double now) {
    try {
        state_.runner = startSession(state_, run_.context);
    } catch (const std::runtime_error& error) {
        state_.flow = {};
        enter(state_.flow.screen, now);
        lookUp(state_.setup);
        state_.setup.problem = error.what();
        log_.problem(state_.setup.problem);
        return;
    }
    go(FlowEvent::next, now);
}

void StudyWindow::rerun(double now) {
    state_.resultsShown = false;
    try {
        state_.runner = startRerun(*state_.runner, state_.rerun);
    } catch (const std::runtime_error& error) {
        state_.message = error.what();
        return;
    }
    const Session& session = state_.runner->session();
    go(FlowEvent::rerun, now);
    state_.message = "One condition comes once more, " + state_.rerun + ": " +
                     std::to_string(session.total() - session.answered()) +
                     " trials. Go on when the observer is ready.";
    state_.messageIsTrouble = false;
}

void StudyWindow::lookUpResults() {
    try {
        state_.results = resultsOf(*state_.runner);
    } catch (const std::runtime_error& error) {
        state_.results = {};
        state_.results.problem = error.what();
    }
}

}  // namespace

void runWindow(const WindowRun& run) {
    StudyWindow window(run);
    window.run();
}

}  // namespace study_app
