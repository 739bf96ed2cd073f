// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/scenes/scenes.h"

namespace renderer {
namespace {

/// Radius of a square of half-width 1 that is turned by `turn`, over the angle.
float squareOutline(float angle, float turn) {
    const float a = angle - turn;
    return 1 / std::max(std::abs(std::cos(a)), std::abs(std::sin(a)));
}

/// A star with `points` tips at radius 1 and notches at `notch`, straight lines in between.
float starOutline(float angle, int points, float notch, float turn) {
    const float sector = glm::two_pi<float>() / static_cast<float>(points);
    float a = std::fmod(angle - turn + 64 * glm::two_pi<float>(), sector);
    if (a > sector / 2) a = sector - a;  // 0 at a tip, sector / 2 at a notch
    const float half = sector / 2;
    return notch * std::sin(half) / (notch * std::sin(half - a) + std::sin(a));
}

/// Angles of a full turn that hit every corner of squares and stars turned by `turn`.
std::vector<float> sweep(float turn, int steps = 360) {
    std::vector<float> angles;
    for (int i = 0; i <= steps; ++i)
        angles.push_back(turn +
                         glm::two_pi<float>() * static_cast<float>(i) / static_cast<float>(steps));
    return angles;
}

}  // namespace

/// One flat plate with a round hole and a star in the hole: straight edges, curves and tips in a
/// single plane.
Scene planarOccluder() {
    Scene scene;
    constexpr float kHeight = 1.5F;
    const float turn = glm::radians(11.0F);
    const auto constant = [](float radius) { return [radius](float) { return radius; }; };
    Mesh plate = flatRing([&](float a) { return 1.6F * squareOutline(a, turn); }, constant(1.15F),
                          sweep(turn));
    plate.append(flatRing([&](float a) { return 0.95F * starOutline(a, 6, 0.45F, turn); },
                          constant(0), sweep(turn)));
    plate = transformed(std::move(plate), glm::translate(glm::mat4(1), glm::vec3(0, kHeight, 0)));

    scene.objects.push_back(paving());
    scene.objects.push_back(
        {"plate", std::move(plate), {.albedo = {0.50F, 0.075F, 0.045F}, .gloss = 0.03F}});
    scene.casters = casterBounds(scene.objects);
    scene.camera = {.target = {-0.7F, 0.75F, 0.0F},
                    .yawDeg = -28,
                    .pitchDeg = 21,
                    .distanceM = 6.9F,
                    .verticalFieldDeg = 38};
    scene.sun = {.azimuthDeg = 62, .elevationDeg = 50};
    scene.softnessM = 0.055;
    return scene;
}

}  // namespace renderer
