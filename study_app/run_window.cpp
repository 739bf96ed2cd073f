// SPDX-License-Identifier: MIT
#include "study_app/run_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <set>
#include <stdexcept>
#include <string>

#include "records/participants_table.h"
#include "records/whole_file.h"
#include "study_app/app_state.h"
#include "study_app/design_file.h"
#include "study_app/display_file.h"
#include "study_app/page_parts.h"
#include "study_app/robot_observer.h"
#include "study_app/screens.h"
#include "study_app/stimulus_painter.h"

namespace study_app {
namespace {

// ImGui lays out what it shows for the first time over two frames.
constexpr int kFramesToSettle = 3;
constexpr double kCursorBlinkS = 0.4, kCountdownS = 0.25;

std::uint64_t freshSeed() {
    std::random_device device;
    // Below 2^53, so that every tool that reads the sidecar's JSON reads the same number.
    return (static_cast<std::uint64_t>(device()) << 21) ^ device();
}

/// Throws where the framebuffer holds another code than was computed.
void requireCodes(const cv::Mat& bgr, const PlacedImage& image) {
    for (int row = 0; row < image.codes.rows; ++row) {
        for (int c = 0; c < image.codes.cols; ++c) {
            const auto& shown = bgr.at<cv::Vec3b>(image.y + row, image.x + c);
            const int code = image.codes.at<std::uint8_t>(row, c);
            if (shown[0] == code && shown[1] == code && shown[2] == code) continue;
            throw std::runtime_error(
                "stimulus: pixel (" + std::to_string(c) + ", " + std::to_string(row) + "): code " +
                std::to_string(shown[1]) + " came out of the framebuffer: must be " +
                std::to_string(code) + ": this driver or display mode changes what is shown");
        }
    }
}

records::ParticipantDetails detailsFrom(const SetupForm& form) {
    records::ParticipantDetails details{
        .age = {}, .gender = form.gender, .expertise = form.expertise};
    if (!form.age.empty()) details.age = std::stod(form.age);
    return details;
}

void printTiming(const std::vector<double>& latencies) {
    if (latencies.empty()) return;
    std::vector<double> sorted = latencies;
    std::ranges::sort(sorted);
    const auto quantile = [&](double share) {
        return 1e3 *
               sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
    };
    std::printf(
        "answer to next stimulus, less the intended pause: %zu trials, median %.1f ms, p99 "
        "%.1f ms, largest %.1f ms\n",
        sorted.size(), quantile(0.5), quantile(0.99), 1e3 * sorted.back());
}

class StudyWindow {
  public:
    explicit StudyWindow(const WindowRun& run);
    void run();

  private:
    void handleInput(double now);
    void handlePress(const Input::Press& press, double now, bool& returnPressed);
    void pressOffTrials(int key, double now);
    void handleDisturbance();
    void tick(double now);
    void draw(bool returnPressed);
    std::optional<Request> drawScreen(const Page& page);
    void showFrame(const std::vector<PlacedImage>& images, bool newStimulus);
    void saveScreenshot(const cv::Mat& bgr);
    double idleSeconds(double now) const;

    void act(Request request, double now);
    void actOnEvent(RunnerEvent event, double now);
    void go(FlowEvent event, double now);
    void enter(Screen screen, double now);
    void pause(const std::string& why, bool trouble);
    void undo(double now);

    void refreshSetup();
    void leaveSetup(double now);
    void loadCalibration();
    void leaveCalibration();
    void startSession(const SetupForm& form);
    void rerun(double now);
    void actAsRobot(double now);
    void log(const std::string& line);
    void logRows();
    bool answering() const;
    FlowNeeds needs() const;
    void settle() { framesWanted_ = kFramesToSettle; }

