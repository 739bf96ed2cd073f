// SPDX-License-Identifier: MIT
#include <algorithm>
#include <stdexcept>
#include <string>

#include "study_app/display_file.h"
#include "study_app/frame_images.h"
#include "study_app/session_start.h"
#include "study_app/study_window.h"

namespace study_app {
namespace {

/// Number of the last row that counts; there is one.
int lastAnswer(const std::vector<records::Trial>& rows) {
    return std::ranges::find(rows.rbegin(), rows.rend(), records::TrialStatus::ok,
                             &records::Trial::status)
        ->number;
}

}  // namespace

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

}  // namespace study_app
