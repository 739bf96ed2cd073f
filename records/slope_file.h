// SPDX-License-Identifier: MIT
// slope.json: the slope c of r = c a (filter radius = c times artifact size, the edge of one
// shadow-map texel in the same unit) with everything without which the number means nothing:
// criterion, task, kernel, encoding and psychometric slope. Written by fit_slope, read by the
// programs that render.
//
// What `c` is: the worst group (maximum over pattern or angle x lit level) for the mean observer,
// with an interval that accounts for the maximum (METHODS section 5).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "records/run_context.h"
#include "records/trial_table.h"

namespace records {

inline constexpr int kSlopeFileMajor = 1;

struct Interval {
    double low = 0, high = 0;
    bool operator==(const Interval&) const = default;
};

struct Estimate {
    double estimate = 0;
    std::optional<Interval>
        ci95;  ///< absent where it cannot be had (one observer, ...); `method` says why
    bool operator==(const Estimate&) const = default;
};

struct SlopeGroup {
    std::string name;  ///< "stair, lit 1", "line 22.5 deg, lit 1"
    Pattern pattern = Pattern::stair;
    std::optional<double> angleDeg;
    double litLevel = 1;
    Estimate c;
    int trials = 0;
    bool operator==(const SlopeGroup&) const = default;
};

struct Slope {
    Estimate c;                 ///< headline, see above
    std::string worstGroup;     ///< name of the group it belongs to
    Estimate cOverall;          ///< one slope for all groups, mean observer
    Estimate c90;               ///< the worst group's c for the 90th-percentile observer
    double criterion = 0;       ///< F*, corrected detection probability at r = c a
    double percentCorrect = 0;  ///< what F* stands for in the task, in percent
    Task task = Task::twoAfc;
    std::string kernel;
    std::optional<Encoding> encoding = Encoding::srgb;  ///< absent where no trial table says it
    double beta = 0;                                    ///< psychometric slope of the fit
    double observerSd = 0;                              ///< tau, log10 units
    double observerConditionSd = 0;                     ///< omega, log10 units
    Estimate kappa;                                     ///< exponent of r = c a0 (a/a0)^kappa
    std::optional<double>
        kappaPValue;  ///< likelihood-ratio test of kappa = 1; absent with one size
    std::optional<Estimate> contrastExponent;  ///< e of c(C) = c C^e; absent with one lit level
    std::vector<SlopeGroup> groups;
    int observers = 0;
    int trials = 0;
    std::optional<double> pxPerDeg;  ///< where every session has it, their mean
    std::string method;              ///< one paragraph: estimator, intervals, screening, data
    RunContext context;

    bool operator==(const Slope&) const = default;
};

/// The headline in one sentence, for every place that shows c, since c means nothing without its
/// criterion, task, kernel, encoding and psychometric slope:
/// "c = 3.41 [3.20, 3.63] (r = c a; F* = .6465, 82 % correct in 2AFC; disc; srgb; beta 3.5; worst
/// group step, lit 1)".
std::string describe(const Slope& slope);
/// The same sentence in its two parts, for a headline with its meaning below: what is before the
/// bracket and what is in it. They are shown together or not at all.
std::string describeValue(const Slope& slope);
std::string describeTerms(const Slope& slope);

/// Written whole or not at all (temporary file, sync, rename). Throws std::invalid_argument for
/// what readSlope would refuse.
void writeSlope(const std::filesystem::path& file, const Slope& slope);
/// Throws std::runtime_error naming file, field, value and rule: unknown major schema, a missing
/// field, a number that is not finite, c <= 0, an interval that does not hold its order, a worst
/// group that is not among the groups (where there are any).
Slope readSlope(const std::filesystem::path& file);
/// The same on text that came from `file`.
Slope parseSlope(std::string_view text, const std::string& file);

}  // namespace records
