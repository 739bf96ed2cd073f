// SPDX-License-Identifier: MIT
#include "renderer/light_views.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace {

using renderer::Lamp;
using renderer::LightView;
using testing::HasSubstr;

glm::dvec3 direction(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

/// As shared/receiver.glsl has it.
bool serves(const LightView& view, glm::dvec3 point) {
    const glm::dvec4 h = view.window.shadowFromWorld * glm::dvec4(point, 1);
    if (!(h.w > 0)) return false;
    const glm::dvec2 uv = glm::dvec2(h) / h.w;
    const renderer::ViewPart& part = view.window.part;
    return glm::all(glm::greaterThanEqual(uv, part.lowUv)) &&
           glm::all(glm::lessThanEqual(uv, part.highUv));
}

TEST(LampViews, FacesOfACubeServeEveryDirectionOnce) {
    const Lamp lamp{.kind = Lamp::Kind::point, .position = {1, 2, 3}, .softness = 0.02F};
    const auto faces = lampViews(lamp, 4);
    ASSERT_EQ(faces.size(), 6U);
    std::mt19937 random(1);
    int twice = 0;
    for (int i = 0; i < 20'000; ++i) {
        const glm::dvec3 point = glm::dvec3(lamp.position) + 3.0 * direction(random);
        int served = 0;
        for (const LightView& face : faces) served += serves(face, point) ? 1 : 0;
        ASSERT_GE(served, 1);
        twice += served > 1 ? 1 : 0;
    }
    EXPECT_LT(twice, 20) << "but for rounding at the edges";
    for (const glm::dvec3& corner :
         {glm::dvec3(1, 1, 1), {-1, 1, 1}, {1, -1, 0}, {0, 1, -1}, {-1, -1, -1}}) {
        int served = 0;
        for (const LightView& face : faces)
            served += serves(face, glm::dvec3(lamp.position) + corner) ? 1 : 0;
        EXPECT_GE(served, 2) << "an edge belongs to its faces";
    }
    for (const LightView& face : faces) {
        EXPECT_EQ(face.light, 4U);
        // The kernel finds what lies beyond the edge on the same map.
        EXPECT_GE(face.window.part.lowUv.x, 0.99 * renderer::kReachOfSoftness * face.softnessUv);
        EXPECT_GE(1 - face.window.part.highUv.y,
                  0.99 * renderer::kReachOfSoftness * face.softnessUv);
    }
}

TEST(LampViews, DepthIsLinearAlongTheAxisAndUvAProjection) {
    const Lamp lamp{.position = {0.5F, 4, -1},
                    .target = {2, 0, 1},
                    .coneDeg = 50,
                    .nearM = 0.25F,
                    .farM = 9,
                    .softness = 0};
    const LightView view = lampViews(lamp, 1).front();
    const glm::dvec3 at(lamp.position);
    const glm::dvec3 axis = glm::normalize(glm::dvec3(lamp.target) - at);
    std::mt19937 random(2);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 point = at + 5.0 * direction(random);
        const glm::dvec4 h = view.window.shadowFromWorld * glm::dvec4(point, 1);
        const double along = glm::dot(point - at, axis);
        EXPECT_NEAR(h.w, along, 1e-9);
        EXPECT_NEAR(h.z, (along - 0.25) / 8.75, 1e-9);
        if (along < 0.1) continue;
        const double off = glm::length(point - at - along * axis) / along;
        const double offUv = glm::length(glm::dvec2(h) / h.w - 0.5) * view.window.extentM;
        EXPECT_NEAR(off, offUv, 1e-9 * (1 + off));
        if (off < 0.999 * std::tan(glm::radians(25.0))) {
            EXPECT_TRUE(serves(view, point)) << "the cone lies in the square";
        }
    }
}

// Whatever a face can hold of the casters keeps its place between the planes, with no more between
// them than there is; and all faces count depth alike.
TEST(LampViews, DepthsAreFittedToTheCasters) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(0, 1);
    const renderer::Bounds casters{{-1, 0, -2}, {2, 1, 1}};
    const renderer::Bounds surfaces{{-50, -0.01F, -50}, {50, 1, 50}};
    const auto within = [&](int axis) {
        return std::lerp(static_cast<double>(casters.low[axis]),
                         static_cast<double>(casters.high[axis]), any(random));
    };
    for (const glm::vec3 at : {glm::vec3(0, 0.5F, 0), {0, 3, 0}, {6, 2, 5}}) {
        const Lamp lamp{.kind = Lamp::Kind::point, .position = at};
        std::vector<LightView> faces = lampViews(lamp, 1);
        for (LightView& face : faces) fitLampDepth(face.window, casters, surfaces);
        for (const LightView& face : faces) {
            EXPECT_EQ(face.window.nearM, faces.front().window.nearM);
            EXPECT_EQ(face.window.depthRangeM, faces.front().window.depthRangeM);
            EXPECT_GE(face.window.nearM, static_cast<double>(lamp.nearM));
            EXPECT_LT(face.window.depthRangeM, 13);
            for (int i = 0; i < 2000; ++i) {
                const glm::dvec3 point(within(0), within(1), within(2));
                const glm::dvec4 h = face.window.shadowFromWorld * glm::dvec4(point, 1);
                const glm::dvec2 uv = glm::dvec2(h) / h.w;
                if (h.w < static_cast<double>(lamp.nearM) ||
                    glm::any(glm::greaterThan(glm::abs(uv - 0.5), glm::dvec2(0.5))))
                    continue;
                EXPECT_GE(h.z, 0);
                EXPECT_LE(h.z, 0.85);
                EXPECT_NEAR(h.z * face.window.depthRangeM + face.window.nearM, h.w, 1e-9);
            }
        }
    }
    const Lamp near{.position = {0, 3, 0}, .farM = 1.5F};  // reaches none of them
    LightView view = lampViews(near, 1).front();
    fitLampDepth(view.window, casters, surfaces);
    EXPECT_EQ(view.window.nearM + view.window.depthRangeM, 1.5);
}

