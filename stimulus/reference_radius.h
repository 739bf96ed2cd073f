// SPDX-License-Identifier: MIT
// The reference filter size: the radius from which the filtered artifact cannot be told from the
// filtered straight edge by their display codes, whoever looks (Kreuzer, "Using Perception-Based
// Filtering to Hide Shadow Artifacts", section 5 and Fig. 4). Three sizes, from D(r), the largest
// |encode(V_artifact) - encode(V_straight)| over the pixels of one period, and W = 255 x lit level:
//
//   halfCode   W D(r) < 1/2: no code differs by more than rounding may cause. Independent of where
//              rounding happens to fall; the default line of a figure
//   oneCode    no pixel's codes differ by more than 1
//   identical  the two images are the same, literally; depends on phase, and hardly ever reached
//
// each as the smallest radius on a grid of 0.25 px from which on the condition holds for all larger
// radii of the grid up to a bound. The disc's D wiggles as the radius grows, so the first radius
// that works may be smaller.
//
//   const auto radius = referenceRadius({.silhouette = {...}, .kernel = KernelShape::disc},
//                                       ReferenceCriterion::halfCode);   // 60.5, or nothing
#pragma once

#include <optional>

#include "stimulus/display_code.h"
#include "stimulus/kernel.h"
#include "stimulus/silhouette.h"

namespace stimulus {

enum class ReferenceCriterion { halfCode, oneCode, identical };

struct ReferenceOptions {
    SilhouetteOptions silhouette{};
    KernelShape kernel = KernelShape::disc;
    double litLevel = 1;                 ///< share of full white, in [0, 1]
    Encoding encoding = Encoding::code;  ///< of the published figure
    int windowPx = 600;                  ///< examined where the pattern has no period
    double maxRadiusPx = 600;            ///< bound of "all larger radii", in [1, 8192]
};

inline constexpr double kRadiusGridPx = 0.25;

/// Throws std::invalid_argument that names the value and the rule.
void validate(const ReferenceOptions& options);

/// Nothing where the criterion fails at the bound itself: not reached. Throws as validate() does.
std::optional<double> referenceRadius(const ReferenceOptions& options,
                                      ReferenceCriterion criterion);

/// D(r): every pixel of one period, or of the window's columns where there is none.
double largestDifference(const ReferenceOptions& options, double radiusPx);

}  // namespace stimulus
