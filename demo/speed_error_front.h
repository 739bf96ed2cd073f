// SPDX-License-Identifier: MIT
// Which techniques and sizes are worth having: no other one is both faster and more exact.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "demo/sweep_table.h"

namespace demo {

/// A technique at one size over the frames of a scene's path, or of all scenes.
struct SpeedAndError {
    std::string technique;
    int resolution = 0;
    double frameMs = 0;  ///< mean over the frames; over several scenes the geometric mean
    double error = 0;    ///< resolution error: the worst frame's RMSE
    bool dominated = false;
};

/// Of one scene, or of all for an empty name; sizes that were not measured in every frame are left
/// out, and so is the reference, whose error is 0 by definition. By time.
std::vector<SpeedAndError> speedAndErrors(const SweepTable& table, const std::string& scene);

/// The fastest whose error is at most `mostError` and whose time is at most `mostMs`; with neither
/// limit reached, null. Among those that meet a limit on time alone, the most exact.
struct Wish {
    std::optional<double> mostError = {};
    std::optional<double> mostMs = {};
};
const SpeedAndError* recommended(const std::vector<SpeedAndError>& all, const Wish& wish);

}  // namespace demo
