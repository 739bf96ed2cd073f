// SPDX-License-Identifier: MIT
// The published way to a slope, and two lines that are not forced through the origin, for
// comparison: least squares on the threshold radii of thresholds.h, each of one observer in one
// condition, against the artifact size.
//
//   through the origin   r = c a, in px (Kreuzer eq. 1). Assumes that radii scatter equally at
//   every
//                        size. They scatter by a factor, so that the largest size decides, and the
//                        mean of a factor's scatter lies above its centre: about 4 % too large at
//                        the usual spread between observers.
//   affine               r = r0 + s a, in px. The same assumption; r0 beside its error tells
//   whether
//                        the line passes through the origin. s is not c.
//   power law            log10 r = log10(c a0) + k log10(a / a0), a0 the geometric mean of the
//                        sizes. Assumes scatter by a factor, equal at every size; k is 1 under r =
//                        c a, and c is free of the 4 %.
//
// None of them has an interval here: all take the thresholds of one observer for independent, and
// such intervals cover 13 to 46 % where they claim 95 %. Censored cells are left out.
#pragma once

#include <optional>
#include <vector>

#include "analysis/thresholds.h"

namespace analysis {

struct LineFits {
    struct Affine {
        double interceptPx = 0;  ///< r0
        double slope = 0;        ///< s
    };
    struct PowerLaw {
        double log10c = 0;       ///< of c at a0
        double exponent = 0;     ///< k
        double referencePx = 0;  ///< a0
    };
    int cells = 0;                        ///< thresholds that entered
    std::optional<double> throughOrigin;  ///< c, not log10; absent without a threshold
    std::optional<Affine> affine;         ///< absent without two sizes
    std::optional<PowerLaw> powerLaw;     ///< likewise
    /// Root mean square distance of the radii from each line, px, for comparison between the three.
    double residualPx = 0, affineResidualPx = 0, powerLawResidualPx = 0;
};

/// Of one group, or of all conditions together.
LineFits lineFits(const Study& study, const std::vector<CellThreshold>& thresholds,
                  std::optional<std::size_t> group = std::nullopt);

}  // namespace analysis
