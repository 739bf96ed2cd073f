// SPDX-License-Identifier: MIT
// What a number in a file may be. Every reader names the rule in its own words when a number breaks
// it, so that rule and sentence cannot drift apart. NaN and infinity break every rule.
//
//   fields.number("beta", records::kPositive);               // "must be a number greater than 0"
//   fields.number("lapse", records::between(0, 0.15));       // "must be a number from 0 to 0.15"
#pragma once

#include <limits>
#include <string>

namespace records {

struct NumberRule {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool lowIncluded = true;
    bool highIncluded = true;

    bool holds(double value) const;
    /// "must be a number greater than 0"; `kind` replaces "number" ("whole number").
    std::string text(const std::string& kind = "number") const;
};

inline constexpr NumberRule kFinite{};
inline constexpr NumberRule kPositive{.low = 0, .lowIncluded = false};
inline constexpr NumberRule kNotNegative{.low = 0};
inline constexpr NumberRule kShare{.low = 0, .high = 1};  ///< [0, 1]
inline constexpr NumberRule kInsideShare{                 ///< (0, 1)
                                         .low = 0,
                                         .high = 1,
                                         .lowIncluded = false,
                                         .highIncluded = false};

constexpr NumberRule atLeast(double low) {
    return {.low = low};
}
constexpr NumberRule between(double low, double high) {
    return {.low = low, .high = high};
}

}  // namespace records
