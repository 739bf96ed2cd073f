// SPDX-License-Identifier: MIT
// One trial in time: blank, fixation, stimulus, answer, feedback. Times are arguments (seconds of a
// clock that never goes back), so that the rules are tested without a window:
//
//   - nobody answers before the stimulus is on screen: what is pressed earlier is ignored
//   - one answer per trial: what is pressed later is ignored
//   - an answer earlier than tooFastS is kept, marked too_fast, and the trial comes again
//   - a trial that runs out of time or is disturbed is marked repeated and comes again
//   - where a place is asked for, the answer is held until it is given; the time is the answer's
//
//   clock.begin(now);
//   if (clock.stimulusDue(now)) { draw; swap; clock.shown(timeOfSwap); }
//   if (auto outcome = clock.answer(Response::left, now)) record(*outcome);
#pragma once

#include <limits>
#include <optional>

#include "records/trial_table.h"
#include "study_app/presentation.h"

namespace study_app {

enum class TrialPhase { idle, blank, fixation, stimulus, place, feedback };

/// On the image as shown, px from its left and upper edge.
struct Place {
    double xPx = 0, yPx = 0;
};

struct Outcome {
    /// Nothing where the trial ended without an answer.
    std::optional<records::Response> response;
    std::optional<double> responseTimeS;
    std::optional<Place> place;  ///< where the artifact was seen
    double onset = 0;            ///< time of the swap that showed the stimulus
    records::TrialStatus status = records::TrialStatus::ok;
};

class TrialClock {
  public:
    explicit TrialClock(const Presentation& presentation) : presentation_(presentation) {}

    /// The blank before a trial; whatever went on before is over.
    void begin(double now);
    /// No trial goes on: another screen is shown.
    void stop() { phase_ = TrialPhase::idle; }

    TrialPhase phase() const { return phase_; }
    /// Moves on from blank to fixation, and ends feedback. Returns the outcome where the time limit
    /// ends the trial.
    std::optional<Outcome> tick(double now);
    /// Blank and fixation are over and the stimulus is not shown yet.
    bool stimulusDue(double now) const;
    /// The stimulus came on screen.
    void shown(double now);
    std::optional<Outcome> answer(records::Response response, double now);
    /// The stimulus stays until the place that belongs to this answer is given.
    void askForPlace(const Outcome& answered);
    /// The answer with its place; nothing where none was asked for.
    std::optional<Outcome> locate(const Place& place);
    /// The answer whose place was asked for is taken back, and the stimulus waits for another one,
    /// timed from the same swap. False where none was asked for.
    bool withdraw();
    /// Focus lost, window resized, display unplugged, pause: an outcome where a stimulus was on.
    std::optional<Outcome> disturb();
    /// Feedback is shown before the next begin().
    void giveFeedback(double now);
    bool feedbackOver(double now) const;

    /// Seconds until something happens by itself; infinite where only an answer can.
    double secondsUntilChange(double now) const;
    /// When the stimulus was meant to appear at the earliest.
    double intendedOnset() const { return begun_ + presentation_.blankS + presentation_.fixationS; }

  private:
    Outcome finish(records::TrialStatus status);

    Presentation presentation_;
    TrialPhase phase_ = TrialPhase::idle;
    double begun_ = 0, onset_ = 0, feedbackFrom_ = 0;
    Outcome unplaced_;  // in the phase `place`
};

}  // namespace study_app
