// SPDX-License-Identifier: MIT
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/scenes/scenes.h"

namespace renderer {

/// Posts from thin to thick that stand on the ground, a board that leans on one, a bench just over
/// the ground and a beam high over it: an area light's penumbra is nothing at the contact and wide
/// under the beam.
Scene contactPosts() {
    Scene scene;
    scene.objects.push_back(paving());
    const Material wood{.albedo = {0.46F, 0.27F, 0.13F}, .gloss = 0.08F};
    const Material stone{.albedo = {0.58F, 0.55F, 0.50F}, .gloss = 0.05F};

    Mesh posts;
    constexpr float kThickness[] = {0.03F, 0.06F, 0.12F, 0.20F, 0.30F};
    for (int i = 0; i < 5; ++i) {
        const float x = -1.9F + 0.8F * static_cast<float>(i);
        const float half = kThickness[i] / 2;
        const float height = 0.5F + 0.3F * static_cast<float>(i);
        posts.append(box({x - half, 0, -half}, {x + half, height, half}));
    }
    scene.objects.push_back({"posts", std::move(posts), stone});

    // Its lower edge on the ground, its upper one at the tallest post.
    constexpr float kLean = 28;  // degrees from upright
    Mesh board = box({-0.25F, 0, -0.02F}, {0.25F, 1.5F, 0.02F});
    board = transformed(std::move(board),
                        glm::rotate(glm::translate(glm::mat4(1), {1.3F, 0.01F, 0.86F}),
                                    glm::radians(-kLean), {1, 0, 0}));
    scene.objects.push_back({"leaning board", std::move(board), wood});

    Mesh bench = box({-1.5F, 0.16F, 0.75F}, {-0.1F, 0.20F, 1.1F});
    for (const float x : {-1.4F, -0.25F})
        bench.append(box({x, 0, 0.8F}, {x + 0.05F, 0.16F, 1.05F}));
    scene.objects.push_back({"bench", std::move(bench), wood});

    Mesh beam = box({-2.4F, 2.5F, -1.35F}, {2.3F, 2.68F, -1.17F});
    for (const float x : {-2.4F, 2.15F}) beam.append(box({x, 0, -1.32F}, {x + 0.12F, 2.5F, -1.2F}));
    scene.objects.push_back({"beam", std::move(beam), stone});

    scene.casters = casterBounds(scene.objects);
    scene.camera = {.target = {-0.1F, 0.75F, 0.2F},
                    .yawDeg = 22,
                    .pitchDeg = 24,
                    .distanceM = 7.6F,
                    .verticalFieldDeg = 38};
    scene.sun = {.azimuthDeg = 205, .elevationDeg = 46};
    scene.softnessM = 0.05;
    scene.sunPath = {.turnDeg = 90, .elevationSwingDeg = 16};
    return scene;
}

}  // namespace renderer
