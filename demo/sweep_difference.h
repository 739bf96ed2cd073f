// SPDX-License-Identifier: MIT
// What of a sweep got slower or worse since another one, beyond the noise of both.
#pragma once

#include <string>
#include <vector>

#include "demo/sweep_table.h"

namespace demo {

struct SweepDifference {
    std::string scene;
    int frame = 0;
    std::string technique;
    int resolution = 0;
    std::string what;  ///< "slower", "worse" or "missing"
    double before = 0, now = 0;
};

/// Slower: by more than a tenth, and the quartiles of both do not overlap. Worse: RMSE by more than
/// .002 and a tenth. Missing: measured before and not now. In the order of the old sweep.
std::vector<SweepDifference> slowerOrWorse(const SweepTable& before, const SweepTable& now);

}  // namespace demo
