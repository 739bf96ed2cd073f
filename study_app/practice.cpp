// SPDX-License-Identifier: MIT
#include "study_app/practice.h"

#include <algorithm>

#include "study_app/frame_design.h"

namespace study_app {
namespace {

// Any trial of a study is its own; practice with the same order would rehearse it.
constexpr std::uint64_t kPracticeSeed = 0x7072616374696365u;

Design practiceDesign(Design design) {
    design.catchShare = design.task == records::Task::yesNo ? 0.5 : 0;
    design.trialsPerCondition = 1000 / static_cast<int>(conditions(design).size()) + 1;
    return design;
}

/// r / a: thresholds lie at about 2 to 4.
double easyRatio(int answers) {
    return std::min(1.0, 0.25 + 0.05 * answers);
}

}  // namespace

Practice::Practice(const Design& design, std::uint64_t seed, const PracticeRule& rule)
    : rule_(rule), session_(practiceDesign(design), seed ^ kPracticeSeed) {}

records::Trial Practice::next() const {
    records::Trial trial = session_.next();
    const double ratio = easyRatio(answers_);
    const Condition& condition = session_.conditions()[session_.nextCondition()];
    if (condition.frames.empty()) {
        trial.filterRadiusPx = shownRadius(ratio * trial.artifactPx, session_.design().radius);
    } else {
        show(trial, nearestFrame(condition, ratio));
    }
    trial.proposedRadiusPx.reset();
    trial.staircase.reset();
    return trial;
}

bool Practice::answer(records::Response response) {
    const bool right = session_.answer({.response = response}).correct;
    ++answers_;
    last_.push_back(right);
    if (static_cast<int>(last_.size()) > rule_.ofLast) last_.pop_front();
    return right;
}

void Practice::skip() {
    const bool sides = session_.design().task == records::Task::twoAfc;
    session_.answer({.response = sides ? records::Response::left : records::Response::seen,
                     .status = records::TrialStatus::repeated});
}

bool Practice::ruleMet() const {
    return rightOfLast() >= rule_.correct;
}

int Practice::rightOfLast() const {
    return static_cast<int>(std::ranges::count(last_, true));
}

void Practice::startAgain() {
    last_.clear();
    answers_ = 0;
}

}  // namespace study_app
