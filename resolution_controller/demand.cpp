// SPDX-License-Identifier: MIT
#include "resolution_controller/demand.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "resolution_controller/slope.h"

namespace resolution_controller {
namespace {

constexpr float kAnisotropyLimit = 4;

bool positiveAndFinite(float value) {
    return value > 0 && std::isfinite(value);
}

/// A texel smaller than a pixel cannot be seen.
float atMostPerPixel(float texels, float footprint, float pixelBound) {
    if (!positiveAndFinite(footprint) || !positiveAndFinite(pixelBound)) return texels;
    return std::min(texels, pixelBound / footprint);
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
    return atMostPerPixel(forFilter, footprint, pixelBound);
}

std::uint32_t demandWeight(float shownRadiusUv, float footprint) noexcept {
    if (!positiveAndFinite(footprint) || !(shownRadiusUv >= 0) || !std::isfinite(shownRadiusUv)) {
        return 1;
    }
    if (footprint / 2 >= shownRadiusUv) return kWholeDemandWeight;
    const float share = footprint / 2 / shownRadiusUv * static_cast<float>(kWholeDemandWeight);
    return static_cast<std::uint32_t>(std::max(share + 0.5f, 1.0f));
}

float demand(const DemandRule& rule, const DemandPoint& point) noexcept {
    float c = rule.c;
    if (rule.contrastExponent != 0) {
        c *= static_cast<float>(contrastFactor(point.contrast, rule.contrastExponent));
    }
    const float forFilter = demand(c, point.radiusUv, 0);
    if (forFilter == 0) return 0;
    float forDetail = 0;
    if (positiveAndFinite(point.casterWidthUv) && positiveAndFinite(rule.texelsPerCaster)) {
        forDetail = rule.texelsPerCaster / point.casterWidthUv;
    }
    return atMostPerPixel(std::max(forFilter, forDetail), point.footprint, rule.pixelBound);
}

}  // namespace resolution_controller