    WindowRun run_;
    Window window_;
    StimulusPainter painter_;
    AppState state_;
    int framesWanted_ = kFramesToSettle;
    bool returnPressed_ = false, verified_ = false;
    std::set<std::string> screenshotsTaken_;
    std::ofstream eventLog_;
    std::size_t rowsLogged_ = 0;
    struct RobotPress {
        int key = 0;
        double due = 0;
    };
    std::optional<RobotPress> robotPress_;
    std::mt19937_64 robotCoin_{1};
};

StudyWindow::StudyWindow(const WindowRun& run) : run_(run), window_(run.window) {
    state_.setup.form = run.form;
    state_.setup.designs = shippedDesigns();
    run_.context.glRenderer = window_.glRenderer();
    run_.context.glVersion = window_.glVersion();
    run_.context.viewportWidthPx = window_.widthPx();
    run_.context.viewportHeightPx = window_.heightPx();
    if (!run.eventLog.empty()) {
        eventLog_.open(run.eventLog, std::ios::app);
        if (!eventLog_) throw std::runtime_error(run.eventLog.string() + ": cannot be written");
    }
    log("screen setup");
    if (run_.displays.empty()) run_.displays = displayFile();
    loadCalibration();
    refreshSetup();
    if (!run.startAtOnce) return;
    const SetupState& setup = state_.setup;
    if (const std::string problem = missing(setup.form); !problem.empty()) {
        throw std::runtime_error("--start: " + problem);
    }
    if (!setup.problem.empty()) throw std::runtime_error(setup.problem);
    leaveSetup(Window::now());
    if (state_.flow.screen == Screen::calibration) act(Request::next, Window::now());
    if (state_.flow.screen == Screen::setup) throw std::runtime_error(setup.problem);
}

void StudyWindow::run() {
    while (state_.flow.screen != Screen::closed) {
        const double before = Window::now();
        window_.waitForEvents(framesWanted_ > 0 ? 0 : idleSeconds(before));
        const double now = Window::now();
        if (run_.robot) actAsRobot(now);
        handleInput(now);
        tick(now);
        logRows();
        if (state_.flow.screen == Screen::closed) break;
        draw(returnPressed_);
        returnPressed_ = false;
    }
    if (run_.printTiming && state_.runner) printTiming(state_.runner->latencies());
}

/// Presses what the robot has decided on, and Return wherever a person would read first.
void StudyWindow::actAsRobot(double now) {
    if (robotPress_ && now >= robotPress_->due) {
        window_.input().presses.push_back({.key = robotPress_->key});
        robotPress_.reset();
    } else if (!answering() && framesWanted_ == 0) {
        window_.input().presses.push_back({.key = GLFW_KEY_ENTER});
    }
}

void StudyWindow::log(const std::string& line) {
    if (eventLog_.is_open()) eventLog_ << line << std::endl;
}

void StudyWindow::logRows() {
    if (!eventLog_.is_open() || !state_.runner) return;
    const auto& rows = state_.runner->rows();
    for (; rowsLogged_ < rows.size(); ++rowsLogged_) {
        const records::Trial& row = rows[rowsLogged_];
        log("row " + std::to_string(row.number) + " " + std::string(records::toText(row.status)));
    }
}

double StudyWindow::idleSeconds(double now) const {
    double seconds = std::numeric_limits<double>::infinity();
    if (robotPress_) return std::max(0.0, robotPress_->due - now);
    if (run_.robot && !answering()) return kCountdownS;
    if (answering()) {
        if (state_.runner->stimulusDue(now)) return 0;
        seconds = state_.runner->secondsUntilChange(now);
    } else if (state_.flow.screen == Screen::rest && now < state_.restOver) {
        seconds = std::min(kCountdownS, state_.restOver - now);
    } else if (ImGui::GetIO().WantTextInput) {
        seconds = kCursorBlinkS;
    }
    return seconds;
}

/// Stimuli are on, not the words between practice and trials.
bool StudyWindow::answering() const {
    return showsStimuli(state_.flow.screen) && !state_.practiceOver && !state_.practiceStuck;
}

FlowNeeds StudyWindow::needs() const {
    if (!state_.runner) {
        return {.practice = true,
                .trialsRemain = state_.setup.existing.state != ExistingSession::State::finished};
    }
    return {.practice = state_.runner->practiceNeeded(),
            .trialsRemain = !state_.runner->session().finished()};
}

void StudyWindow::handleInput(double now) {
    Input& input = window_.input();
    if (!input.presses.empty() || !input.disturbance.empty()) settle();
    if (input.closeRequested) return act(Request::quit, now);
    if (!input.disturbance.empty()) handleDisturbance();
    for (const Input::Press& press : input.presses) handlePress(press, now, returnPressed_);
    input.clear();
}

void StudyWindow::handleDisturbance() {
    if (!answering()) return;
    const bool wasOn = state_.runner->interrupt();
    pause("The trial was interrupted: " + window_.input().disturbance + "." +
              (wasOn ? " It comes again." : ""),
          false);
}

void StudyWindow::handlePress(const Input::Press& press, double now, bool& returnPressed) {
    const auto answer = [&](Side side) {
        if (const auto event = state_.runner->answer(side, now)) actOnEvent(*event, now);
    };
    switch (press.key) {
        case GLFW_KEY_F2:
            if (state_.flow.screen == Screen::end) {
                state_.resultsShown = !state_.resultsShown;
            } else if (state_.runner) {
                state_.panelShown = !state_.panelShown;
            }
            return;
        case GLFW_KEY_ENTER:
        case GLFW_KEY_KP_ENTER:
            returnPressed = true;
            return;
        default:
            break;
    }
    if (!answering()) return pressOffTrials(press.key, now);
    switch (press.key) {
        case GLFW_KEY_LEFT:
            return answer(Side::left);
        case GLFW_KEY_RIGHT:
            return answer(Side::right);
        case GLFW_KEY_UNKNOWN:
            if (ImGui::GetIO().WantCaptureMouse) return;
            return answer(press.click.xPx < window_.widthPx() / 2.0 ? Side::left : Side::right);
        case GLFW_KEY_ESCAPE:
        case GLFW_KEY_P:
            state_.runner->interrupt();
            return pause("", false);
        case GLFW_KEY_BACKSPACE:
            if (state_.flow.screen == Screen::trials && state_.runner->canUndo()) undo(now);
            return;
        default:
            return;
    }
}

void StudyWindow::pressOffTrials(int key, double now) {
    const Screen screen = state_.flow.screen;
    const bool resting = screen == Screen::rest || screen == Screen::pause;
    if (key == GLFW_KEY_Q && resting) act(Request::quit, now);
    const bool undoable = (resting || screen == Screen::end) && state_.runner->canUndo();
    if (key == GLFW_KEY_BACKSPACE && undoable && !state_.resultsShown) undo(now);
}

void StudyWindow::tick(double now) {
    if (!answering()) return;
    const TrialPhase before = state_.runner->phase();
    if (const auto event = state_.runner->tick(now)) actOnEvent(*event, now);
    if (state_.runner->phase() != before) settle();
}

void StudyWindow::draw(bool returnPressed) {
    const double now = Window::now();
    const bool stimuli = answering();
    const bool newStimulus = stimuli && state_.runner->stimulusDue(now);
    // While a stimulus is on, the picture on screen stays as it is: mouse and idle wake-ups cost
    // nothing.
    if (stimuli && !newStimulus && framesWanted_ == 0 && !state_.panelShown) return;
    framesWanted_ = std::max(0, framesWanted_ - 1);
    window_.showCursor(!stimuli || state_.panelShown);
    window_.beginFrame(stimuli ? state_.runner->presentation().backgroundCode : kPageGrey);
    std::vector<PlacedImage> images;
    const Page page{window_, now, returnPressed, images};
    const std::optional<Request> request = drawScreen(page);
    if (state_.panelShown && state_.runner) drawPanel(state_, page);
    showFrame(images, newStimulus);
    if (request) {
        act(*request, Window::now());
        settle();
    }
}

std::optional<Request> StudyWindow::drawScreen(const Page& page) {
    switch (state_.flow.screen) {
        case Screen::setup: {
            const auto request = drawSetup(state_, page);
            if (state_.setup.lookedUp != state_.setup.form) refreshSetup();
            return request;
        }
        case Screen::calibration:
            return drawCalibration(state_, page);
        case Screen::instructions:
            return drawInstructions(state_, page);
        case Screen::practice:
            if (!answering()) return drawPracticeOver(state_, page);
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
    const bool verify = newStimulus && !state_.panelShown && (run_.verifyPixels || !verified_);
    const bool robotLooks = run_.robot && newStimulus;
    cv::Mat frame;  // for the robot
    if (verify || robotLooks || !run_.screenshots.empty()) {
        const cv::Mat bgr = window_.readPixels();
        if (verify) {
            for (const PlacedImage& image : images) requireCodes(bgr, image);
            verified_ = true;
        }
        if (robotLooks) frame = bgr;
        if (!run_.screenshots.empty() && (framesWanted_ == 0 || newStimulus)) saveScreenshot(bgr);
    }
    const double shown = window_.endFrame();
    if (!newStimulus) return;
    // What was pressed until here was not pressed at the sight of the stimulus.
    window_.waitForEvents(0);
    window_.input().presses.clear();
    state_.runner->shown(shown);
    if (robotLooks) {
        const Side side = robotAnswer(frame, robotCoin_);
        robotPress_ = {.key = side == Side::left ? GLFW_KEY_LEFT : GLFW_KEY_RIGHT,
                       .due = shown + state_.runner->presentation().tooFastS};
    }
    if (!eventLog_.is_open()) return;
    const records::Trial trial = state_.runner->trial();
    const bool practice = state_.runner->stage() == SessionRunner::Stage::practice;
    log((practice ? "practice " : "stimulus ") + std::to_string(trial.number) + " " +
        trial.side.value_or(trial.type == records::TrialType::artifact ? "right" : "left"));
}

void StudyWindow::saveScreenshot(const cv::Mat& bgr) {
    std::string name = toText(state_.flow.screen);
    if (answering()) {
        static constexpr const char* kPhases[] = {"idle", "blank", "fixation", "stimulus",
                                                  "feedback"};
        const bool due = state_.runner->stimulusDue(Window::now());
        name += std::string("-") +
                (due ? "stimulus" : kPhases[static_cast<int>(state_.runner->phase())]);
    } else if (state_.practiceOver) {
        name += "-over";
    } else if (state_.practiceStuck) {
        name += "-stuck";
    }
    if (state_.flow.screen == Screen::end && state_.resultsShown) name += "-results";
    if (state_.panelShown) name += "-panel";
    if (!screenshotsTaken_.insert(name).second) return;
    records::createFolders(run_.screenshots);
    const std::filesystem::path file = run_.screenshots / (name + ".png");
    if (!cv::imwrite(file.string(), bgr)) {
        throw std::runtime_error(file.string() + ": cannot be written");
    }
}

void StudyWindow::act(Request request, double now) {
    switch (request) {
        case Request::next:
            if (state_.flow.screen == Screen::setup) return leaveSetup(now);
            if (state_.flow.screen == Screen::calibration) leaveCalibration();
            if (state_.flow.screen == Screen::instructions) {
                try {
                    startSession(state_.setup.form);
                } catch (const std::runtime_error& error) {
                    state_.flow = {};
                    refreshSetup();
                    state_.setup.problem = error.what();
                    return;
                }
            }
            return go(FlowEvent::next, now);
        case Request::back:
            return go(FlowEvent::back, now);
        case Request::undo:
            return undo(now);
        case Request::quit:
            if (state_.runner && answering()) state_.runner->interrupt();
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
    state_.message.clear();
    switch (event) {
        case RunnerEvent::nextTrial:
        case RunnerEvent::feedback:
            return;
        case RunnerEvent::practiceOver:
            state_.practiceOver = true;
            log("screen practice-over");
            return;
        case RunnerEvent::practiceStuck:
            state_.practiceStuck = true;
            return;
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

void StudyWindow::go(FlowEvent event, double now) {
    const Flow next = after(state_.flow, event, needs());
    const bool changed = next.screen != state_.flow.screen;
    state_.flow = next;
    if (changed) enter(next.screen, now);
}

/// Stimuli begin with a blank; where the window cannot hold them there is a pause instead.
void StudyWindow::enter(Screen screen, double now) {
    settle();
    log(std::string("screen ") + toText(screen));
    if (screen != Screen::practice) state_.practiceOver = state_.practiceStuck = false;
    if (!showsStimuli(screen)) return;
    const Design& design = state_.runner->session().design();
    const cv::Size needed = stimulusArea(design.task, design.windowPx);
    if (needed.width > window_.widthPx() || needed.height > window_.heightPx()) {
        return pause("The stimuli need " + std::to_string(needed.width) + " x " +
                         std::to_string(needed.height) + " pixels, the window has " +
                         std::to_string(window_.widthPx()) + " x " +
                         std::to_string(window_.heightPx()) + ". Enlarge it, then go on.",
                     true);
    }
    state_.message.clear();
    state_.runner->begin(
        screen == Screen::practice ? SessionRunner::Stage::practice : SessionRunner::Stage::session,
        now);
}

void StudyWindow::pause(const std::string& why, bool trouble) {
    state_.flow = after(state_.flow, FlowEvent::pause);
    state_.message = why;
    state_.messageIsTrouble = trouble;
    log("screen pause");
    settle();
}

void StudyWindow::undo(double now) {
    settle();
    const bool undone = state_.runner->undo();
    if (!undone)
        return pause("The answer could not be taken back. " + state_.runner->problem(), true);
    if (state_.flow.screen == Screen::trials) {
        state_.runner->begin(SessionRunner::Stage::session, now);
    } else {
        go(FlowEvent::undone, now);
    }
    state_.message = "Your last answer is taken back. Its trial comes again.";
    state_.messageIsTrouble = false;
}

void StudyWindow::refreshSetup() {
    SetupState& setup = state_.setup;
    const bool newFolder = !setup.lookedUp || setup.lookedUp->dataFolder != setup.form.dataFolder;
    const bool newPerson = newFolder || setup.lookedUp->participant != setup.form.participant;
    setup.problem.clear();
    setup.design.reset();
    setup.summary.clear();
    setup.existing = findExisting(setup.form);
    try {
        if (newFolder) setup.participants = describeParticipants(setup.form.dataFolder);
        if (newPerson && !setup.form.participant.empty()) {
            const auto known =
                records::readParticipant(setup.form.dataFolder, setup.form.participant);
            if (known) {
                if (known->age) setup.form.age = std::to_string(std::lround(*known->age));
                setup.form.gender = known->gender;
                setup.form.expertise = known->expertise;
            }
        }
        setup.design = setup.existing.design ? *setup.existing.design : designOf(setup.form);
        setup.summary = describeDesign(*setup.design);
    } catch (const std::exception& error) {
        setup.problem = error.what();
    }
    setup.lookedUp = setup.form;
    settle();
}

void StudyWindow::leaveSetup(double now) {
    refreshSetup();
    SetupState& setup = state_.setup;
    if (!setup.design || setup.existing.state == ExistingSession::State::unusable) return;
    try {
        const records::Task task = setup.design->task;
        state_.instructions = readInstructions(run_.instructions.empty() ? shippedInstructions(task)
                                                                         : run_.instructions);
        if (setup.existing.state == ExistingSession::State::finished) {
            startSession(setup.form);
            state_.resultsShown = true;
        }
    } catch (const std::runtime_error& error) {
        setup.problem = error.what();
        return;
    }
    go(FlowEvent::next, now);
}

void StudyWindow::loadCalibration() {
    CalibrationState& c = state_.calibration;
    c.warnings = displayWarnings(window_.displayState());
    c.profile = window_.monitor();
    const auto known = findDisplay(readDisplays(run_.displays), c.profile);
    c.cardWidthPx *= window_.uiScale();
    if (!known) return;
    c.profile = *known;
    c.known = true;
    if (known->pxPerMm) {
        c.cardWidthPx = std::round(*known->pxPerMm * kCardWidthMm);
        c.cardMatched = true;
    }
    if (known->distanceMm) c.distanceCm = *known->distanceMm / 10;
    c.distanceGiven = known->distanceMm.has_value();
    if (known->gamma) c.greyCode = greyCodeOfHalfLight(*known->gamma);
    c.gammaGiven = known->gamma.has_value();
    c.luminance = known->luminanceCdM2.value_or(0);
}

void StudyWindow::leaveCalibration() {
    CalibrationState& c = state_.calibration;
    const DisplayProfile before = c.profile;
    DisplayProfile& p = c.profile;
    if (c.cardMatched) p.pxPerMm = pxPerMmFromCard(c.cardWidthPx);
    if (c.distanceGiven) p.distanceMm = 10 * c.distanceCm;
    if (c.gammaGiven) p.gamma = gammaFromGreyCode(c.greyCode);
    if (c.luminance > 0) p.luminanceCdM2 = c.luminance;
    if (p != before) storeDisplay(run_.displays, p);
}

void StudyWindow::startSession(const SetupForm& form) {
    const ExistingSession existing = findExisting(form);
    const SessionRequest request =
        requestFrom(form, existing, state_.calibration.profile, freshSeed(), run_.context);
    const records::ParticipantDetails details = detailsFrom(form);
    state_.runner = std::make_unique<SessionRunner>(request);
    if (details != records::ParticipantDetails{}) {
        records::writeParticipant(form.dataFolder, form.participant, details);
    }
}

/// The flagged condition alone, as a session of its own beside the first one.
void StudyWindow::rerun(double now) {
    SessionRequest request = state_.runner->request();
    request.design = rerunDesign(request.design, *state_.rerun);
    request.seed = freshSeed();
    const std::string base = request.session.value_or("") + "rerun";
    for (int i = 1;; ++i) {
        request.session = base + std::to_string(i);
        const auto table =
            records::trialTablePath(request.dataFolder, request.participant, request.session);
        if (!std::filesystem::exists(table)) break;
    }
    try {
        state_.runner = std::make_unique<SessionRunner>(request);
    } catch (const std::runtime_error& error) {
        state_.message = error.what();
        state_.resultsShown = false;
        return;
    }
    state_.resultsShown = false;
    rowsLogged_ = 0;
    go(FlowEvent::rerun, now);
}

}  // namespace

void runWindow(const WindowRun& run) {
    StudyWindow window(run);
    window.run();
}

}  // namespace study_app
