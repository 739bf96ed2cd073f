// SPDX-License-Identifier: MIT
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "renderer/scenes/scenes.h"

namespace renderer {
namespace {

/// Points along an arc of a circle, angles in degrees from +x.
void addArc(std::vector<glm::vec2>& profile, glm::vec2 centre, float radius, float fromDeg,
            float toDeg, int steps) {
    for (int i = 0; i <= steps; ++i) {
        const float angle = glm::radians(fromDeg + (toDeg - fromDeg) * static_cast<float>(i) /
                                                       static_cast<float>(steps));
        profile.push_back(centre + radius * glm::vec2(std::cos(angle), std::sin(angle)));
    }
}

}  // namespace

/// A turned knob whose neck and grooves are hollow, and a bowl: kernels that follow the receiver's
/// plane cut into hollow surfaces and draw rings around them (C. Schüler, "Multisampling extension
/// for gradient shadow maps", Fig. 4.2.5).
Scene knob() {
    Scene scene;
    scene.objects.push_back(paving());
    std::vector<glm::vec2> profile;
    addArc(profile, {0, 1.45F}, 0.62F, 90, -38, 40);       // head
    addArc(profile, {0.81F, 0.84F}, 0.38F, 140, 230, 24);  // hollow neck
    addArc(profile, {0.62F, 0.44F}, 0.12F, 90, 0, 12);     // ring
    addArc(profile, {0.80F, 0.36F}, 0.08F, 180, 270, 12);  // groove
    profile.push_back({1.0F, 0.28F});
    addArc(profile, {1.0F, 0.18F}, 0.1F, 90, 0, 10);
    profile.push_back({1.1F, 0});
    scene.objects.push_back({"knob",
                             lathe({-0.5F, 0, 0}, profile, 120),
                             {.albedo = {0.62F, 0.42F, 0.16F}, .gloss = 0.35F}});
    std::vector<glm::vec2> bowl;
    addArc(bowl, {0, 0.62F}, 0.56F, -90, 0, 24);
    addArc(bowl, {0.59F, 0.62F}, 0.03F, 180, 0, 8);
    addArc(bowl, {0, 0.62F}, 0.62F, 0, -90, 24);
    scene.objects.push_back({"bowl",
                             lathe({1.45F, 0, 0.75F}, bowl, 96),
                             {.albedo = {0.30F, 0.42F, 0.46F}, .gloss = 0.3F}});
    scene.casters = casterBounds(scene.objects);
    scene.camera = {.target = {0.1F, 0.85F, 0.1F},
                    .yawDeg = 18,
                    .pitchDeg = 26,
                    .distanceM = 6.2F,
                    .verticalFieldDeg = 36};
    scene.sun = {.azimuthDeg = 100, .elevationDeg = 48};
    scene.softnessM = 0.04;
    scene.sunPath = {.turnDeg = 360, .elevationSwingDeg = 10};
    return scene;
}

}  // namespace renderer
