// SPDX-License-Identifier: MIT
#include "resolution_controller/map_constants.h"

#include <algorithm>
#include <cmath>

namespace resolution_controller {
namespace {

constexpr double kHalfDiagonal = 0.7071067811865476;
constexpr double kMostTexels = 1 << 20;

double usableRadius(double radius) {
    return radius > 0 && std::isfinite(radius) ? radius : 0;
}

}  // namespace

MapConstants constantsFor(std::int32_t size, std::int32_t textureSize, double radiusUv,
                          double largestRadiusUv) noexcept {
    if (size < 1) return {};
    const std::int32_t texture = std::max(size, textureSize);
    const double radius = usableRadius(radiusUv);
    const double largest = std::max(radius, usableRadius(largestRadiusUv));
    MapConstants m;
    m.viewport = size;
    const double band = std::ceil(std::min(largest * size, kMostTexels)) + 1;
    m.cleared = static_cast<std::int32_t>(std::min<double>(size + band, texture));
    m.textureScale = static_cast<double>(size) / texture;
    m.texelUv = 1.0 / size;
    m.radiusUv = radius;
    m.radiusTexels = radius * size;
    // The centre lies anywhere in its texel.
    m.kernelReachTexels =
        radius > 0 ? static_cast<std::int32_t>(std::ceil(std::min(m.radiusTexels, kMostTexels)))
                   : 0;
    m.planeBiasUv = 0.5 / size;
    m.normalOffsetUv = kHalfDiagonal / size;
    return m;
}

}  // namespace resolution_controller
