// SPDX-License-Identifier: MIT
#include "stimulus/difference_bound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace stimulus {
namespace {

/// Sum of the rises and falls, over [low, high], of an even function that is monotone on each side
/// of 0.
template <typename Function>
double variation(double low, double high, Function f) {
    if (low >= 0 || high <= 0) return std::abs(f(high) - f(low));
    return std::abs(f(0) - f(low)) + std::abs(f(0) - f(high));
}

/// The circle is crossed by the band at heights t = -sin of its normal's angle, left and right. Per
/// unit of r its boundary moves outwards by 1 and its centre by delta: by 1 - delta t in all.
DifferenceBound discBound(double delta, double spread, double band) {
    const double low = std::clamp(delta - spread - band, -1.0, 1.0);
    const double high = std::clamp(delta + spread + band, -1.0, 1.0);
    const auto halfChord = [](double t) { return std::sqrt((1 - t) * (1 + t)); };
    const double arc = std::asin(high) - std::asin(low);
    const double outside = std::max(std::abs(delta) - 1, 0.0);  // where 1 - delta t may be negative
    const double moved =
        arc * (1 + spread + 2 * outside) + delta * (halfChord(high) - halfChord(low));
    constexpr double scale = 2 * std::numbers::inv_pi;  // two arcs, density 1/pi
    return {.along = scale * (high - low),
            .across = scale * variation(low, high, halfChord),
            .inRadius = scale * moved};
}

DifferenceBound boxBound(double delta, double spread, double band, double cosAngle,
                         double sinAngle) {
    struct Side {
        double across, along;  // components of the outward normal
    };
    const std::array<Side, 4> sides{{{cosAngle, sinAngle},
                                     {-cosAngle, -sinAngle},
                                     {sinAngle, -cosAngle},
                                     {-sinAngle, cosAngle}}};
    DifferenceBound bound;
    for (const auto& [across, along] : sides) {
        // The side covers across +- |along| in the direction across the edge; the band lies at
        // -delta.
        const double half =
            std::max(std::abs(along), 1e-12);  // a level side lies in or out as a whole
        const double low = std::max(across - half, -delta - spread - band);
        const double high = std::min(across + half, -delta + spread + band);
        if (high <= low) continue;
        const double mass = (high - low) / half / 4;  // length of the part in the band, density 1/4
        bound.along += mass * std::abs(along);
        bound.across += mass * std::abs(across);
        bound.inRadius += mass * (std::abs(1 + delta * across) + spread);
    }
    return bound;
}

DifferenceBound gaussianBound(double delta, double spread, double band) {
    const double low = delta - spread - band, high = delta + spread + band;
    constexpr double peak = 2 / (std::numbers::sqrt2 / std::numbers::inv_sqrtpi);  // 2 / sqrt(2 pi)
    const auto density = [](double t) { return peak * std::exp(-2 * t * t); };
    const double mass =
        marginal(KernelShape::gaussian, high) - marginal(KernelShape::gaussian, low);
    const double change = variation(low, high, density);
    // Along the edge the density's gradient integrates to twice its peak, and weighted with the
    // distance to 1.
    return {
        .along = mass * 2 * peak, .across = change, .inRadius = mass + (spread + band) * change};
}

}  // namespace

DifferenceBound differenceBound(KernelShape shape, double delta, double spread,
                                double bandHalfWidth, double cosAngle, double sinAngle) {
    if (shape == KernelShape::disc) return discBound(delta, spread, bandHalfWidth);
    if (shape == KernelShape::gaussian) return gaussianBound(delta, spread, bandHalfWidth);
    return boxBound(delta, spread, bandHalfWidth, cosAngle, sinAngle);
}

}  // namespace stimulus
