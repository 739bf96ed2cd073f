// SPDX-License-Identifier: MIT
// Rays against a straight edge, whose penumbra under a disc is known in closed form.
#include "demo/area_light_truth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "records/whole_file.h"
#include "tests/headless_gl.h"
#include "tests/renderer/edge_scene.h"
#include "tests/renderer/exact_disc.h"
#include "tests/temporary_folder.h"

namespace {

constexpr int kWidth = 120, kHeight = 72;

/// Visibilities against what is expected of them, pixel by pixel.
class Errors {
  public:
    void add(double visibility, double expected) {
        const double error = visibility - expected;
        if (expected <= 0 || expected >= 1) {
            outside_ = std::max(outside_, std::abs(error));
            return;
        }
        squares_ += error * error;
        ++penumbra_;
    }

    /// What the truth says of its own error is right: over 100 pixels and more an estimate of a
    /// standard deviation is off by less than a third, pixels at the ends of the profile are no
    /// Gaussians. Outside the penumbra there is none.
    void expectAsSaid(double standardError) const {
        ASSERT_GT(penumbra_, kWidth);
        const double rms = std::sqrt(squares_ / penumbra_);
        EXPECT_GT(rms, 0.6 * standardError);
        EXPECT_LT(rms, 1.5 * standardError);
        EXPECT_LT(standardError, 0.01);
        EXPECT_LT(outside_, 1e-6);
    }

  private:
    double squares_ = 0, outside_ = 0;
    int penumbra_ = 0;
};

TEST(AreaLightTruth, OfAStraightEdgeIsTheDiscsProfile) {
    constexpr float kTurnDeg = 20;
    const renderer::Sun sun{.azimuthDeg = 180, .elevationDeg = 90};  // overhead: a round penumbra
    renderer::Renderer frame(tests::gl(), tests::edgeScene(kTurnDeg, sun), kWidth, kHeight);
    frame.render({.technique = &renderer::findTechnique("hard"), .resolution = 256});
    const demo::AreaLight light{.angularRadiusDeg = 10, .raysEdge = 12};
    const demo::AreaLightTruth truth = demo::areaLightTruth(frame, light);

    // The penumbra on the ground is as wide as the light is from the plate's height.
    const double radiusM = tests::kPlateHeight * std::tan(10 * std::numbers::pi / 180);
    const double extent = frame.window().extentM;
    const tests::PixelReceivers receivers(frame);
    Errors errors;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const auto receiver = receivers.at(x, y);
            if (!receiver || receivers.heightAt(x, y) > 0.01) continue;
            const auto place =
                tests::placeAtEdge(frame.window(), kTurnDeg, glm::dvec2(receiver->uv));
            if (std::abs(place.alongUv) > place.halfLengthUv - 2 * radiusM / extent) continue;
            errors.add(static_cast<double>(truth.visibility.at(x, y)),
                       tests::discProfile(place.distanceUv * extent / radiusM));
        }
    errors.expectAsSaid(truth.standardError);
}

