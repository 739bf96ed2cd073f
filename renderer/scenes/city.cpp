// SPDX-License-Identifier: MIT
#include <random>

#include "renderer/scenes/scenes.h"

namespace renderer {
namespace {

constexpr int kPlots = 6;  // along each side
constexpr float kPlotM = 18;
constexpr float kStoreyM = 3.2F;

/// A block with a parapet and something on its roof.
Mesh tower(glm::vec3 middle, float half, int storeys) {
    const float height = static_cast<float>(storeys) * kStoreyM;
    Mesh mesh = box(middle + glm::vec3(-half, 0, -half), middle + glm::vec3(half, height, half));
    mesh.append(box(middle + glm::vec3(-0.3F * half, height, -0.5F * half),
                    middle + glm::vec3(0.2F * half, height + 2.4F, 0.1F * half)));
    return mesh;
}

/// Slabs on four columns: under the roof every storey is a layer of its own.
Mesh parkingDeck(glm::vec3 middle, float half, int storeys) {
    Mesh mesh;
    for (int storey = 1; storey <= storeys; ++storey) {
        const float top = static_cast<float>(storey) * kStoreyM;
        mesh.append(
            box(middle + glm::vec3(-half, top - 0.4F, -half), middle + glm::vec3(half, top, half)));
        for (const float x : {-0.8F, 0.8F})
            for (const float z : {-0.8F, 0.8F}) {
                const glm::vec3 foot = middle + glm::vec3(x * half, top - kStoreyM, z * half);
                mesh.append(box(foot + glm::vec3(-0.4F, 0, -0.4F),
                                foot + glm::vec3(0.4F, kStoreyM - 0.4F, 0.4F)));
            }
    }
    return mesh;
}

}  // namespace

/// Towers, open decks and bridges between them: many depths along every ray of the light.
Scene city() {
    Scene scene;
    std::mt19937 random(11);
    const auto upTo = [&](unsigned most) { return static_cast<int>(random() % (most + 1)); };
    scene.objects.push_back(paving(400, 64));
    scene.objects.back().material.periodM = kPlotM / 3;
    Mesh towers;
    Mesh decks;
    for (int row = 0; row < kPlots; ++row)
        for (int column = 0; column < kPlots; ++column) {
            const glm::vec3 middle((static_cast<float>(column) - 0.5F * (kPlots - 1)) * kPlotM, 0,
                                   (static_cast<float>(row) - 0.5F * (kPlots - 1)) * kPlotM);
            if ((row * kPlots + column) % 4 == row % 3)
                decks.append(parkingDeck(middle, 6.5F, 2 + upTo(3)));
            else
                towers.append(tower(middle, 4.0F + 0.6F * static_cast<float>(upTo(4)),
                                    2 + upTo(3) + 3 * upTo(2)));
        }
    Mesh bridges;
    for (int i = 0; i < 5; ++i) {
        const float z = (static_cast<float>(i) - 2) * kPlotM + 0.2F * kPlotM;
        const float height = (2.0F + static_cast<float>(upTo(2))) * kStoreyM;
        bridges.append(
            box({-2.4F * kPlotM, height, z - 1.1F}, {2.4F * kPlotM, height + 0.5F, z + 1.1F}));
    }
    scene.objects.push_back(
        {"towers", std::move(towers), {.albedo = {0.52F, 0.44F, 0.36F}, .gloss = 0.05F}});
    scene.objects.push_back(
        {"decks", std::move(decks), {.albedo = {0.50F, 0.50F, 0.48F}, .gloss = 0.03F}});
    scene.objects.push_back(
        {"bridges", std::move(bridges), {.albedo = {0.40F, 0.14F, 0.08F}, .gloss = 0.1F}});
    scene.casters = casterBounds(scene.objects);
    scene.camera = {.target = {0, 4, 0},
                    .yawDeg = 32,
                    .pitchDeg = 30,
                    .distanceM = 165,
                    .verticalFieldDeg = 36};
    scene.cameraPath = {.turnDeg = 360, .pitchSwingDeg = 8};
    scene.sun = {.azimuthDeg = 95, .elevationDeg = 40};
    scene.softnessM = 0.45;
    scene.hazeM = 900;
    return scene;
}

}  // namespace renderer