TEST(LampViews, RefusesLampsThatCannotBeDrawn) {
    EXPECT_EQ(renderer::validate(Lamp{}), "");
    EXPECT_THAT(renderer::validate(Lamp{.coneDeg = 0}), HasSubstr("coneDeg is 0"));
    EXPECT_THAT(renderer::validate(Lamp{.coneDeg = 151}), HasSubstr("must be in (0, 150]"));
    EXPECT_THAT(renderer::validate(Lamp{.position = {0, 3, 0}, .target = {0, 3, 0}}),
                HasSubstr("target"));
    EXPECT_THAT(renderer::validate(Lamp{.nearM = 0}), HasSubstr("nearM"));
    EXPECT_THAT(renderer::validate(Lamp{.nearM = 2, .farM = 2}), HasSubstr("farM"));
    EXPECT_THAT(renderer::validate(Lamp{.position = {0, NAN, 0}}), HasSubstr("position"));
    EXPECT_THAT(renderer::validate(Lamp{.softness = -1}), HasSubstr("softness"));
    EXPECT_THROW(lampViews(Lamp{.farM = std::numeric_limits<float>::infinity()}, 1),
                 std::invalid_argument);
}

TEST(CascadeSplits, LieHalfwayBetweenEqualStepsAndEqualRatios) {
    const auto splits = renderer::cascadeSplits(1, 100, 4);
    ASSERT_EQ(splits.size(), 5U);
    EXPECT_NEAR(splits.front(), 1, 1e-12);
    EXPECT_NEAR(splits.back(), 100, 1e-9);
    EXPECT_NEAR(splits[2], 0.5 * (50.5 + 10), 1e-9);
    for (std::size_t i = 1; i < splits.size(); ++i) EXPECT_GT(splits[i], splits[i - 1]);
}

// What is seen at a distance lies in the window of that distance's cascade, and near cascades are
// finer.
TEST(Cascades, ServeEveryDistanceAndHoldWhatTheyServe) {
    for (const char* name : {"city", "terrain"}) {
        const renderer::Scene scene = renderer::makeScene(name);
        renderer::OrbitCamera camera = scene.camera;
        camera.pitchDeg = 6;
        camera.distanceM = 40;
        const auto whole = renderer::fitShadowWindow(scene.casters, scene.sun);
        std::vector<std::optional<int>> held;
        const auto views = sunViews(whole, scene.casters, camera, 1.6, 4, 1, held);
        ASSERT_EQ(views.size(), 4U);
        EXPECT_LT(views.front().window.extentM, 0.5 * views.back().window.extentM) << name;
        EXPECT_LT(views.front().window.part.fromM, 0);
        EXPECT_GT(views.back().window.part.toM, 1e20);
        for (std::size_t i = 0; i < views.size(); ++i) {
            EXPECT_EQ(views[i].window.depthRangeM, whole.depthRangeM) << "one bias for all";
            if (i > 0) {
                EXPECT_EQ(views[i].window.part.fromM, views[i - 1].window.part.toM);
            }
        }
        const glm::dvec3 eye(camera.eye());
        const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - eye);
        const auto seen = renderer::viewVolume(camera, 1.6, renderer::nearestSeenM(camera),
                                               renderer::farthestSeenM(camera));
        int checked = 0;
        for (const renderer::SceneObject& object : scene.objects) {
            if (!object.casts) continue;
            for (const renderer::Vertex& vertex : object.mesh.vertices) {
                const glm::dvec4 point(vertex.position, 1);
                bool visible = true;
                for (const glm::dvec4& plane : seen) visible &= glm::dot(plane, point) > 0;
                if (!visible) continue;
                const double distance = glm::dot(glm::dvec3(point) - eye, forward);
                int served = 0;
                for (const LightView& view : views) {
                    const renderer::ViewPart& part = view.window.part;
                    if (!(distance >= part.fromM && distance < part.toM)) continue;
                    ++served;
                    const glm::dvec2 uv(view.window.shadowFromWorld * point);
                    ASSERT_TRUE(uv.x > 0 && uv.x < 1 && uv.y > 0 && uv.y < 1)
                        << name << ' ' << object.name << ' ' << distance;
                }
                ASSERT_EQ(served, 1);
                ++checked;
            }
        }
        EXPECT_GT(checked, 100) << name;
    }
}

}  // namespace
