// SPDX-License-Identifier: MIT
// Runs staircases on simulated observers and says how far the estimates end from the truth.
#pragma once

#include <cstdint>
#include <vector>

#include "quest/quest.h"
#include "quest/simulated_observer.h"

namespace recovery {

struct Setting {
    quest::QuestParameters staircase;
    quest::SimulatedObserver observer;
    int trials = 40;
    int runs = 20000;
    std::uint64_t seed = 1;
};

/// Posterior mean minus true threshold, log10 units, of each run.
std::vector<double> errors(const Setting& setting);

/// An observer that answers exactly as the staircase assumes, `offset` log10 units above its guess.
quest::SimulatedObserver matchedObserver(const quest::QuestParameters& staircase, double offset);

double mean(const std::vector<double>& values);
double rootMeanSquare(const std::vector<double>& values);
/// 1.4826 x median absolute deviation from the median.
double robustSd(std::vector<double> values);

}  // namespace recovery
