// SPDX-License-Identifier: MIT
// What was published for this task, to stand beside a fit: M. Kreuzer, section 5 and eq. 1. It was
// found at 82 % correct in 2AFC, F* = .6465; beside a fit at another criterion it has to be moved
// there, for which its own psychometric slope is taken.
#pragma once

#include <string>

namespace analysis {

inline constexpr double kPublishedSlope = 3.47;  ///< c, worst case
inline constexpr double kPublishedBeta = 3.5;

/// What the published c (3.47 unless given) is at that criterion.
double publishedAt(double criterion, double slope = kPublishedSlope);
/// "3.47", or at another criterion "6.67 (3.47 at F* = 0.6465)".
std::string publishedText(double criterion);

}  // namespace analysis
