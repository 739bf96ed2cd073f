// SPDX-License-Identifier: MIT
// x^y from additions, multiplications, divisions and bits alone: the same result on every machine
// with IEEE arithmetic, which the power functions of C libraries are not (their last bits differ,
// and a last bit can move a demand across the edge of a bin).
#pragma once

#include <bit>
#include <cstdint>

namespace resolution_controller {

/// log2 of a normal number > 0, within 4e-16 of the true value or of its size.
constexpr double portableLog2(double x) noexcept {
    constexpr double kSqrtTwo = 1.4142135623730951, kInverseLn2 = 1.4426950408889634;
    const auto bits = std::bit_cast<std::uint64_t>(x);
    auto exponent = static_cast<int>(bits >> 52) - 1023;
    auto mantissa =
        std::bit_cast<double>((bits & 0x000fffffffffffffu) | 0x3ff0000000000000u);  // [1, 2)
    if (mantissa > kSqrtTwo) {
        mantissa /= 2;
        ++exponent;
    }
    // ln m = 2 artanh s; s is at most .172, so that the terms left out are below 1e-17.
    const double s = (mantissa - 1) / (mantissa + 1);
    double series = 0;
    for (int power = 21; power >= 1; power -= 2) series = series * s * s + 1.0 / power;
    return exponent + 2 * s * series * kInverseLn2;
}

/// 2^y for |y| <= 1000.
constexpr double portableExp2(double y) noexcept {
    constexpr double kLn2 = 0.6931471805599453;
    const auto whole = static_cast<int>(y + (y < 0 ? -0.5 : 0.5));
    const double x = (y - whole) * kLn2;  // at most .347
    double series = 1;
    for (int term = 15; term >= 1; --term) series = 1 + series * x / term;
    return series * std::bit_cast<double>(static_cast<std::uint64_t>(whole + 1023) << 52);
}

/// x^y for a normal x > 0 and |y log2 x| <= 1000.
constexpr double portablePower(double x, double y) noexcept {
    return portableExp2(y * portableLog2(x));
}

}  // namespace resolution_controller
