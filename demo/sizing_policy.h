// SPDX-License-Identifier: MIT
// The ways in which engines choose the size of a shadow map, beside ours: one row each, with the
// one number that each of them is tuned by. They see a frame as FrameFacts and nothing else, so
// that a measured table can be asked what any of them would have cost (policy_comparison.h).
#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "resolution_controller/demand.h"
#include "resolution_controller/levels.h"
#include "resolution_controller/slope.h"

namespace demo {

struct FrameFacts {
    double screenEdgePx = 0;    ///< the longer edge of the viewport
    double coveredPx = 0;       ///< pixels of surfaces that the light's map reaches
    double casterRadiusPx = 0;  ///< of the sphere around all casters, projected
    double mapExtentM = 0;
    double distanceM = 0;  ///< from the eye to the middle of the casters, > 0
    resolution_controller::Slope slope;
    /// What the visible points in penumbra ask for under a rule.
    std::function<resolution_controller::DemandHistogram(const resolution_controller::DemandRule&)>
        demand;
};

struct SizingPolicy {
    std::string_view name;       ///< as in tables
    std::string_view title;      ///< as in the report
    std::string_view source;     ///< who does it so
    std::string_view parameter;  ///< what the number is, with its unit
    double standard = 1;         ///< as the source has it; a guess where it has none
    bool ours = false;
    resolution_controller::LevelRatio levels = resolution_controller::LevelRatio::sqrtTwo;
    /// Texels before they are rounded up to a level; 0 where the frame asks for nothing.
    double (*texels)(const FrameFacts& facts, double parameter);
};

std::span<const SizingPolicy> sizingPolicies();
/// Throws std::invalid_argument that lists the known names.
const SizingPolicy& findSizingPolicy(std::string_view name);
/// The policy that the programs use for --resolution auto.
const SizingPolicy& automaticPolicy();

/// The smallest of `sizes` (levels, ascending, at least one) that is no less than the level which
/// the policy takes; the largest where none is.
int chosenSize(const SizingPolicy& policy, const FrameFacts& facts, double parameter,
               std::span<const int> sizes);

/// chosenSize() for each of ascending parameters. A larger one never takes a smaller map, so that
/// between two with the same size none is asked.
std::vector<int> chosenSizes(const SizingPolicy& policy, const FrameFacts& facts,
                             std::span<const double> parameters, std::span<const int> sizes);

}  // namespace demo
