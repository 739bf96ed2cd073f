// SPDX-License-Identifier: MIT
#include "renderer/scenes/scenes.h"

namespace renderer {

/// Spheres at three heights whose shadows lie on top of each other: where one shadow ends inside
/// another, two moments take the gap between the casters for light (J. Gumbau et al., "Improving
/// shadow map filtering with statistical analysis", 2011, Fig. 3).
Scene overlappingSpheres() {
    Scene scene;
    scene.sun = {.azimuthDeg = 118, .elevationDeg = 52};
    const glm::vec3 towards = scene.sun.towards();
    struct Ball {
        glm::vec2 shadow;  // where on the ground its shadow's middle lies
        float height, radius;
        glm::vec3 albedo;
    };
    constexpr Ball kBalls[] = {
        {{0.0F, 0.0F}, 2.7F, 0.80F, {0.62F, 0.16F, 0.08F}},
        {{0.75F, 0.25F}, 1.25F, 0.42F, {0.75F, 0.55F, 0.12F}},
        {{-0.55F, 0.45F}, 0.32F, 0.32F, {0.10F, 0.34F, 0.38F}},
        {{0.35F, -0.75F}, 0.24F, 0.24F, {0.70F, 0.68F, 0.62F}},
        {{-1.65F, -0.55F}, 1.9F, 0.50F, {0.20F, 0.38F, 0.14F}},
        {{-1.75F, 0.05F}, 0.40F, 0.40F, {0.48F, 0.20F, 0.42F}},
    };
    scene.objects.push_back(paving());
    for (const Ball& ball : kBalls)
        scene.objects.push_back({"sphere",
                                 sphere(glm::vec3(ball.shadow.x, 0, ball.shadow.y) +
                                            towards * (ball.height / towards.y),
                                        ball.radius, 72, 36),
                                 {.albedo = ball.albedo, .gloss = 0.4F}});
    scene.camera = {.target = {0.35F, 1.35F, -0.4F},
                    .yawDeg = -24,
                    .pitchDeg = 27,
                    .distanceM = 9.4F,
                    .verticalFieldDeg = 36};
    scene.casters = casterBounds(scene.objects);
    scene.softnessM = 0.06;
    scene.sunPath = {.turnDeg = 70, .elevationSwingDeg = 14};
    return scene;
}

}  // namespace renderer
