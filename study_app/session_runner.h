// SPDX-License-Identifier: MIT
// A session with a person, without a window: practice and trials in time, rows to disk, breaks,
// undo, the stimuli that come next computed ahead. The window asks what to draw and passes on what
// was pressed and when.
//
//   SessionRunner runner(request);
//   runner.begin(SessionRunner::Stage::practice, now);
//   if (auto event = runner.tick(now)) ...                   // finished, break due, ...
//   if (runner.stimulusDue(now)) { draw(runner.images()); runner.shown(timeOfSwap); }
//   if (auto event = runner.answer(Side::left, timeOfPress)) ...
//
// A row is on disk before the next trial begins.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "study_app/practice.h"
#include "study_app/presentation.h"
#include "study_app/recorded_session.h"
#include "study_app/stimulus_prefetcher.h"
#include "study_app/trial_clock.h"

namespace study_app {

enum class RunnerEvent {
    nextTrial,    ///< a trial has ended, the blank before the next one is on
    placeWanted,  ///< "seen" is to be followed by locate()
    feedback,     ///< right or wrong is shown
    breakDue,
    practiceOver,   ///< its rule is met
    practiceStuck,  ///< enough tried in vain
    finished,
    notRecorded,  ///< problem() says why; the trial comes again
};

/// The two answers: arrow keys, or halves of the window. In yes/no left is no, right is yes.
enum class Side { left, right };
records::Response responseFor(Side side, records::Task task);

/// From an answer to the swap that shows the next stimulus, less the pause that is intended, s.
struct Latency {
    std::size_t trials = 0;
    double median = 0, p99 = 0, largest = 0;
};
/// In a line, ms.
std::string toText(const Latency& latency);

class SessionRunner {
  public:
    enum class Stage { practice, session };

    /// Starts or resumes the session. Throws what RecordedSession throws.
    explicit SessionRunner(const SessionRequest& request);

    /// As far as it is recorded, also while its table is lost.
    const Session& session() const { return recorded_ ? recorded_->session() : *lost_; }
    /// Nothing while the table is lost.
    const RecordedSession* recorded() const { return recorded_.get(); }
    std::filesystem::path table() const;
    const SessionRequest& request() const { return request_; }
    const Presentation& presentation() const { return request_.design.presentation; }
    const Practice& practice() const { return practice_; }
    bool practiceNeeded() const;
    void startPracticeAgain() { practice_.startAgain(); }

    /// The next trial, from its blank on. A break that was taken is over with it. Returns false
    /// where the table was lost and is not back, nothing being made in its place: problem() says
    /// which file.
    bool begin(Stage stage, double now);
    /// Another screen is shown. A stimulus on screen is not seen as it should be: its row is
    /// recorded as repeated. Returns whether there was one; problem() is empty, or why its row
    /// could not be recorded.
    bool interrupt();

    TrialPhase phase() const { return clock_.phase(); }
    Stage stage() const { return stage_; }
    std::optional<RunnerEvent> tick(double now);
    bool stimulusDue(double now) const { return clock_.stimulusDue(now); }
    void shown(double now);
    std::optional<RunnerEvent> answer(Side side, double now);
    /// Where the observer sees the artifact: after placeWanted, or as the answer "seen" itself. Of
    /// no effect where the design does not localise.
    std::optional<RunnerEvent> locate(const Place& place, double now);
    /// Takes back the answer whose place is asked for; the stimulus waits for another one. Returns
    /// whether there was one.
    bool withdrawAnswer() { return clock_.withdraw(); }
    double secondsUntilChange(double now) const { return clock_.secondsUntilChange(now); }

    /// The trial that comes next or is on screen, and its codes.
    records::Trial trial() const;
    const TrialImages& images();
    /// The same before its stimulus is due on screen. Returns false where a picture of it is
    /// missing or another one than the session began with: problem() says which; nothing is
    /// recorded, and begin() tries again.
    bool prepareImages();

    bool lastRight() const { return lastRight_; }      ///< of the answer that feedback is about
    bool lastTooFast() const { return lastTooFast_; }  ///< the trial before was answered too fast
    bool lastTimedOut() const { return lastTimedOut_; }

    /// One answer can be taken back, the last one of this sitting.
    bool canUndo() const { return undoable_; }
    /// Returns false where the trial on screen or the marks could not be written: problem() says
    /// why, nothing is undone.
    bool undo();

    double secondsLeft() const;
    /// Every row of the table, of any status.
    const std::vector<records::Trial>& rows() const { return rows_; }
    const std::string& problem() const { return problem_; }

    /// Nothing before the second stimulus.
    std::optional<Latency> latency() const;

  private:
    std::optional<RunnerEvent> take(const Outcome& outcome, double now);
    std::optional<RunnerEvent> record(const Outcome& outcome);
    std::optional<RunnerEvent> proceed(double now);
    void takeInPractice(const Outcome& outcome);
    void notePace(double now);
    bool reopen();
    void requireNothingLost() const;

    SessionRequest request_;
    std::unique_ptr<RecordedSession> recorded_;  // none while the table is lost
    std::optional<Session> lost_;                // then
    Practice practice_;
    TrialClock clock_;
    StimulusPrefetcher prefetcher_;
    Stage stage_ = Stage::practice;
    std::optional<TrialImages> images_;
    double sessionStart_;  // on the clock of `now`, so that onsets go on from the last row's
    bool clockStarted_ = false;
    int sinceBreak_ = 0;
    bool lastRight_ = false, lastTooFast_ = false, lastTimedOut_ = false, undoable_ = false;
    std::deque<double> paceS_;  // of the last trials
    std::optional<double> lastAnswer_, answerPending_;
    std::vector<records::Trial> rows_;
    std::vector<double> latencies_;
    std::string problem_;
};

}  // namespace study_app
