// SPDX-License-Identifier: MIT
// A measured time: count, median and spread. A mean would follow whatever else the machine did.
#pragma once

#include <vector>

namespace demo {

struct Spread {
    int count = 0;
    double median = 0;
    double p25 = 0, p75 = 0;  ///< quartiles
    double least = 0;
};

/// Quantiles by linear interpolation. All zero for no values.
Spread spreadOf(std::vector<double> values);

}  // namespace demo
