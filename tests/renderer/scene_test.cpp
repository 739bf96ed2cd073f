// SPDX-License-Identifier: MIT
#include "renderer/scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/shadow_window.h"

namespace {

TEST(Scene, BuiltInScenesAreWholeAndDescribed) {
    for (const renderer::SceneEntry& entry : renderer::builtInScenes()) {
        EXPECT_FALSE(entry.description.empty());
        const renderer::Scene scene = renderer::makeScene(entry.name);
        EXPECT_EQ(scene.name, entry.name);
        EXPECT_GT(scene.softnessM, 0);
        for (const renderer::SceneObject& object : scene.objects) {
            ASSERT_FALSE(object.mesh.indices.empty()) << object.name;
            EXPECT_EQ(object.mesh.indices.size() % 3, 0U);
            for (const auto index : object.mesh.indices)
                ASSERT_LT(index, object.mesh.vertices.size()) << object.name;
            for (const renderer::Vertex& vertex : object.mesh.vertices) {
                ASSERT_TRUE(std::isfinite(glm::length(vertex.position)));
                ASSERT_NEAR(glm::length(vertex.normal), 1, 1e-4) << object.name;
            }
            if (object.name == "ground") continue;
            const renderer::Bounds bounds = boundsOf(object.mesh);
            EXPECT_GE(bounds.low.y, -1e-4) << object.name << " sinks into the ground";
            EXPECT_TRUE(glm::all(glm::lessThanEqual(scene.casters.low, bounds.low)) &&
                        glm::all(glm::greaterThanEqual(scene.casters.high, bounds.high)))
                << object.name;
        }
    }
    EXPECT_THROW(renderer::makeScene("garden"), std::invalid_argument);
}

TEST(ShadowWindow, HoldsEveryCasterAtEverySun) {
    for (const renderer::SceneEntry& entry : renderer::builtInScenes()) {
        const renderer::Scene scene = renderer::makeScene(entry.name);
        for (const float elevation : {5.0F, 40.0F, 90.0F})
            for (float azimuth = 0; azimuth < 360; azimuth += 45) {
                const auto window = renderer::fitShadowWindow(
                    scene.casters, {.azimuthDeg = azimuth, .elevationDeg = elevation});
                for (const renderer::SceneObject& object : scene.objects) {
                    if (object.name == "ground") continue;
                    for (const renderer::Vertex& vertex : object.mesh.vertices) {
                        const glm::dvec4 h =
                            window.shadowFromWorld * glm::dvec4(vertex.position, 1);
                        ASSERT_TRUE(h.x > 0 && h.x < 1 && h.y > 0 && h.y < 1 && h.z > 0 && h.z < 1)
                            << object.name << " " << h.x << " " << h.y << " " << h.z;
                    }
                }
            }
    }
}

TEST(ShadowWindow, IsALengthPreservingMapWithDepthAwayFromTheLight) {
    const auto window =
        renderer::fitShadowWindow({{-1, 0, -2}, {3, 1, 1}}, {.azimuthDeg = 75, .elevationDeg = 33});
    const glm::dmat3 m(window.shadowFromWorld);
    const auto row = [&](int i) { return glm::dvec3(m[0][i], m[1][i], m[2][i]); };
    EXPECT_NEAR(glm::length(row(0)) * window.extentM, 1, 1e-12);
    EXPECT_NEAR(glm::length(row(1)) * window.extentM, 1, 1e-12);
    EXPECT_NEAR(glm::length(row(2)) * window.depthRangeM, 1, 1e-12);
    EXPECT_NEAR(glm::dot(row(0), row(1)), 0, 1e-12);
    EXPECT_NEAR(glm::dot(row(2), glm::dvec3(window.towardsLight)) * window.depthRangeM, -1, 1e-6);
}

TEST(ShadowWindow, RefusesEmptyBoundsAndASunBelowTheHorizon) {
    EXPECT_THROW(renderer::fitShadowWindow({}, {}), std::invalid_argument);
    EXPECT_THROW(renderer::fitShadowWindow({{0, 0, 0}, {NAN, 1, 1}}, {}), std::invalid_argument);
    for (const float elevation : {0.0F, -10.0F, 91.0F, NAN})
        EXPECT_THROW(renderer::fitShadowWindow({{0, 0, 0}, {1, 1, 1}}, {.elevationDeg = elevation}),
                     std::invalid_argument);
}

}  // namespace
