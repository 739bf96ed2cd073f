// SPDX-License-Identifier: MIT
// A scene whose shadow is known in closed form: a square plate over a plane.
#pragma once

#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "renderer/renderer.h"

namespace tests {

inline constexpr float kPlateHalfWidth = 1.5F;
inline constexpr float kPlateHeight = 0.8F;

inline glm::mat4 plateTurn(float degrees) {
    return glm::rotate(glm::mat4(1), glm::radians(degrees), glm::vec3(0, 1, 0));
}

/// The plate is turned about the vertical by `turnDeg`; the camera looks down at the shadow's edge.
inline renderer::Scene edgeScene(float turnDeg, const renderer::Sun& sun) {
    renderer::Scene scene;
    scene.name = "edge";
    scene.objects.push_back({"ground", renderer::groundPlane(8, 16), {}});
    const renderer::Mesh plate =
        transformed(renderer::groundPlane(kPlateHalfWidth, 4, kPlateHeight), plateTurn(turnDeg));
    scene.objects.push_back({"plate", plate, {}});
    scene.casters = boundsOf(plate);
    scene.casters.low.y = 0;
    scene.sun = sun;
    scene.camera = {.target = {0, 0, 2.0F},
                    .yawDeg = 0,
                    .pitchDeg = 40,
                    .distanceM = 4,
                    .verticalFieldDeg = 40};
    return scene;
}

/// Where a ground point lies from the shadow's edge that is nearest to the camera.
struct EdgePlace {
    double distanceUv;    ///< from the edge on the map, positive on the lit side
    double alongUv;       ///< along the edge, from its middle
    double halfLengthUv;  ///< half of the edge's length
};

inline EdgePlace placeAtEdge(const renderer::ShadowWindow& window, float turnDeg, glm::dvec2 uv) {
    const auto corner = [&](float x, float z) {
        const glm::vec4 world = plateTurn(turnDeg) * glm::vec4(x * kPlateHalfWidth, kPlateHeight,
                                                               z * kPlateHalfWidth, 1);
        return glm::dvec2(window.shadowFromWorld * glm::dvec4(world));
    };
    const glm::dvec2 from = corner(-1, 1);
    const glm::dvec2 to = corner(1, 1);
    const glm::dvec2 inside = corner(0, 0);
    const glm::dvec2 along = glm::normalize(to - from);
    glm::dvec2 outward(-along.y, along.x);
    if (glm::dot(outward, inside - from) > 0) outward = -outward;
    const glm::dvec2 middle = 0.5 * (from + to);
    return {glm::dot(uv - middle, outward), glm::dot(uv - middle, along),
            0.5 * glm::distance(from, to)};
}

/// The receiver that a pixel shows, in double precision, or nothing for the sky.
struct PixelReceivers {
    renderer::FloatImage positions, planes;
    renderer::f64::ViewConstants view;
    renderer::f64::ShadowConstants shadow;

    explicit PixelReceivers(renderer::Renderer& frame)
        : positions(frame.readPositions()),
          planes(frame.readPlanes()),
          view(renderer::toDouble(frame.viewConstants())),
          shadow(renderer::toDouble(frame.shadowConstants())) {}

    std::optional<renderer::f64::ShadowReceiver> at(int x, int y) const {
        if (positions.at(x, y, 3) == 0) return std::nullopt;
        const auto three = [&](const renderer::FloatImage& image) {
            return glm::dvec3(image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2));
        };
        return shadowReceiver(three(positions), three(planes), view, shadow);
    }
    double heightAt(int x, int y) const {
        return static_cast<double>(positions.at(x, y, 1)) + view.eye.y;
    }
};

}  // namespace tests
