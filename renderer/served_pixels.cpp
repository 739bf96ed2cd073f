// SPDX-License-Identifier: MIT
#include "renderer/served_pixels.h"

#include <algorithm>
#include <cmath>

#include "renderer/view_volume.h"

namespace renderer {

PixelRect servedPixels(const LightView& view, const OrbitCamera& camera, const Bounds& surfaces,
                       int widthPx, int heightPx) {
    const ViewPart& part = view.window.part;
    const double aspect = static_cast<double>(widthPx) / heightPx;
    const double fromM = std::max(static_cast<double>(nearestSeenM(camera)), part.fromM);
    const double toM = std::min(static_cast<double>(farthestSeenM(camera)), part.toM);
    if (!(fromM < toM && part.lowUv.x < part.highUv.x && part.lowUv.y < part.highUv.y)) return {};
    ConvexBody body = viewVolume(camera, aspect, fromM, toM);
    cutToBox(body, surfaces);
    if (part.lowUv != kAllReceivers.lowUv) cutToPyramid(body, view.window, part.lowUv, part.highUv);
    const glm::dvec3 eye(camera.eye());
    const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
    const glm::dvec3 up = glm::cross(right, forward);
    const double pixel =
        2 * std::tan(glm::radians(static_cast<double>(camera.verticalFieldDeg)) / 2) / heightPx;
    const glm::dvec2 size(widthPx, heightPx);
    glm::dvec2 low = size;
    glm::dvec2 high(0);
    const std::vector<glm::dvec3> corners = cornersOf(body);
    if (corners.empty()) return {};
    for (const glm::dvec3& corner : corners) {
        const glm::dvec3 way = corner - eye;
        const glm::dvec2 place = 0.5 * size + glm::dvec2(glm::dot(way, right), glm::dot(way, up)) /
                                                  (pixel * glm::dot(way, forward));
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    // One for the pixel that a place lies in, one for rounding.
    const glm::ivec2 first(glm::clamp(glm::floor(low) - 1.0, glm::dvec2(0), size));
    const glm::ivec2 end(glm::clamp(glm::ceil(high) + 1.0, glm::dvec2(0), size));
    if (first.x >= end.x || first.y >= end.y) return {};
    return {first.x, first.y, end.x - first.x, end.y - first.y};
}

}  // namespace renderer
