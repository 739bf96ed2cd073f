// SPDX-License-Identifier: MIT
// The order of a session's trials: a function of the design and the seed, fixed before the first
// answer.
//
// Staircases advance side by side in blocks: each block holds every condition once, in random
// order, so that practice and fatigue fall on all conditions alike and nobody can tell which
// staircase comes next. Catch trials fall one into each of as many equal stretches of the session,
// at a random place. Their conditions:
//   2AFC     those with the largest artifact, in turn: what a catch trial shows must be obvious
//   yes/no   all, in turn, so that a reference trial looks like any other trial without its
//   artifact
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "study_app/design.h"

namespace study_app {

struct TrialSlot {
    std::size_t condition = 0;  ///< index into conditions()
    bool isCatch = false;
    bool operator==(const TrialSlot&) const = default;
};

/// totalTrials(design) slots. The design must be valid.
std::vector<TrialSlot> trialOrder(const Design& design, std::uint64_t seed);

}  // namespace study_app
