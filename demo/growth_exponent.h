// SPDX-License-Identifier: MIT
// How a cost grows: the exponent e of cost = k x^e, by least squares on logarithms.
#pragma once

#include <utility>
#include <vector>

namespace demo {

struct GrowthExponent {
    double exponent = 0;
    /// Of the exponent's 95 % interval, by Student's t: where the points scatter about a power.
    double halfWidth95 = 0;
    double residual = 0;  ///< RMS of the logarithms' differences, as a share of the cost
    int points = 0;       ///< used: those above 0 and finite; with fewer than 3 all is 0
};

/// Points are (x, cost).
GrowthExponent growthExponent(const std::vector<std::pair<double, double>>& points);

}  // namespace demo
