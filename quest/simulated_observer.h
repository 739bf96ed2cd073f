// SPDX-License-Identifier: MIT
// An observer made of the psychometric function: for trying out designs, testing staircases and
// fits, and running a study without people.
//
//     std::mt19937_64 rng(seed);
//     const quest::SimulatedObserver observer{.threshold = -0.54, .response = {.lapse = 0.02}};
//     const bool correct = quest::answer(observer, quest::strength(a, r), rng);
//     const bool falseAlarm = quest::answer(observer, std::nullopt, rng);  // reference trial
//
// One engine call per answer, whatever the arguments: a session resumed after n answers continues
// with rng.discard(n).
#pragma once

#include <optional>
#include <random>
#include <string>

#include "quest/psychometric.h"

namespace quest {

struct SimulatedObserver {
    double threshold = -0.5403294747908737;  ///< x0 = -log10 c, finite; the default is c = 3.47
    double criterion = kPaperCriterion;      ///< F* at the threshold, (0, 1)
    double beta = 3.5;                       ///< > 0
    ResponseModel response = {};  ///< gamma .5 in 2AFC, the false alarms in yes/no; lapses
};

/// Empty when usable; else a sentence that names field, value and rule.
std::string validate(const SimulatedObserver& observer);

/// P(yes) at strength x = log10(a / r); without x, for a stimulus that has no artifact. +inf is a
/// hard edge, -inf no artifact. Throws std::invalid_argument for a NaN and for an observer that
/// does not validate.
double yesProbability(const SimulatedObserver& observer, std::optional<double> x);

/// Draws an answer: true for yes (correct in 2AFC, seen in yes/no). Throws as above.
bool answer(const SimulatedObserver& observer, std::optional<double> x, std::mt19937_64& rng);

}  // namespace quest
