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
// Of single precision's 24 bits a narrowed map's places lose one for each halving.
constexpr double kMostNarrowing = 256;

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

/// On a map.
struct UvRect {
    glm::dvec2 low{1e30}, high{-1e30};

    void add(const glm::dvec2& uv) {
        low = glm::min(low, uv);
        high = glm::max(high, uv);
    }
    bool empty() const { return !(low.x <= high.x && low.y <= high.y); }
};

glm::dvec2 placeOf(const ShadowWindow& window, const glm::dvec3& point) {
    const glm::dvec4 h = window.shadowFromWorld * glm::dvec4(point, 1);
    return glm::dvec2(h) / h.w;
}

UvRect shadowOf(const ConvexBody& body, const ShadowWindow& window) {
    UvRect rect;
    for (const glm::dvec3& corner : cornersOf(body)) rect.add(placeOf(window, corner));
    return rect;
}

/// A square of quantised extent around what is seen and the reach of a kernel; `grid` is a place on
/// the whole window. The whole comes back where the square would not be smaller.
ShadowWindow squareAround(const ShadowWindow& whole, const UvRect& seen, double reachM,
                          const glm::dvec2& grid, std::optional<int>& heldStep) {
    const glm::dvec2 span = seen.high - seen.low;
    const double seenM = std::max(std::max(span.x, span.y) * whole.extentM + 2 * reachM,
                                  whole.extentM / kMostNarrowing);
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
    const glm::dvec2 corner = 0.5 - scale * 0.5 * (seen.low + seen.high);  // the whole one's
    window.gridUv = scale * grid + corner;
    for (const int row : {0, 1}) {
        const glm::dvec4 narrow = scale * rowOf(whole, row) + corner[row] * rowOf(whole, 3);
        for (int column = 0; column < 4; ++column)
            window.shadowFromWorld[column][row] = narrow[column];
    }
    return window;
}

}  // namespace

void cutToPyramid(ConvexBody& body, const ShadowWindow& window, const glm::dvec2& low,
                  const glm::dvec2& high) {
    const glm::dvec4 w = rowOf(window, 3);
    for (const int row : {0, 1}) {
        body.push_back(rowOf(window, row) - low[row] * w);
        body.push_back(high[row] * w - rowOf(window, row));
    }
}

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
    const UvRect rect = shadowOf(body, whole);
    if (rect.empty()) return whole;  // nothing to see: keep the step
    // The world's origin.
    return squareAround(whole, rect, reachM, placeOf(whole, glm::dvec3(0)), heldStep);
}

ShadowWindow narrowLampWindow(const ShadowWindow& whole, const Bounds& casters,
                              const ConvexBody& seen, std::optional<int>& heldStep) {
    const double reachUv = whole.part.lowUv.x;
    const glm::dvec4 along = rowOf(whole, 3);
    ConvexBody throwing;
    cutToBox(throwing, casters);
    throwing.push_back(along - glm::dvec4(0, 0, 0, whole.nearM));
    throwing.push_back(glm::dvec4(0, 0, 0, whole.nearM + whole.depthRangeM) - along);
    cutToPyramid(throwing, whole, glm::dvec2(0), glm::dvec2(1));
    UvRect shadowed;
    double nearest = whole.nearM + whole.depthRangeM;
    for (const glm::dvec3& corner : cornersOf(throwing)) {
        shadowed.add(placeOf(whole, corner));
        nearest = std::min(nearest, glm::dot(along, glm::dvec4(corner, 1)));
    }
    UvRect rect;
    if (!shadowed.empty()) {
        ConvexBody receiving = seen;
        receiving.push_back(along - glm::dvec4(0, 0, 0, nearest));
        const glm::dvec2 low = glm::max(whole.part.lowUv, shadowed.low - reachUv);
        const glm::dvec2 high = glm::min(whole.part.highUv, shadowed.high + reachUv);
        cutToPyramid(receiving, whole, low, high);
        if (low.x < high.x && low.y < high.y) rect = shadowOf(receiving, whole);
    }
    if (rect.empty()) {  // keep the step
        ShadowWindow none = whole;
        none.part.lowUv = glm::dvec2(1);
        none.part.highUv = glm::dvec2(0);
        return none;
    }
    // Its corner; so gridUv is where that lies.
    ShadowWindow window =
        squareAround(whole, rect, reachUv * whole.extentM, glm::dvec2(0), heldStep);
    const double scale = whole.extentM / window.extentM;
    window.part.lowUv = window.gridUv + scale * whole.part.lowUv;
    window.part.highUv = window.gridUv + scale * whole.part.highUv;
    return window;
}

ShadowWindow snapToTexels(const ShadowWindow& window, int resolution) {
    if (!window.narrowed || resolution < kLeastSnapped) return window;
    ShadowWindow snapped = window;
    snapped.gridUv = glm::round(window.gridUv * static_cast<double>(resolution)) /
                     static_cast<double>(resolution);
    const glm::dvec2 moved = snapped.gridUv - window.gridUv;
    snapped.part.lowUv += moved;
    snapped.part.highUv += moved;
    for (const int row : {0, 1}) {
        const glm::dvec4 placed = rowOf(window, row) + moved[row] * rowOf(window, 3);
        for (int column = 0; column < 4; ++column)
            snapped.shadowFromWorld[column][row] = placed[column];
    }
    return snapped;
}

}  // namespace renderer