TEST(AreaLightTruth, OfAStraightEdgeUnderLampsIsKnownToo) {
    constexpr float kTurnDeg = 20;
    renderer::Renderer frame(tests::gl(), tests::edgeScene(kTurnDeg, {}), kWidth, kHeight);
    frame.render({.technique = &renderer::findTechnique("hard"), .resolution = 64});
    // All places are in the plate's own frame, where the edge runs along x at z = kPlateHalfWidth.
    const glm::dvec3 middle(0.2, 4, 1.7);
    constexpr double kRadius = 0.5;
    const glm::dmat3 turn(tests::plateTurn(kTurnDeg));
    const tests::PixelReceivers receivers(frame);

    for (const bool isDisc : {true, false}) {
        demo::Lamp lamp{.position = glm::vec3(turn * middle), .radiusM = kRadius};
        if (isDisc) lamp.facing = glm::vec3(0, -1, 0);
        const demo::AreaLightTruth truth =
            demo::areaLightTruth(frame, {.lamp = lamp, .raysEdge = 12});
        SCOPED_TRACE(isDisc ? "disc" : "ball");
        Errors errors;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                if (!receivers.at(x, y) || receivers.heightAt(x, y) > 0.01) continue;
                glm::dvec3 place;
                for (int i = 0; i < 3; ++i)
                    place[i] = static_cast<double>(receivers.positions.at(x, y, i)) +
                               static_cast<double>(frame.viewConstants().eye[i]);
                place = glm::transpose(turn) * place;
                // Where the ray to the lamp's middle passes the plate's height.
                const double share = tests::kPlateHeight / middle.y;
                const glm::dvec3 passes = (1 - share) * place + share * middle;
                const double room = tests::kPlateHalfWidth - 1.5 * share * kRadius;
                if (std::abs(passes.x) > room || passes.z < 0) continue;
                double cut = (passes.z - tests::kPlateHalfWidth) / (share * kRadius);
                if (!isDisc) {
                    // The cone that touches the ball, cut by the plane through receiver and edge.
                    const double sine = kRadius / glm::distance(middle, place);
                    const glm::dvec3 across = glm::normalize(
                        glm::dvec3(0, place.z - tests::kPlateHalfWidth, tests::kPlateHeight));
                    const double off = glm::dot(across, glm::normalize(middle - place));
                    cut = std::tan(std::asin(off)) / std::tan(std::asin(sine));
                }
                errors.add(static_cast<double>(truth.visibility.at(x, y)), tests::discProfile(cut));
            }
        errors.expectAsSaid(truth.standardError);
    }
}

TEST(AreaLightTruth, IsKeptUnderTheNameOfItsContent) {
    const tests::TemporaryFolder folder;
    renderer::Renderer frame(tests::gl(), tests::edgeScene(20, {}), 16, 9);
    const auto files = [&] {
        return std::distance(std::filesystem::directory_iterator(folder.path()), {});
    };
    const auto ask = [&](const demo::AreaLight& light) {
        frame.render({.resolution = 64});
        return demo::areaLightTruth(frame, light, folder.path());
    };
    const auto first = ask({.angularRadiusDeg = 5, .raysEdge = 2});
    const auto again = ask({.angularRadiusDeg = 5, .raysEdge = 2});
    EXPECT_EQ(files(), 1);
    EXPECT_EQ(again.visibility.values, first.visibility.values);
    EXPECT_EQ(again.standardError, first.standardError);
    ask({.angularRadiusDeg = 5, .raysEdge = 3});
    EXPECT_EQ(files(), 2);
    ask({.angularRadiusDeg = 4, .raysEdge = 2});
    EXPECT_EQ(files(), 3);
    frame.setSun({.azimuthDeg = 10});
    ask({.angularRadiusDeg = 5, .raysEdge = 2});
    EXPECT_EQ(files(), 4);
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        records::writeWholeFile(entry.path(), "torn");
    EXPECT_THROW(ask({.angularRadiusDeg = 5, .raysEdge = 2}), std::runtime_error);
}

TEST(AreaLightTruth, IsThatOfTheSunThatPcssStandsFor) {
    // Of a blocker .25 of 8 m before the receiver the penumbra is as wide as the kernel.
    const double degrees = demo::angularRadiusDeg(0.05, 0.25, 8);
    EXPECT_NEAR(std::tan(degrees * std::numbers::pi / 180) * 0.25 * 8, 0.05, 1e-12);
}

TEST(AreaLightTruth, RefusesLightsOutOfRange) {
    renderer::Renderer frame(tests::gl(), tests::edgeScene(20, {}), 16, 9);
    frame.render({.resolution = 64});
    EXPECT_THROW(demo::areaLightTruth(frame, {.angularRadiusDeg = NAN}), std::invalid_argument);
    EXPECT_THROW(demo::areaLightTruth(frame, {.angularRadiusDeg = 21}), std::invalid_argument);
    EXPECT_THROW(demo::areaLightTruth(frame, {.raysEdge = 0}), std::invalid_argument);
    EXPECT_THROW(demo::areaLightTruth(frame, {.lamp = demo::Lamp{.radiusM = -1}}),
                 std::invalid_argument);
    EXPECT_THROW(demo::areaLightTruth(frame, {.lamp = demo::Lamp{.facing = glm::vec3(0)}}),
                 std::invalid_argument);
}

}  // namespace
