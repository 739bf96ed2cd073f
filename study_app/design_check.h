// SPDX-License-Identifier: MIT
// What a design will give before anybody sits in front of it: whole sessions with simulated
// observers, in memory, and from them how long a session takes, how well thresholds and slopes come
// out, and how often the staircases ask for what the display cannot show.
//
//   const DesignCheck check = checkDesign(design, {}, 1);
//   std::printf("%s", checkText(check, design, 10).c_str());
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study_app/design.h"
#include "study_app/simulated_population.h"

namespace study_app {

/// Sessions that are simulated: deviations are then known to 1 / sqrt(2 * 200) = 5 %.
inline constexpr int kCheckSessions = 200;
struct ConditionCheck {
    std::string name;
    double c = 0;             ///< geometric mean of the thresholds, r / a
    double errorSd = 0;       ///< of one observer's threshold about the own true one, log10 units
    double spreadSd = 0;      ///< of it over observers, their differences included, log10 units
    double beyondLimits = 0;  ///< share of the proposals that the display cannot show
    double leastC = 0, mostC = 0;  ///< r / a that it can show
};

/// Conditions that differ in the artifact size alone have one slope c.
struct GroupCheck {
    std::string name;
    double c = 0;         ///< geometric mean
    double spreadSd = 0;  ///< over observers, of their mean over the sizes, log10 units
};

struct DesignCheck {
    std::vector<ConditionCheck> conditions;
    std::vector<GroupCheck> groups;
    double beyondLimits = 0;  ///< share over all conditions
};

/// `onSession` is called after each of kCheckSessions sessions. Throws std::invalid_argument where
/// the design does not validate.
DesignCheck checkDesign(const Design& design, const SimulatedPopulation& population,
                        std::uint64_t seed, const std::function<void()>& onSession = {});

/// For people: minutes and trials, a table of conditions, the slopes that `observers` of them give,
/// and a warning where more than kLimitShare of the proposals cannot be shown. The deviation
/// of a slope is that of the mean over observers (two stages); the interval of a fit lies near it.
std::string checkText(const DesignCheck& check, const Design& design, int observers);

/// What the design subtends on a display of this resolution, a line for each artifact size.
std::string visibleRangeText(const Design& design, double pxPerDeg);

}  // namespace study_app
