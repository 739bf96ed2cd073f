// SPDX-License-Identifier: MIT
#include "study_app/trial_clock.h"

#include <algorithm>

namespace study_app {

void TrialClock::begin(double now) {
    begun_ = now;
    phase_ = presentation_.blankS > 0 ? TrialPhase::blank : TrialPhase::fixation;
}

std::optional<Outcome> TrialClock::tick(double now) {
    if (phase_ == TrialPhase::blank && now >= begun_ + presentation_.blankS) {
        phase_ = TrialPhase::fixation;
    }
    const auto limit = presentation_.timeLimitS;
    if (phase_ == TrialPhase::stimulus && limit && now >= onset_ + *limit) {
        return finish(records::TrialStatus::repeated);
    }
    return {};
}

bool TrialClock::stimulusDue(double now) const {
    return phase_ == TrialPhase::fixation && now >= intendedOnset();
}

void TrialClock::shown(double now) {
    if (phase_ != TrialPhase::fixation) return;
    onset_ = now;
    phase_ = TrialPhase::stimulus;
}

std::optional<Outcome> TrialClock::answer(records::Response response, double now) {
    if (phase_ != TrialPhase::stimulus || now < onset_) return {};
    const double time = now - onset_;
    // The window may wake up later than the limit was over: the limit holds all the same.
    if (presentation_.timeLimitS && time >= *presentation_.timeLimitS) {
        return finish(records::TrialStatus::repeated);
    }
    Outcome outcome = finish(time < presentation_.tooFastS ? records::TrialStatus::tooFast
                                                           : records::TrialStatus::ok);
    outcome.response = response;
    outcome.responseTimeS = time;
    return outcome;
}

void TrialClock::askForPlace(const Outcome& answered) {
    unplaced_ = answered;
    phase_ = TrialPhase::place;
}

std::optional<Outcome> TrialClock::locate(const Place& place) {
    if (phase_ != TrialPhase::place) return {};
    phase_ = TrialPhase::idle;
    unplaced_.place = place;
    return unplaced_;
}

bool TrialClock::withdraw() {
    if (phase_ != TrialPhase::place) return false;
    phase_ = TrialPhase::stimulus;
    return true;
}

std::optional<Outcome> TrialClock::disturb() {
    const bool wasOn = phase_ == TrialPhase::stimulus || phase_ == TrialPhase::place;
    const Outcome outcome = finish(records::TrialStatus::repeated);
    return wasOn ? std::optional(outcome) : std::nullopt;
}

Outcome TrialClock::finish(records::TrialStatus status) {
    phase_ = TrialPhase::idle;
    return {.response = {}, .responseTimeS = {}, .place = {}, .onset = onset_, .status = status};
}

void TrialClock::giveFeedback(double now) {
    feedbackFrom_ = now;
    phase_ = TrialPhase::feedback;
}

bool TrialClock::feedbackOver(double now) const {
    return phase_ == TrialPhase::feedback && now >= feedbackFrom_ + presentation_.feedbackS;
}

double TrialClock::secondsUntilChange(double now) const {
    const auto until = [&](double time) { return std::max(0.0, time - now); };
    switch (phase_) {
        case TrialPhase::blank:
            return until(begun_ + presentation_.blankS);
        case TrialPhase::fixation:
            return until(intendedOnset());
        case TrialPhase::stimulus:
            if (presentation_.timeLimitS) return until(onset_ + *presentation_.timeLimitS);
            break;
        case TrialPhase::feedback:
            return until(feedbackFrom_ + presentation_.feedbackS);
        case TrialPhase::place:
        case TrialPhase::idle:
            break;
    }
    return std::numeric_limits<double>::infinity();
}

}  // namespace study_app
