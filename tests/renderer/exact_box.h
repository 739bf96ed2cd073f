// SPDX-License-Identifier: MIT
// The box filter on a straight edge in closed form, written without looking at the shaders.
#pragma once

#include <algorithm>
#include <cmath>

namespace tests {

/// Visibility at a distance from the edge of a half-plane, positive on the lit side, under a box of
/// half-width h whose side makes an angle with the edge: the box's mass projected on the edge's
/// normal is a trapezium.
inline double boxProfile(double distance, double h, double angleRad) {
    const double p = h * std::abs(std::sin(angleRad));
    const double q = h * std::abs(std::cos(angleRad));
    const auto ramp = [](double s) { return s > 0 ? s * s / 2 : 0; };
    if (std::min(p, q) < 1e-9 * h) return std::clamp(0.5 + distance / (2 * h), 0.0, 1.0);
    const double d = distance;
    return (ramp(d + p + q) - ramp(d + q - p) - ramp(d - q + p) + ramp(d - p - q)) / (4 * p * q);
}

}  // namespace tests
