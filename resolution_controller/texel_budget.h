// SPDX-License-Identifier: MIT
// A budget of texels or bytes, shared so that the worst visible artifact is as small as it can be.
//
// Light i needs n_i = c / r_i texels and gets N_i; its artifacts are n_i / N_i of what the study
// allows. The allotment minimises the largest of these over all lights with sum cost_i N_i^2 within
// the budget, on the levels of levels.h, and no light gets a level above the one that meets its
// need. That is the allotment for the smallest such ratio e: N_i the smallest level of at least
// n_i / e (between the light's limits). What is left then goes to the lights with the worst ratio
// that it can still raise by a level. Ties: the light that comes first in the array keeps or gets
// the texels. Where even the smallest sizes are too much, they are what everyone gets, and
// `feasible` says so.
//
// Integers only, no allocation: the same on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "resolution_controller/levels.h"

namespace resolution_controller {

struct BudgetLight {
    std::int32_t need = 0;    ///< texels, >= 0: what the ratio is measured by
    std::int32_t lowest = 0;  ///< level: never less
    std::int32_t wanted = 0;  ///< level: never more; the one that meets the need, or a limit below
    std::int32_t costPerTexel = 1;  ///< in 1 to 65536
    LevelRatio levelRatio = LevelRatio::sqrtTwo;
    std::int32_t size = 0;  ///< out: the level allotted
};

struct BudgetUse {
    bool feasible = true;      ///< false: even the smallest sizes cost more than the budget
    std::uint64_t wanted = 0;  ///< what all that is wanted would cost
    std::uint64_t used = 0;    ///< what the allotment costs
    bool operator==(const BudgetUse&) const = default;
};

/// Largest number of lights that share a budget; beyond it the cost could overflow.
inline constexpr std::size_t kMostLights = 4096;

/// Fills in `size`. `scratch` needs room for as many entries as there are lights. A negative budget
/// counts as 0. At most kMostLights lights.
BudgetUse shareBudget(std::span<BudgetLight> lights, std::int64_t budget,
                      std::span<std::uint32_t> scratch) noexcept;

}  // namespace resolution_controller
