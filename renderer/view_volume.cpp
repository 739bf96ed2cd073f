// SPDX-License-Identifier: MIT
#include "renderer/view_volume.h"

#include <algorithm>
#include <cmath>

namespace renderer {
namespace {

glm::dvec4 planeThrough(glm::dvec3 point, glm::dvec3 inwards) {
    return {inwards, -glm::dot(inwards, point)};
}

// Corners may lie this far outside by rounding, of the coordinates' size.
constexpr double kTolerance = 1e-9;

}  // namespace

ConvexBody viewVolume(const OrbitCamera& camera, double aspect, double nearM, double farM) {
    const glm::dvec3 eye(camera.eye());
    const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
    const glm::dvec3 up = glm::cross(right, forward);
    const double tall = std::tan(glm::radians(static_cast<double>(camera.verticalFieldDeg)) / 2);
    const double wide = tall * aspect;
    ConvexBody body{planeThrough(eye + nearM * forward, forward),
                    planeThrough(eye + farM * forward, -forward)};
    for (const double side : {-1.0, 1.0}) {
        body.push_back(planeThrough(eye, glm::normalize(wide * forward + side * right)));
        body.push_back(planeThrough(eye, glm::normalize(tall * forward + side * up)));
    }
    return body;
}

void cutToBox(ConvexBody& body, const Bounds& bounds) {
    const glm::dvec3 low(bounds.low);
    const glm::dvec3 high(bounds.high);
    const double slack = 1e-4 * glm::length(high - low) + 1e-6;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 normal(0);
        normal[axis] = 1;
        body.emplace_back(normal, slack - low[axis]);
        body.emplace_back(-normal, slack + high[axis]);
    }
}

std::vector<glm::dvec3> cornersOf(const ConvexBody& body) {
    std::vector<glm::dvec3> corners;
    for (std::size_t i = 0; i < body.size(); ++i)
        for (std::size_t j = i + 1; j < body.size(); ++j)
            for (std::size_t k = j + 1; k < body.size(); ++k) {
                const glm::dvec3 a(body[i]);
                const glm::dvec3 b(body[j]);
                const glm::dvec3 c(body[k]);
                const glm::dvec3 ab = glm::cross(a, b);
                const double volume = glm::dot(ab, c);
                if (std::abs(volume) < 1e-9 * glm::length(a) * glm::length(b) * glm::length(c))
                    continue;  // nearly parallel: other planes bound the body there
                const glm::dvec3 corner = -(body[i].w * glm::cross(b, c) +
                                            body[j].w * glm::cross(c, a) + body[k].w * ab) /
                                          volume;
                const double size = 1 + glm::length(corner);
                if (std::all_of(body.begin(), body.end(), [&](const glm::dvec4& plane) {
                        const glm::dvec3 normal(plane);
                        return glm::dot(normal, corner) + plane.w >=
                               -kTolerance * (glm::length(normal) * size + std::abs(plane.w));
                    }))
                    corners.push_back(corner);
            }
    return corners;
}

}  // namespace renderer
