// SPDX-License-Identifier: MIT
// Bounds of the pixels that a map serves, against the rule that the lookup goes by.
#include "renderer/served_pixels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/shader_math.h"
#include "tests/renderer/technique_case.h"

namespace {

using renderer::Lamp;
using renderer::LightView;
using renderer::OrbitCamera;
using renderer::PixelRect;
using tests::Random;

constexpr int kWidth = 320, kHeight = 180;
const renderer::Bounds kSurfaces{{-6, 0, -5}, {7, 3, 4}};

struct Camera {
    OrbitCamera orbit;
    glm::dvec3 eye, forward, right, up;
    double pixel;

    explicit Camera(const OrbitCamera& camera)
        : orbit(camera),
          eye(camera.eye()),
          forward(glm::normalize(glm::dvec3(camera.target) - eye)),
          right(glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)))),
          up(glm::cross(right, forward)),
          pixel(2 * std::tan(glm::radians(static_cast<double>(camera.verticalFieldDeg)) / 2) /
                kHeight) {}
};

Camera randomCamera(Random& random) {
    const auto between = [&](double low, double high) {
        return static_cast<float>(random(low, high));
    };
    return Camera({.target = {between(-3, 3), between(0, 2), between(-3, 3)},
                   .yawDeg = between(-180, 180),
                   .pitchDeg = between(2, 80),
                   .distanceM = between(0.5, 20),
                   .verticalFieldDeg = between(15, 90)});
}

Lamp randomLamp(Random& random) {
    const auto place = [&] { return glm::vec3(random(-6, 6), random(0.1, 4), random(-5, 5)); };
    return {.kind = random() < 0.5 ? Lamp::Kind::point : Lamp::Kind::spot,
            .position = place(),
            .target = place(),
            .coneDeg = static_cast<float>(random(5, 140)),
            .softness = static_cast<float>(random(0, 0.05))};
}

/// As serves() of shared/receiver.glsl.
bool served(const LightView& view, const Camera& camera, glm::dvec3 point) {
    const double distance = glm::dot(point - camera.eye, camera.forward);
    const renderer::ViewPart& part = view.window.part;
    if (!(distance >= part.fromM && distance < part.toM)) return false;
    const glm::dvec4 h = view.window.shadowFromWorld * glm::dvec4(point, 1);
    if (view.window.lampAt && !(h.w > 0)) return false;
    const glm::dvec2 uv = glm::dvec2(h) / h.w;
    return glm::all(glm::greaterThanEqual(uv, part.lowUv)) &&
           glm::all(glm::lessThanEqual(uv, part.highUv));
}

/// Adds the points that it looked at to `checked`.
void expectHoldsAllItServes(const LightView& view, const Camera& camera, Random& random,
                            int& checked) {
    const PixelRect rect = servedPixels(view, camera.orbit, kSurfaces, kWidth, kHeight);
    EXPECT_TRUE(rect.empty() || (rect.x >= 0 && rect.y >= 0 && rect.x + rect.width <= kWidth &&
                                 rect.y + rect.height <= kHeight));
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 point(random(-6, 7), random(0, 3), random(-5, 4));
        const glm::dvec3 way = point - camera.eye;
        const double distance = glm::dot(way, camera.forward);
        if (distance < renderer::nearestSeenM(camera.orbit)) continue;
        const double x = 0.5 * kWidth + glm::dot(way, camera.right) / (camera.pixel * distance);
        const double y = 0.5 * kHeight + glm::dot(way, camera.up) / (camera.pixel * distance);
        if (x < 0 || x >= kWidth || y < 0 || y >= kHeight || !served(view, camera, point)) continue;
        ++checked;
        ASSERT_TRUE(x >= rect.x && x < rect.x + rect.width && y >= rect.y &&
                    y < rect.y + rect.height)
            << "(" << x << ", " << y << ") is not in " << rect.x << ", " << rect.y << " + "
            << rect.width << " x " << rect.height;
    }
}

TEST(ServedPixels, HoldWhateverAMapServes) {
    Random random(11);
#ifdef __SANITIZE_ADDRESS__
    constexpr int kRounds = 30;
#else
    constexpr int kRounds = 300;
#endif
    int checked = 0;
    for (int round = 0; round < kRounds; ++round) {
        const Camera camera = randomCamera(random);
        renderer::ConvexBody seen =
            renderer::viewVolume(camera.orbit, static_cast<double>(kWidth) / kHeight,
                                 static_cast<double>(renderer::nearestSeenM(camera.orbit)),
                                 static_cast<double>(renderer::farthestSeenM(camera.orbit)));
        cutToBox(seen, kSurfaces);
        for (LightView view : lampViews(randomLamp(random), 1)) {
            expectHoldsAllItServes(view, camera, random, checked);
            std::optional<int> step;
            narrowLampView(view, {{-2, 0, -2}, {1, 1, 3}}, seen, step);
            expectHoldsAllItServes(view, camera, random, checked);
        }
        LightView cascade;
        cascade.window.part.fromM = random(0, 10);
        cascade.window.part.toM = cascade.window.part.fromM + random(0, 10);
        expectHoldsAllItServes(cascade, camera, random, checked);
    }
    EXPECT_GT(checked, 30 * kRounds);
}

// Before a wall that fills the view a cube's face is for its own share of it, and the face behind
// the lamp for none.
TEST(ServedPixels, AreAFewForAFaceOfACube) {
    const OrbitCamera camera{
        .target = {0, 1, 0}, .pitchDeg = 30, .distanceM = 8, .verticalFieldDeg = 40};
    const Lamp lamp{.kind = Lamp::Kind::point, .position = {0, 1.2F, 0}};
    double area = 0;
    for (const LightView& view : lampViews(lamp, 1)) {
        const PixelRect rect =
            servedPixels(view, camera, {{-4, 0, -4}, {4, 1, 4}}, kWidth, kHeight);
        area += rect.empty() ? 0 : static_cast<double>(rect.width) * rect.height;
    }
    // Six maps over the whole picture would be 6; the faces' bounds overlap.
    EXPECT_LT(area / (kWidth * kHeight), 3.5);
    EXPECT_GT(area / (kWidth * kHeight), 0.9);
    const OrbitCamera away{.target = {0, 1, -20}, .pitchDeg = 2, .distanceM = 10};
    const Lamp spot{.position = {0, 2, 0}, .target = {0, 0, 5}, .coneDeg = 40};
    EXPECT_TRUE(
        servedPixels(lampViews(spot, 1).front(), away, {{-9, 0, -9}, {9, 3, 9}}, kWidth, kHeight)
            .empty())
        << "it shines behind the camera";
}

// No lamp and no cascade: everything that there is.
TEST(ServedPixels, OfTheSunsOneMapAreTheScene) {
    const OrbitCamera camera{.target = {0, 1, 0}, .pitchDeg = 20, .distanceM = 6};
    EXPECT_EQ(servedPixels({}, camera, {{-100, -1, -100}, {100, 50, 100}}, kWidth, kHeight),
              (PixelRect{0, 0, kWidth, kHeight}));
    const PixelRect ground =
        servedPixels({}, camera, {{-100, 0, -100}, {100, 0, 100}}, kWidth, kHeight);
    EXPECT_EQ(ground.width, kWidth);
    EXPECT_EQ(ground.y, 0);
    EXPECT_LT(ground.height, kHeight) << "the sky is none of it";
}

}  // namespace
