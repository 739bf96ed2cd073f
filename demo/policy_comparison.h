// SPDX-License-Identifier: MIT
// Sizing policies at equal quality, from a measured sweep: each policy's one parameter is set so
// that the edge ripple of 95 % of the contour pixels meets the same bound, and what is left to
// compare is the time.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "demo/sizing_policy.h"
#include "demo/sweep_table.h"

namespace demo {

inline constexpr double kRippleBound = 0.13;

/// Over what the 95 % are taken. Together, a scene with few contour pixels may be drawn as badly as
/// one likes while the others make up for it; a game is played in all of its scenes.
enum class RippleOver { eachScene, allTogether };

/// What a policy gives for one technique with one value of its parameter.
struct PolicyResult {
    const SizingPolicy* policy = nullptr;
    std::string technique;
    int step = 0;  ///< policyParameter(policy->standard, step)
    double parameter = 0;

    double rippleP95 = 0;           ///< over the path of the scene in which it is largest
    double rippleP95Together = 0;   ///< over the paths of all scenes
    double worstRmse = 0;           ///< of a frame
    std::vector<double> sceneMs;    ///< mean frame time of each scene; NaN where not measured
    std::vector<double> sceneRmse;  ///< worst frame of each scene
    double geometricMeanMs = 0;     ///< over the scenes; NaN where one was not measured
    int smallest = 0, largest = 0;  ///< sizes taken
    std::string missing;            ///< what was not measured, empty: nothing

    bool complete() const { return missing.empty(); }
    double ripple(RippleOver over) const {
        return over == RippleOver::eachScene ? rippleP95 : rippleP95Together;
    }
};

/// A policy with a parameter, or with a fixed sequence where there is no policy: evaluates the
/// sizes of that step in every frame.
PolicyResult evaluate(const SweepTable& table, const SizingPolicy& policy,
                      const std::string& technique, int step);

/// The fastest parameter that keeps to the bound; absent where none does.
std::optional<PolicyResult> calibrated(const SweepTable& table, const SizingPolicy& policy,
                                       const std::string& technique, RippleOver over,
                                       double bound = kRippleBound);

/// The parameter that leaves the least ripple; absent where no parameter has all its sizes
/// measured. A policy that stops at pixels reaches no finer maps with any c, and its texels still
/// ripple by parts of a pixel.
std::optional<PolicyResult> leastRipple(const SweepTable& table, const SizingPolicy& policy,
                                        const std::string& technique, RippleOver over);

/// One technique's row of the comparison.
struct PolicyComparison {
    std::string technique;
    RippleOver over = RippleOver::eachScene;
    /// kRippleBound, or what the automatic size leaves at least where it does not reach that with
    /// any c: quality is equal in any case, and the report says which.
    double bound = 0;
    struct Entry {
        const SizingPolicy* policy = nullptr;
        std::optional<PolicyResult> result;   ///< absent: it cannot keep to the bound
        std::optional<PolicyResult> nearest;  ///< then: with the least ripple, where measured
        /// Geometric mean of its time over ours; below 1 we lose, NaN without both.
        double timesOurs = std::numeric_limits<double>::quiet_NaN();
    };
    std::vector<Entry> entries;  ///< in the order of sizingPolicies()
    std::optional<PolicyResult> ours;
};
std::vector<PolicyComparison> comparePolicies(const SweepTable& table,
                                              RippleOver over = RippleOver::eachScene,
                                              double bound = kRippleBound);

/// The automatic policy with the slope c itself, and how its time and errors change with c.
struct SlopeStep {
    double c = 0;
    PolicyResult result;
};
std::vector<SlopeStep> sweepOverSlope(const SweepTable& table, const std::string& technique,
                                      const std::vector<double>& slopes);

}  // namespace demo
