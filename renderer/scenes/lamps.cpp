// SPDX-License-Identifier: MIT
#include "renderer/scenes/scenes.h"

namespace renderer {

/// Dusk: a sun that hardly shines, a point lamp among posts, which throw shadows to all sides, and
/// a spot on a sphere.
Scene lamps() {
    Scene scene;
    scene.objects.push_back(paving());
    Mesh posts;
    for (const glm::vec2 foot :
         {glm::vec2(-1.6F, -0.9F), {-0.2F, -1.3F}, {-1.9F, 0.6F}, {-0.5F, 0.9F}, {0.5F, -0.2F}})
        posts.append(cylinder({foot.x, 0, foot.y}, 0.08F, 0.9F, 32));
    scene.objects.push_back({"posts", std::move(posts), {.albedo = {0.60F, 0.52F, 0.42F}}});
    scene.objects.push_back({"roof",
                             box({-1.35F, 1.7F, -0.5F}, {-0.35F, 1.74F, 0.4F}),
                             {.albedo = {0.50F, 0.18F, 0.10F}}});
    scene.objects.push_back({"sphere",
                             sphere({1.7F, 0.42F, 0.5F}, 0.42F, 72, 36),
                             {.albedo = {0.24F, 0.40F, 0.44F}, .gloss = 0.3F}});
    scene.lamps = {{.kind = Lamp::Kind::point,
                    .position = {-0.85F, 1.05F, -0.1F},
                    .colour = {3.6F, 2.6F, 1.5F},
                    .softness = 0.012F},
                   {.position = {3.0F, 3.2F, 1.6F},
                    .target = {1.6F, 0, 0.3F},
                    .coneDeg = 38,
                    .colour = {14.0F, 16.0F, 20.0F},
                    .softness = 0.006F}};
    scene.casters = casterBounds(scene.objects);
    scene.camera = {.target = {0, 0.6F, 0},
                    .yawDeg = 16,
                    .pitchDeg = 30,
                    .distanceM = 7.2F,
                    .verticalFieldDeg = 38};
    scene.sun = {.azimuthDeg = 230, .elevationDeg = 35, .colour = {0.40F, 0.38F, 0.42F}};
    scene.softnessM = 0.05;
    return scene;
}

}  // namespace renderer
