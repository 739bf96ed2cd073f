// SPDX-License-Identifier: MIT
// exp(-x) for x in [0, 700] without branches or calls, so that loops over it are vectorised: most
// of a fit's time is spent here. Relative error below 4e-16.
//
// Method: x = k ln 2 + r with |r| <= ln 2 / 2, the Taylor series of exp(-r) to degree 13 (the next
// term is 4e-18), and k taken off the exponent bits (W. J. Cody and W. Waite, "Software Manual for
// the Elementary Functions", 1980, chapter 6).
#pragma once

#include <bit>
#include <cstdint>

namespace analysis {

inline double expMinus(double x) {
    constexpr double perLn2 = 1.4426950408889634;
    // ln 2 in two parts: k times the first is exact.
    constexpr double ln2High = 0.693147180369123816490, ln2Low = 1.90821492927058770002e-10;
    // Adding 1.5 x 2^52 rounds to an integer, which is then the lowest bits of the sum.
    constexpr double rounder = 6755399441055744.0;
    const double shifted = x * perLn2 + rounder;
    const double k = shifted - rounder;
    const double r = (k * ln2High - x) + k * ln2Low;  // minus the remainder
    double series = 1.0 / 6227020800.0;
    series = series * r + 1.0 / 479001600.0;
    series = series * r + 1.0 / 39916800.0;
    series = series * r + 1.0 / 3628800.0;
    series = series * r + 1.0 / 362880.0;
    series = series * r + 1.0 / 40320.0;
    series = series * r + 1.0 / 5040.0;
    series = series * r + 1.0 / 720.0;
    series = series * r + 1.0 / 120.0;
    series = series * r + 1.0 / 24.0;
    series = series * r + 1.0 / 6.0;
    series = series * r + 0.5;
    series = series * r + 1.0;
    series = series * r + 1.0;
    const auto power = std::bit_cast<std::uint64_t>(shifted) << 52;
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(series) - power);
}

}  // namespace analysis
