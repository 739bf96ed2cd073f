// SPDX-License-Identifier: MIT
// The filters whose size the study varies, as probability densities in the plane:
//
//   disc      uniform on the disc of radius r (a percentage-closer filter over a disc; the default)
//   box       uniform on the square of half-width r; a filter of 2h + 1 taps has half-width h + 1/2
//   gaussian  sigma = r / 2 in both directions, not cut off: the exact normal distribution
//
// and their masses in closed form, from which every filtered edge is put together. The functions
// work on the kernel of radius 1; normalised() brings lengths to its unit.
//
//   marginal(t)       mass in {x < t}, by symmetry also in {y < t}
//   quadrant(u, v)    mass in {x < u, y < v}, Q(u, v) of the stair-step formula
//   halfPlane(d, ..)  mass in the half plane whose edge passes at signed distance d from the centre
//
// Disc: circular segments; g(t) = (t sqrt(1 - t^2) + asin t) / pi is marginal(t) - 1/2, and with
// the corner inside the disc Q = 1/4 + (g(u) + g(v)) / 2 + u v / pi, the quarter, the two half
// segments and the rectangle. Box: Q = E(u) E(v), E(t) = clip((t + 1) / 2, 0, 1). Gaussian: Q = Phi
// Phi.
//
// Radius 0 is the unfiltered edge: masses are 0 or 1, and 1/2 (a corner: 1/4) where an edge passes
// exactly through the centre.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>

namespace stimulus {

enum class KernelShape { disc, box, gaussian };

std::string_view toText(KernelShape shape);  ///< "disc", "box", "gaussian"
std::optional<KernelShape> kernelShapeFromText(std::string_view text);

struct Kernel {
    KernelShape shape = KernelShape::disc;
    double radiusPx = 100;  ///< r, in [0, kMaxSizePx of silhouette.h]; a finite number
};

/// Throws std::invalid_argument that names the radius and the rule.
void validate(const Kernel& kernel);

/// A length in units of the radius. At radius 0: 0, or infinite with the sign of t.
inline double normalised(const Kernel& kernel, double t) {
    if (kernel.radiusPx > 0) return t / kernel.radiusPx;
    return t == 0 ? 0 : std::copysign(std::numeric_limits<double>::infinity(), t);
}

/// Beyond this distance from the axes, in units of the radius, masses are 0 or 1. Gaussian: 8.4
/// sigma, where 2e-17 is left, which is less than double can tell from 1.
inline double reach(KernelShape shape) {
    return shape == KernelShape::gaussian ? 4.2 : 1;
}

inline double marginal(KernelShape shape, double t) {
    if (shape == KernelShape::gaussian) return 0.5 * std::erfc(-t * std::numbers::sqrt2);
    if (t <= -1) return 0;
    if (t >= 1) return 1;
    if (shape == KernelShape::box) return (t + 1) / 2;
    return 0.5 + (t * std::sqrt((1 - t) * (1 + t)) + std::asin(t)) / std::numbers::pi;
}

/// Q(u, v) from the marginals of u and v, which a grid of evaluations shares.
inline double quadrant(KernelShape shape, double u, double marginalU, double v, double marginalV) {
    if (shape != KernelShape::disc) return marginalU * marginalV;
    if (u * u + v * v < 1)
        return 0.5 * (marginalU + marginalV) - 0.25 + u * v * std::numbers::inv_pi;
    if (u >= 0) return v >= 0 ? marginalU + marginalV - 1 : marginalV;
    return v >= 0 ? marginalU : 0;
}

inline double quadrant(KernelShape shape, double u, double v) {
    return quadrant(shape, u, marginal(shape, u), v, marginal(shape, v));
}

/// Mass in the half plane {x sin - y cos < d}: V of a straight edge at the given angle to the x
/// axis, d = signed distance of the kernel's centre from it, positive on the lit side.
double halfPlane(KernelShape shape, double d, double cosAngle, double sinAngle);

}  // namespace stimulus
