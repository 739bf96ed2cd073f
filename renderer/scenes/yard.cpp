// SPDX-License-Identifier: MIT
#include "renderer/scenes/fences.h"
#include "renderer/scenes/scenes.h"

namespace renderer {
namespace {

Mesh column(glm::vec3 foot, float radius, float height) {
    Mesh mesh = box(foot + glm::vec3(-1.5F * radius, 0, -1.5F * radius),
                    foot + glm::vec3(1.5F * radius, 0.12F, 1.5F * radius));
    mesh.append(cylinder(foot + glm::vec3(0, 0.12F, 0), radius, height - 0.22F));
    mesh.append(box(foot + glm::vec3(-1.4F * radius, height - 0.10F, -1.4F * radius),
                    foot + glm::vec3(1.4F * radius, height, 1.4F * radius)));
    return mesh;
}

}  // namespace

/// Thin, straight and round casters near the ground and far from it, and shadows that fall on other
/// objects.
Scene yard() {
    Scene scene;
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

}  // namespace renderer
