// SPDX-License-Identifier: MIT
#include "renderer/shadow_window.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace renderer {
namespace {

// Air around the casters, so that none touches the map's edge.
constexpr double kMargin = 1.02;
// Extents of narrowed windows: 2^(1/4) apart.
constexpr double kStepsPerOctave = 4;
// Room for the snap, at most half a texel to either side.
constexpr double kSnapRoom = 1.0 / kLeastSnapped;
// A low sun sees the ground at the far edge of its window from very far; depth precision is worth
// more.
constexpr double kMostDepthPerExtent = 4;

std::array<glm::dvec3, 8> corners(const Bounds& bounds) {
    std::array<glm::dvec3, 8> all;
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = {(i & 1) != 0 ? bounds.high.x : bounds.low.x,
                  (i & 2) != 0 ? bounds.high.y : bounds.low.y,
                  (i & 4) != 0 ? bounds.high.z : bounds.low.z};
    return all;
}

}  // namespace

ShadowWindow fitShadowWindow(const Bounds& casters, const Sun& sun) {
    const glm::dvec3 span = glm::dvec3(casters.high) - glm::dvec3(casters.low);
    if (!(glm::length(span) > 0) || !std::isfinite(glm::length(span)))
        throw std::invalid_argument("shadow window: the casters' bounds span " +
                                    std::to_string(glm::length(span)) +
                                    " m, must be finite and > 0");
    if (!(sun.elevationDeg > 0 && sun.elevationDeg <= 90) || !std::isfinite(sun.azimuthDeg) ||
        !std::isfinite(sun.mapTurnDeg))
        throw std::invalid_argument("shadow window: the sun stands " +
                                    std::to_string(sun.elevationDeg) +
                                    " degrees over the horizon, must be in (0, 90]");

    const glm::dvec3 light = glm::normalize(glm::dvec3(sun.towards()));
    const double azimuth = glm::radians(static_cast<double>(sun.azimuthDeg));
    const glm::dvec3 level = {std::cos(azimuth), 0, -std::sin(azimuth)};
    const double turn = glm::radians(static_cast<double>(sun.mapTurnDeg));
    const glm::dvec3 right = std::cos(turn) * level + std::sin(turn) * glm::cross(light, level);
    const glm::dvec3 up = glm::cross(light, right);

    glm::dvec3 low(1e300);
    glm::dvec3 high(-1e300);
    for (const glm::dvec3& corner : corners(casters)) {
        const glm::dvec3 p(glm::dot(corner, right), glm::dot(corner, up), -glm::dot(corner, light));
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const double extent = kMargin * std::max(high.x - low.x, high.y - low.y);
    const glm::dvec2 centre = 0.5 * glm::dvec2(low.x + high.x, low.y + high.y);

    // A point with coordinates (x, y, z) along (right, up, -light) has the height right.y x + up.y
    // y - light.y z. So the ground under the square is farthest from the light in the corner where
    // right.y x + up.y y is largest.
    const double highest =
        right.y * centre.x + up.y * centre.y + 0.5 * extent * (std::abs(right.y) + std::abs(up.y));
    const double groundDepth = (highest - casters.low.y) / light.y;
    const double nearest = low.z - 0.01 * extent;
    const double farthest =
        std::max(high.z, std::min(groundDepth, nearest + kMostDepthPerExtent * extent)) +
        0.01 * extent;

    ShadowWindow window;
    window.extentM = extent;
    window.depthRangeM = farthest - nearest;
    window.towardsLight = glm::vec3(light);
    const glm::dvec4 rows[4] = {{right / extent, 0.5 - centre.x / extent},
                                {up / extent, 0.5 - centre.y / extent},
                                {-light / window.depthRangeM, -nearest / window.depthRangeM},
                                {0, 0, 0, 1}};
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            window.shadowFromWorld[column][row] = rows[row][column];
    return window;
}

namespace {

/// u, v or depth as a plane of world positions.
glm::dvec4 rowOf(const ShadowWindow& window, int row) {
    const glm::dmat4& m = window.shadowFromWorld;
    return {m[0][row], m[1][row], m[2][row], m[3][row]};
}

double extentOf(int step) {
    return std::exp2(step / kStepsPerOctave);
}

}  // namespace

ConvexBody shadowedBody(const ShadowWindow& whole, const Bounds& casters) {
    // A plane on which everything stands is seen with its rounding.
    const double slack = 1e-4 * whole.extentM;
    ConvexBody body{{0, 1, 0, slack - static_cast<double>(casters.low.y)},
                    {0, -1, 0, slack + static_cast<double>(casters.high.y)}};
    for (const int row : {0, 1}) {
        body.push_back(rowOf(whole, row));
        body.push_back(glm::dvec4(0, 0, 0, 1) - rowOf(whole, row));
    }
    return body;
}

ShadowWindow narrowShadowWindow(const ShadowWindow& whole, const Bounds& casters,
                                const ConvexBody& seen, double reachM,
                                std::optional<int>& heldStep) {
    ConvexBody body = shadowedBody(whole, casters);
    body.insert(body.end(), seen.begin(), seen.end());
    glm::dvec2 low(1);
    glm::dvec2 high(0);
    for (const glm::dvec3& corner : cornersOf(body)) {
        const glm::dvec2 uv(whole.shadowFromWorld * glm::dvec4(corner, 1));
        low = glm::min(low, uv);
        high = glm::max(high, uv);
    }
    if (!(low.x <= high.x && low.y <= high.y)) return whole;  // nothing to see: keep the step

    const double seenM = std::max(high.x - low.x, high.y - low.y) * whole.extentM + 2 * reachM;
    int step = static_cast<int>(std::ceil(kStepsPerOctave * std::log2(seenM / (1 - kSnapRoom))));
    // Held while it is large enough and the next smaller one would be nearly too small.
    if (heldStep && step == *heldStep - 1) step = *heldStep;
    if (extentOf(heldStep ? step : step + 1) >= whole.extentM) {
        heldStep.reset();
        return whole;
    }
    heldStep = step;

    ShadowWindow window = whole;
    window.extentM = extentOf(step);
    window.narrowed = true;
    const double scale = whole.extentM / window.extentM;
    const glm::dvec2 centre = 0.5 * (low + high);
    for (const int row : {0, 1}) {
        const glm::dvec4 narrow =
            scale * rowOf(whole, row) + glm::dvec4(0, 0, 0, 0.5 - scale * centre[row]);
        for (int column = 0; column < 4; ++column)
            window.shadowFromWorld[column][row] = narrow[column];
    }
    return window;
}

ShadowWindow snapToTexels(const ShadowWindow& window, int resolution) {
    if (!window.narrowed || resolution < kLeastSnapped) return window;
    ShadowWindow snapped = window;
    for (const int row : {0, 1}) {
        // Where the world's origin lies on the map, in texels.
        const double origin = window.shadowFromWorld[3][row] * resolution;
        snapped.shadowFromWorld[3][row] = std::round(origin) / resolution;
    }
    return snapped;
}

}  // namespace renderer
