// SPDX-License-Identifier: MIT
#include "resolution_controller/demand.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace resolution_controller {
namespace {

constexpr float kAnisotropyLimit = 4;

bool positiveAndFinite(float value) {
    return value > 0 && std::isfinite(value);
}

}  // namespace

float pixelFootprint(const UvDerivatives& d) noexcept {
    // Singular values of a 2 x 2 matrix as sum and difference of two lengths. A square root, unlike
    // hypot(), is the same everywhere.
    const auto length = [](float x, float y) { return std::sqrt(x * x + y * y); };
    const float larger = length(d.dudx + d.dvdy, d.dvdx - d.dudy) / 2;
    const float other = length(d.dudx - d.dvdy, d.dvdx + d.dudy) / 2;
    const float largest = larger + other;
    if (!positiveAndFinite(largest)) return 0;
    return std::max(std::abs(larger - other), largest / kAnisotropyLimit);
}

float demand(float c, float radiusUv, float footprint, float pixelBound) noexcept {
    if (!positiveAndFinite(c) || !(radiusUv >= 0) || !std::isfinite(radiusUv)) return 0;
    const float forFilter = radiusUv > 0 ? c / radiusUv : std::numeric_limits<float>::infinity();
    if (!positiveAndFinite(footprint) || !positiveAndFinite(pixelBound)) return forFilter;
    return std::min(forFilter, pixelBound / footprint);
}

}  // namespace resolution_controller
