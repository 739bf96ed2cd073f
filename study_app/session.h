// SPDX-License-Identifier: MIT
// One session as a state machine: what to show next, and what an answer changes. No window, no
// clock, no file: what it decides depends on the design, the seed and the rows so far alone. The
// same rows lead to the same next trial, bit for bit, so that a session is resumed, checked and
// redrawn from its trial table and there is no second file of state.
//
//   Session session(design, seed);
//   for (const records::Trial& row : table.trials)           // resume
//       if (auto difference = session.replay(row)) ...       // not this session's table
//   while (!session.finished()) {
//       draw(session.next());                                // everything a stimulus needs
//       journal.append(session.answer({.response = pressed}));
//   }
//
// Staircases: one QUEST per condition (quest/quest.h). The proposed radius is a 10^-x at the
// posterior's quantile x; it is rounded and limited to what the display shows, and the staircase is
// updated with the radius that was shown.
//
// Catch trials update no staircase: their `staircase`, `threshold_mean` and `threshold_sd` are n/a.
// That is how a table tells them from the others.
//   yes/no   trial_type reference: the artifact-free edge at the radius that the condition's
//            staircase proposes now. "Seen" is a false alarm.
//   2AFC     trial_type artifact, the largest artifact at the smallest radius of the display, which
//            nobody overlooks who looks: a wrong side is a lapse. `proposed_radius_px` is n/a. It
//            is an ordinary trial for a fit, where it informs the lapse rate.
//
// Frames: the pair nearest to the proposed r / a is shown. `artifact_px` and `filter_radius_px` are
// its own, `proposed_radius_px` is the proposed ratio times its a. Catch trials show the coarsest
// map in 2AFC, the converged frame in yes/no.
//
// Rows whose status is not `ok` (undone, repeated, too_fast) count as rows but answer nothing: the
// same condition comes again, with fresh roving.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "quest/quest.h"
#include "records/trial_table.h"
#include "study_app/design.h"
#include "study_app/trial_order.h"

namespace study_app {

struct Answer {
    std::optional<records::Response> response = {};  ///< none: disturbed before there was one
    std::optional<double> responseTimeS = {};        ///< seconds from onset
    std::optional<double> onsetS = {};               ///< seconds since the session's start
    records::TrialStatus status = records::TrialStatus::ok;
    /// Where the artifact was seen, px from the left and the upper edge of the image as shown, in
    /// [0, window]. Only with `seen` in a design that localises.
    std::optional<double> clickXPx = {}, clickYPx = {};
};

/// The first cell in which a recorded row is not what the session derives.
struct Difference {
    int trial = 0;
    std::string column, recorded, derived;
};

class Session {
  public:
    /// Throws std::invalid_argument with validate()'s sentence.
    Session(const Design& design, std::uint64_t seed);

    bool finished() const { return answered_ == order_.size(); }

    /// The trial to show, with every column filled in that is known before the answer. Throws
    /// std::logic_error when finished.
    const records::Trial& next() const;
    bool nextIsCatch() const;
    std::size_t nextCondition() const;  ///< index into conditions()

    /// Takes the answer to next() and returns the row to record. Throws std::logic_error when
    /// finished, std::invalid_argument where the response does not belong to the task, is missing
    /// although the status is ok, or comes with a click that nobody asked for.
    records::Trial answer(const Answer& answer);

    /// Takes a recorded row, holding it against what the session would have shown and derived.
    /// After a difference the session is of no further use. A row with status `undone` must be what
    /// the session would have recorded for an answer here, or, after such an answer was taken back,
    /// in the session that it had led to; it is then counted and changes nothing.
    std::optional<Difference> replay(const records::Trial& row);

    const Design& design() const { return design_; }
    std::uint64_t seed() const { return seed_; }
    const std::vector<Condition>& conditions() const { return conditions_; }
    const quest::Quest& staircase(std::size_t condition) const { return staircases_.at(condition); }
    std::size_t rows() const { return rows_; }          ///< of any status
    std::size_t answered() const { return answered_; }  ///< rows that are ok
    std::size_t total() const { return order_.size(); }
    int catchAnswered() const { return catchAnswered_; }
    int catchFailed() const { return catchFailed_; }  ///< wrong side, or a false alarm

  private:
    void prepareNext();
    void place(records::Trial& trial, std::size_t condition, bool isCatch) const;
    void rove(records::Trial& trial, const Condition& condition) const;
    void take(records::Trial& row);
    std::optional<Difference> replayOne(const records::Trial& row);
    std::optional<Difference> replayUndone(const records::Trial& row);

    Design design_;
    std::uint64_t seed_;
    std::vector<Condition> conditions_;
    std::vector<TrialSlot> order_;
    std::vector<quest::Quest> staircases_;
    std::size_t rows_ = 0, answered_ = 0;
    int catchAnswered_ = 0, catchFailed_ = 0;
    records::Trial next_;
    /// After rows that are undone: the sessions that the last of them may have left, while its
    /// answer still counted. More than one where rows do not tell.
    std::vector<Session> beforeUndo_;
};

/// What the display shows for a proposed radius: the nearest multiple of the step within the
/// limits.
double shownRadius(double proposedPx, const RadiusLimits& limits);

/// One condition's result so far.
struct Threshold {
    std::string condition;
    std::size_t trials = 0;
    double mean = 0, sd = 0;  ///< posterior of x0 = log10(a / r), log10 units
    double c = 0;             ///< 10^-mean, radius in artifact sizes
    double radiusPx = 0;      ///< c a; of frames the one that they all have
};
std::vector<Threshold> thresholds(const Session& session);

}  // namespace study_app
