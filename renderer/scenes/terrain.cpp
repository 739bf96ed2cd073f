// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <random>

#include "renderer/scenes/scenes.h"

namespace renderer {
namespace {

constexpr float kHalfExtentM = 90;

/// Ridges of several wavelengths that end in a plain at the border.
float heightAt(float x, float z) {
    const float edge = std::max(std::abs(x), std::abs(z)) / kHalfExtentM;
    const float fade = std::clamp((1 - edge) / 0.35F, 0.0F, 1.0F);
    const float hills = 3.2F + 2.6F * std::sin(0.071F * x + 0.043F * z) +
                        1.7F * std::sin(0.052F * x - 0.117F * z + 1.1F) +
                        0.55F * std::sin(0.213F * x + 0.171F * z + 0.4F);
    constexpr float kLeast = 0.4F;  // clear of the plain
    return std::max(hills, kLeast) * fade * fade * (3 - 2 * fade);
}

}  // namespace

/// Hills in the last sun, with stones and poles on them: every receiver is a caster, and the light
/// grazes them all.
Scene terrain() {
    Scene scene;
    scene.objects.push_back(paving(600, 64));
    scene.objects.back().material = {.albedo = {0.23F, 0.21F, 0.13F}};
    scene.objects.push_back(
        {"hills", heightField(kHalfExtentM, 144, heightAt), {.albedo = {0.25F, 0.25F, 0.12F}}});
    std::mt19937 random(5);
    const auto place = [&](float spread) {
        const auto share = [&] { return static_cast<float>(random() >> 8) * 0x1p-24F; };
        const float x = spread * (2 * share() - 1);
        const float z = spread * (2 * share() - 1);
        return glm::vec3(x, heightAt(x, z), z);
    };
    Mesh stones;
    for (int i = 0; i < 40; ++i) {
        const float radius = 0.5F + 0.04F * static_cast<float>(i);
        glm::vec3 centre = place(65);  // a third in the ground
        centre.y = std::max(centre.y + 0.3F * radius, radius);
        stones.append(sphere(centre, radius, 16, 8));
    }
    Mesh poles;
    for (int i = 0; i < 30; ++i) poles.append(cylinder(place(65), 0.16F, 4.5F, 8));
    scene.objects.push_back({"stones", std::move(stones), {.albedo = {0.42F, 0.39F, 0.35F}}});
    scene.objects.push_back({"poles", std::move(poles), {.albedo = {0.50F, 0.38F, 0.24F}}});
    scene.casters = casterBounds(scene.objects);
    scene.camera = {.target = {0, 4, 0},
                    .yawDeg = -35,
                    .pitchDeg = 17,
                    .distanceM = 105,
                    .verticalFieldDeg = 34};
    scene.cameraPath = {.turnDeg = 360, .pitchSwingDeg = 6, .distanceSwing = 0.2F};
    scene.sun = {.azimuthDeg = 64, .elevationDeg = 9};
    scene.sunPath = {.turnDeg = 40, .elevationSwingDeg = 5};
    scene.softnessM = 0.4;
    scene.hazeM = 900;
    return scene;
}

}  // namespace renderer
