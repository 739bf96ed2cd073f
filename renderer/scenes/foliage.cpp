// SPDX-License-Identifier: MIT
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "renderer/scenes/fences.h"
#include "renderer/scenes/scenes.h"

namespace renderer {
namespace {

/// In [0,1); the same on every platform, unlike the standard's distributions.
float share(std::mt19937& random) {
    return static_cast<float>(random() >> 8) * 0x1p-24F;
}

float between(std::mt19937& random, float low, float high) {
    return low + (high - low) * share(random);
}

glm::vec3 direction(std::mt19937& random) {
    const float up = between(random, -1, 1);
    const float angle = between(random, 0, glm::two_pi<float>());
    const float level = std::sqrt(1 - up * up);
    return {level * std::cos(angle), up, level * std::sin(angle)};
}

/// Flat pointed leaves, most of them near the surface of an ellipsoid.
Mesh leaves(glm::vec3 centre, glm::vec3 radii, int count, float length, std::mt19937& random) {
    Mesh mesh;
    for (int i = 0; i < count; ++i) {
        const glm::vec3 place =
            centre + radii * direction(random) * std::cbrt(between(random, 0.25F, 1));
        const glm::vec3 along = direction(random);
        const glm::vec3 across = glm::normalize(glm::cross(along, direction(random)));
        const float size = length * between(random, 0.7F, 1.3F);
        const glm::vec3 normal = glm::cross(along, across);
        const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
        for (const glm::vec2 corner : {glm::vec2(-0.5F, 0), {0, -0.22F}, {0.5F, 0}, {0, 0.22F}})
            mesh.vertices.push_back(
                {place + size * (corner.x * along + corner.y * across), normal});
        for (const std::uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(base + k);
    }
    return mesh;
}

/// From a thick end to a thin one.
Mesh branch(glm::vec3 from, glm::vec3 to, float radius) {
    const glm::vec3 span = to - from;
    const float length = glm::length(span);
    const glm::vec3 up = span / length;
    const glm::vec3 side = glm::normalize(
        glm::cross(up, std::abs(up.x) < 0.9F ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1)));
    const glm::mat4 place(glm::vec4(side, 0), glm::vec4(up, 0), glm::vec4(glm::cross(side, up), 0),
                          glm::vec4(from, 1));
    return transformed(lathe({0, 0, 0}, {{0.4F * radius, length}, {radius, 0}}, 10), place);
}

}  // namespace

/// A wire fence, a tree and a hedge of single leaves: casters that a coarse map loses (F. Kreuzer,
/// "Using perception-based filtering to hide shadow artifacts", Fig. 6). Leaves are triangles, not
/// textures.
Scene foliage() {
    Scene scene;
    std::mt19937 random(2);
    scene.objects.push_back(paving());
    scene.objects.push_back({"wire fence",
                             wireFence({-2.9F, 0, 0.9F}, {0.7F, 0, 1.3F}, 1.1F, 0.11F, 0.008F),
                             {.albedo = {0.42F, 0.44F, 0.46F}, .gloss = 0.3F}});
    const glm::vec3 foot(1.5F, 0, -0.6F);
    const glm::vec3 crown = foot + glm::vec3(0, 2.1F, 0);
    Mesh wood = branch(foot, crown + glm::vec3(0, 0.5F, 0), 0.11F);
    for (int i = 0; i < 14; ++i) {
        const float height = between(random, 1.3F, 2.3F);
        const float angle = between(random, 0, glm::two_pi<float>());
        const glm::vec3 start = foot + glm::vec3(0, height, 0);
        wood.append(branch(start,
                           start + between(random, 0.6F, 0.95F) *
                                       glm::vec3(std::cos(angle), 0.6F, std::sin(angle)),
                           0.035F));
    }
    scene.objects.push_back({"wood", std::move(wood), {.albedo = {0.26F, 0.17F, 0.10F}}});
    scene.objects.push_back({"tree",
                             leaves(crown, {1.15F, 0.95F, 1.15F}, 2600, 0.13F, random),
                             {.albedo = {0.16F, 0.30F, 0.06F}, .gloss = 0.15F}});
    scene.objects.push_back(
        {"hedge",
         leaves({-1.4F, 0.34F, -1.5F}, {1.3F, 0.26F, 0.35F}, 1400, 0.09F, random),
         {.albedo = {0.20F, 0.27F, 0.05F}, .gloss = 0.1F}});
    scene.casters = casterBounds(scene.objects);
    scene.camera = {.target = {-0.3F, 1.0F, 0.3F},
                    .yawDeg = -14,
                    .pitchDeg = 20,
                    .distanceM = 8.4F,
                    .verticalFieldDeg = 38};
    scene.sun = {.azimuthDeg = 148, .elevationDeg = 47};
    scene.softnessM = 0.025;
    scene.sunPath = {.turnDeg = 60, .elevationSwingDeg = 12};
    return scene;
}

}  // namespace renderer
