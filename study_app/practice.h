// SPDX-License-Identifier: MIT
// Practice before the trials: easy stimuli with feedback, until the observer has shown to have
// understood. Practice moves no staircase of the session and is not recorded.
//
// It borrows order, sides and roving from a session of the same design and another seed, and
// replaces the radius by an easy one: a quarter to a whole artifact size, from easy to less easy
// (thresholds lie at about 2 to 4). In yes/no half of the trials show no artifact.
#pragma once

#include <cstdint>
#include <deque>

#include "study_app/presentation.h"
#include "study_app/session.h"

namespace study_app {

class Practice {
  public:
    /// Throws std::invalid_argument where the design does not validate.
    Practice(const Design& design, std::uint64_t seed, const PracticeRule& rule);

    /// What to show.
    records::Trial next() const;
    /// Takes the answer to next() and returns whether it was right.
    bool answer(records::Response response);
    /// The trial was disturbed or answered too fast: another one comes instead.
    void skip();

    bool ruleMet() const;
    /// Enough tried without meeting the rule: the experimenter should explain once more.
    bool exhausted() const { return answers_ >= rule_.atMost && !ruleMet(); }
    void startAgain();

    int answers() const { return answers_; }
    int rightOfLast() const;  ///< among the last rule().ofLast answers
    const PracticeRule& rule() const { return rule_; }

  private:
    PracticeRule rule_;
    Session session_;
    std::deque<bool> last_;
    int answers_ = 0;
};

}  // namespace study_app
