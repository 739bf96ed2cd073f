// SPDX-License-Identifier: MIT
#include "renderer/scene.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <stdexcept>

namespace renderer {
namespace {

constexpr Material kPaving{.albedo = {0.34F, 0.30F, 0.25F},
                           .pattern = Pattern::tiles,
                           .second = {0.16F, 0.14F, 0.12F},
                           .periodM = 0.8F};

SceneObject paving() {
    return {"ground", groundPlane(64, 64), kPaving};
}

/// Bounds of everything but the ground, down to the ground.
Bounds casterBounds(const std::vector<SceneObject>& objects) {
    Bounds all{glm::vec3(1e9F), glm::vec3(-1e9F)};
    for (const SceneObject& object : objects) {
        if (object.name == "ground") continue;
        const Bounds bounds = boundsOf(object.mesh);
        all.low = glm::min(all.low, bounds.low);
        all.high = glm::max(all.high, bounds.high);
    }
    all.low.y = std::min(all.low.y, 0.0F);
    return all;
}

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

/// One flat plate with a round hole and a star in the hole: straight edges, curves and tips in a
/// single plane.
Scene planarOccluder() {
    Scene scene;
    scene.name = "planar_occluder";
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

Mesh picketFence(glm::vec3 from, glm::vec3 to, float height, float spacing) {
    Mesh mesh;
    const glm::vec3 span = to - from;
    const float length = glm::length(span);
    const int pickets = static_cast<int>(length / spacing);
    constexpr float kWidth = 0.075F;
    constexpr float kThickness = 0.022F;
    for (int i = 0; i <= pickets; ++i) {
        const float x = length * static_cast<float>(i) / static_cast<float>(pickets);
        mesh.append(box({x - kWidth / 2, 0.06F, -kThickness / 2},
                        {x + kWidth / 2, height, kThickness / 2}));
        // A pointed top: a square turned by 45 degrees, its upper half over the picket.
        const float half = kWidth / std::sqrt(8.0F);
        Mesh tip = box({-half, -half, -kThickness / 2}, {half, half, kThickness / 2});
        const glm::mat4 place = glm::rotate(glm::translate(glm::mat4(1), {x, height, 0}),
                                            glm::quarter_pi<float>(), {0, 0, 1});
        mesh.append(transformed(std::move(tip), place));
    }
    for (const float rail : {0.28F, 0.78F})
        mesh.append(box({-kWidth, rail * height, -0.05F},
                        {length + kWidth, rail * height + 0.07F, -kThickness / 2}));
    const float turn = std::atan2(-span.z, span.x);
    return transformed(std::move(mesh),
                       glm::rotate(glm::translate(glm::mat4(1), from), turn, {0, 1, 0}));
}

Mesh column(glm::vec3 foot, float radius, float height) {
    Mesh mesh = box(foot + glm::vec3(-1.5F * radius, 0, -1.5F * radius),
                    foot + glm::vec3(1.5F * radius, 0.12F, 1.5F * radius));
    mesh.append(cylinder(foot + glm::vec3(0, 0.12F, 0), radius, height - 0.22F));
    mesh.append(box(foot + glm::vec3(-1.4F * radius, height - 0.10F, -1.4F * radius),
                    foot + glm::vec3(1.4F * radius, height, 1.4F * radius)));
    return mesh;
}

/// Thin, straight and round casters near the ground and far from it, and shadows that fall on other
/// objects.
Scene yard() {
    Scene scene;
    scene.name = "yard";
    scene.objects.push_back(paving());
    scene.objects.push_back({"fence",
                             picketFence({-2.6F, 0, -2.3F}, {3.0F, 0, -1.0F}, 1.05F, 0.2F),
                             {.albedo = {0.78F, 0.72F, 0.62F}, .gloss = 0.05F}});
    Mesh posts = column({-1.9F, 0, 0.25F}, 0.13F, 1.9F);
    posts.append(column({-0.55F, 0, -0.35F}, 0.13F, 1.45F));
    posts.append(column({2.15F, 0, -0.55F}, 0.13F, 1.7F));
    scene.objects.push_back(
        {"posts", std::move(posts), {.albedo = {0.60F, 0.56F, 0.50F}, .gloss = 0.05F}});
    scene.objects.push_back({"large sphere",
                             sphere({0.85F, 0.5F, 0.15F}, 0.5F),
                             {.albedo = {0.70F, 0.20F, 0.09F}, .gloss = 0.5F}});
    scene.objects.push_back({"banded sphere",
                             sphere({-0.35F, 0.27F, 1.15F}, 0.27F, 64, 32),
                             {.albedo = {0.80F, 0.78F, 0.72F},
                              .gloss = 0.35F,
                              .pattern = Pattern::bands,
                              .second = {0.05F, 0.27F, 0.30F},
                              .periodM = 0.18F}});
    scene.objects.push_back({"small sphere",
                             sphere({2.0F, 0.2F, 0.85F}, 0.2F, 64, 32),
                             {.albedo = {0.80F, 0.52F, 0.10F}, .gloss = 0.4F}});
    scene.objects.push_back({"high sphere",
                             sphere({-0.55F, 1.66F, -0.35F}, 0.21F, 64, 32),
                             {.albedo = {0.10F, 0.32F, 0.36F}, .gloss = 0.5F}});
    scene.casters = casterBounds(scene.objects);
    scene.camera = {.target = {0.1F, 0.72F, -0.1F},
                    .yawDeg = 12,
                    .pitchDeg = 18,
                    .distanceM = 7.4F,
                    .verticalFieldDeg = 34};
    scene.sun = {.azimuthDeg = 138, .elevationDeg = 42};
    scene.softnessM = 0.03;
    return scene;
}

constexpr SceneEntry kScenes[] = {
    {"planar_occluder",
     "a flat plate with a round hole and a star, over a plane: one occluder depth, every edge "
     "direction",
     planarOccluder},
    {"yard",
     "posts, spheres and a picket fence on a ground: thin, round and tall casters, shadows across "
     "objects",
     yard},
};

}  // namespace

glm::vec3 OrbitCamera::eye() const {
    const float yaw = glm::radians(yawDeg);
    const float pitch = glm::radians(pitchDeg);
    return target + distanceM * glm::vec3(std::sin(yaw) * std::cos(pitch), std::sin(pitch),
                                          std::cos(yaw) * std::cos(pitch));
}

glm::vec3 Sun::towards() const {
    const float azimuth = glm::radians(azimuthDeg);
    const float elevation = glm::radians(elevationDeg);
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            std::cos(azimuth) * std::cos(elevation)};
}

std::span<const SceneEntry> builtInScenes() {
    return kScenes;
}

Scene makeScene(std::string_view name) {
    return findScene(name).make();
}

const SceneEntry& findScene(std::string_view name) {
    std::string known;
    for (const SceneEntry& entry : builtInScenes()) {
        if (entry.name == name) return entry;
        known += (known.empty() ? "" : ", ") + std::string(entry.name);
    }
    throw std::invalid_argument("scene \"" + std::string(name) +
                                "\" is not known; known are: " + known);
}

}  // namespace renderer
