// SPDX-License-Identifier: MIT
// The disc in closed form, written without looking at the shaders: the area that it shares with a
// rectangle, and what it makes of a straight edge.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tests {

/// Area of {x^2 + y^2 <= r^2} in [0, x] x [0, y], signed for negative x or y.
inline double discQuadrant(double x, double y, double r) {
    if (x < 0) return -discQuadrant(-x, y, r);
    if (y < 0) return -discQuadrant(x, -y, r);
    x = std::min(x, r);
    y = std::min(y, r);
    if (x * x + y * y <= r * r) return x * y;
    const auto integral = [r](double t) {
        return 0.5 * (t * std::sqrt(std::max(r * r - t * t, 0.0)) +
                      r * r * std::asin(std::min(t / r, 1.0)));
    };
    const double full = std::sqrt(r * r - x * x);  // below this height the strip reaches x
    return x * full + integral(y) - integral(full);
}

/// Share of the unit square around (x, y) that the disc of radius r around the origin covers.
inline double exactCoverage(double x, double y, double r) {
    return discQuadrant(x + 0.5, y + 0.5, r) - discQuadrant(x - 0.5, y + 0.5, r) -
           discQuadrant(x + 0.5, y - 0.5, r) + discQuadrant(x - 0.5, y - 0.5, r);
}

/// Visibility at x radii from the edge of a half-plane under a disc, x > 0 on the lit side.
inline double discProfile(double x) {
    if (x <= -1) return 0;
    if (x >= 1) return 1;
    return 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / std::numbers::pi;
}

/// Distance in radii between the profile's 10 % and 90 % points.
inline double discProfileWidth() {
    double low = 0;
    double high = 1;
    for (int i = 0; i < 60; ++i)
        (discProfile(0.5 * (low + high)) < 0.9 ? low : high) = 0.5 * (low + high);
    return 2 * low;
}

}  // namespace tests
