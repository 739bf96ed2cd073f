// SPDX-License-Identifier: MIT
// Frames with several maps: lamps against rays, cascades against one map, maps of their own sizes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "renderer/renderer.h"
#include "tests/headless_gl.h"
#include "tests/renderer/cpu_image.h"
#include "tests/renderer/image_check.h"

namespace {

using renderer::FloatImage;
using renderer::Lamp;
using renderer::Technique;
using testing::HasSubstr;
using tests::gl;

struct Ball {
    glm::vec3 centre;
    float radius;
};
// Around a lamp at (0, 1.2, 0): in the middle of a face of its cube, on an edge between two and at
// a corner.
constexpr Ball kBalls[] = {{{-1.3F, 0.5F, 0.1F}, 0.3F},
                           {{1.1F, 0.6F, 1.1F}, 0.3F},
                           {{0.7F, 0.45F, -0.75F}, 0.25F},
                           {{0.15F, 0.3F, 0.9F}, 0.2F}};

renderer::Scene ballScene(std::vector<Lamp> lamps) {
    renderer::Scene scene;
    scene.name = "balls";
    scene.objects.push_back({"ground", renderer::groundPlane(8, 32), {}, false});
    for (const Ball& ball : kBalls)
        scene.objects.push_back({"ball", renderer::sphere(ball.centre, ball.radius, 128, 64), {}});
    scene.casters = {{-2, 0, -2}, {2, 1, 2}};
    scene.camera = {.pitchDeg = 55, .distanceM = 8, .verticalFieldDeg = 40};
    scene.lamps = std::move(lamps);
    return scene;
}

const Lamp kPoint{.kind = Lamp::Kind::point, .position = {0, 1.2F, 0}, .farM = 12};
const Lamp kSpot{.position = {1.5F, 3, 2}, .target = {0, 0, 0}, .coneDeg = 70, .farM = 12};

/// Whether a ball lies on the way from a point to a lamp.
bool blocked(glm::dvec3 point, glm::dvec3 lamp) {
    for (const Ball& ball : kBalls) {
        const glm::dvec3 way = lamp - point;
        const glm::dvec3 centre(ball.centre);
        const double along =
            std::clamp(glm::dot(centre - point, way) / glm::dot(way, way), 0.0, 1.0);
        const double distance = glm::distance(point + along * way, centre);
        // Points on a ball are not in its own way.
        if (along > 1e-3 && distance < static_cast<double>(ball.radius) - 0.004) return true;
    }
    return false;
}

/// What a pixel shows, or nothing for the sky.
struct Pixels {
    FloatImage positions, planes;
    glm::dvec3 eye;

    explicit Pixels(renderer::Renderer& frame)
        : positions(frame.readPositions()),
          planes(frame.readPlanes()),
          eye(frame.viewConstants().eye) {}
    bool sky(int x, int y) const { return positions.at(x, y, 3) == 0; }
    glm::dvec3 world(int x, int y) const {
        return eye +
               glm::dvec3(positions.at(x, y, 0), positions.at(x, y, 1), positions.at(x, y, 2));
    }
    glm::dvec3 normal(int x, int y) const {
        return {planes.at(x, y, 0), planes.at(x, y, 1), planes.at(x, y, 2)};
    }
};

/// Shares of the pixels whose visibility is on the wrong side of one half, for those that face the
/// lamp clearly and are for it.
struct Wrong {
    int pixels = 0, wrong = 0;
    double share() const { return static_cast<double>(wrong) / pixels; }
};
template <class Counts>
Wrong againstRays(renderer::Renderer& frame, std::size_t light, const Lamp& lamp, Counts counts) {
    const Pixels pixels(frame);
    const FloatImage visibility = frame.readVisibility(light);
    const glm::dvec3 at(lamp.position);
    Wrong result;
    for (int y = 0; y < visibility.height; ++y)
        for (int x = 0; x < visibility.width; ++x) {
            if (pixels.sky(x, y)) continue;
            const glm::dvec3 point = pixels.world(x, y);
            if (glm::dot(pixels.normal(x, y), glm::normalize(at - point)) < 0.1) continue;
            if (!counts(point)) continue;
            ++result.pixels;
            result.wrong += (visibility.at(x, y) < 0.5F) != blocked(point, at) ? 1 : 0;
        }
    return result;
}

/// Within two degrees of an edge of the cube around a lamp.
bool nearSeam(glm::dvec3 point) {
    glm::dvec3 way = glm::abs(point - glm::dvec3(kPoint.position));
    const double largest = std::max({way.x, way.y, way.z});
    const double second =
        std::max({std::min(way.x, way.y), std::min(std::max(way.x, way.y), way.z)});
    return second > 0.93 * largest;
}

// A texel of 512 over 90 degrees is 3 mm wide at 1 m; outlines are a few pixels of each ball.
TEST(LampFrame, PointLampsShadowsAreThoseOfRaysAcrossTheCubesEdgesToo) {
    renderer::Renderer frame(gl(), ballScene({kPoint}), 240, 160);
    frame.render({.technique = &renderer::findTechnique("hard"), .resolution = 512});
    const Wrong all = againstRays(frame, 1, kPoint, [](glm::dvec3) { return true; });
    EXPECT_GT(all.pixels, 15'000);
    EXPECT_LT(all.share(), 0.01);
    const Wrong seams = againstRays(frame, 1, kPoint, nearSeam);
    EXPECT_GT(seams.pixels, 500);
    EXPECT_LT(seams.share(), 0.015);
}

TEST(LampFrame, ASpotsShadowsAreThoseOfRays) {
    renderer::Renderer frame(gl(), ballScene({kSpot}), 240, 160);
    frame.render({.technique = &renderer::findTechnique("hard"), .resolution = 512});
    const glm::dvec3 at(kSpot.position);
    const glm::dvec3 axis = glm::normalize(glm::dvec3(kSpot.target) - at);
    const Wrong cone = againstRays(frame, 1, kSpot, [&](glm::dvec3 point) {
        return glm::dot(glm::normalize(point - at), axis) > std::cos(glm::radians(35.0));
    });
    EXPECT_GT(cone.pixels, 5'000);
    EXPECT_LT(cone.share(), 0.01);
}

// Behind the camera it shines on nothing that is seen.
TEST(LampFrame, AMapThatServesNoPixelIsNeitherDrawnNorFiltered) {
    Lamp away = kSpot;
    away.position = {0, 2, 0};
    away.target = {0, 1, 40};
    renderer::Renderer frame(gl(), ballScene({away}), 96, 64);
    renderer::OrbitCamera camera = frame.scene().camera;
    camera.pitchDeg = 5;
    camera.distanceM = 3;
    camera.target = {0, 0.5F, -3};
    frame.setCamera(camera);
    const renderer::FrameSettings settings{
        .technique = &renderer::findTechnique("vsm"), .resolution = 128, .radiusUv = 0.01F};
    frame.render(settings);
    ASSERT_TRUE(frame.servedPixels()[1].empty());
    const std::size_t drawn = frame.drawnTriangles();
    EXPECT_EQ(frame.readFilteredMap(1).edge, 0);
    for (const float depth : frame.readShadowMap(1).values) ASSERT_EQ(depth, 1);
    for (const float v : frame.readVisibility(1).values) ASSERT_EQ(v, 1);
    frame.setLamps({});
    frame.render(settings);
    EXPECT_EQ(drawn, frame.drawnTriangles()) << "all of them are the sun's";
}

// Soft ones too: half of the light is where the ray's hard edge is. The slack is for techniques
// that leak or widen.
TEST(LampFrame, EveryTechniqueShadowsWithBothKindsOfLamps) {
    std::vector<Lamp> lamps = {kPoint, kSpot};
    renderer::Renderer frame(gl(), ballScene(lamps), 120, 80);
#ifdef __SANITIZE_ADDRESS__
    constexpr std::size_t kStep = 5;  // all of them take minutes there
#else
    constexpr std::size_t kStep = 1;
#endif
    for (std::size_t row = 0; row < renderer::techniques().size(); row += kStep) {
        const Technique& technique = renderer::techniques()[row];
        frame.render({.technique = &technique, .resolution = 192, .radiusUv = 0.01F});
        for (const std::size_t light : {0U, 1U, 2U})
            for (const float v : frame.readVisibility(light).values)
                ASSERT_TRUE(v >= 0 && v <= 1) << technique.name << ' ' << v;
        const Wrong point = againstRays(frame, 1, kPoint, [](glm::dvec3) { return true; });
        EXPECT_LT(point.share(), 0.05) << technique.name;
        const glm::dvec3 at(kSpot.position);
        const glm::dvec3 axis = glm::normalize(glm::dvec3(kSpot.target) - at);
        const Wrong spot = againstRays(frame, 2, kSpot, [&](glm::dvec3 p) {
            return glm::dot(glm::normalize(p - at), axis) > std::cos(glm::radians(33.0));
        });
        EXPECT_LT(spot.share(), 0.05) << technique.name;
    }
}

// Filtered maps among them: each of a cube's faces is held against the pixels that it serves.
TEST(LampFrame, GpuAgreesWithCpuOnLampsMaps) {
    renderer::Renderer frame(gl(), ballScene({kPoint, kSpot}), 96, 64);
#ifdef __SANITIZE_ADDRESS__
    constexpr std::size_t kStep = 5;  // all of them take minutes there
#else
    constexpr std::size_t kStep = 1;
#endif
    constexpr int kN = 128;
    for (std::size_t row = 0; row < renderer::techniques().size(); row += kStep) {
        const Technique& technique = renderer::techniques()[row];
        frame.render({.technique = &technique,
                      .resolution = kN,
                      .radiusUv = 0.01F,
                      .filterOutsidePenumbrae = true});
        for (const std::size_t light : {1U, 2U}) {
            const FloatImage gpu = frame.readVisibility(light);
            double texels = kN;  // of the narrowest of the light's kernels
            for (std::size_t view = 0; view < frame.lightViews().size(); ++view)
                if (frame.lightViews()[view].light == light)
                    texels = std::min(
                        texels, kN * static_cast<double>(frame.shadowConstants(view).kernel.x));
            tests::ImageLimits limits = tests::limitsAgainstCpu(technique, texels);
            // A lamp's depths span little more than its casters: what they are off by counts for
            // more than under the sun, .0086 under vsm.
            limits.most = std::min(1.0, 3 * limits.most);
            tests::expectImagesAgree(
                "lamp_" + std::to_string(light) + "_" + std::string(technique.name), gpu,
                tests::cpuImage(frame, technique, light), limits);
        }
    }
}

// A sun's cascades too: their kernels differ in uv.
TEST(CascadeFrame, GpuAgreesWithCpuOnCascades) {
    renderer::Renderer frame(gl(), renderer::makeScene("city:cascades=3"), 96, 54);
    for (const char* name : {"pcf_disc", "vsm", "esm", "power_cdf"}) {
        const Technique& technique = renderer::findTechnique(name);
        constexpr int kN = 160;
        const float radius = 0.01F;
        frame.render({.technique = &technique,
                      .resolution = kN,
                      .radiusUv = radius,
                      .filterOutsidePenumbrae = true});
        const FloatImage gpu = frame.readVisibility();
        double texels = kN;
        for (std::size_t view = 0; view < 3; ++view)
            texels =
                std::min(texels, kN * static_cast<double>(frame.shadowConstants(view).kernel.x));
        tests::expectImagesAgree(std::string("cascaded_") + name, gpu,
                                 tests::cpuImage(frame, technique),
                                 tests::limitsAgainstCpu(technique, texels));
    }
}

/// A kind of map, and what the two pictures below may differ by: of one pixel about twice the worst
/// one, and the share of pixels beyond their ripple. Single pixels of an exponential at a contact,
/// of a least and a greatest and of a mip level's grid, which another map cuts elsewhere, may be
/// anything; few are.
struct CascadedKind {
    const char* technique;
    double most, share;
};
constexpr CascadedKind kCascadedKinds[] = {{"pcf_disc", 0.32, 0.0005}, {"vsm", 0.2, 0.0005},
                                           {"vsm_sat", 0.37, 0.0005},  {"esm", 1, 0.0006},
                                           {"power_cdf", 1, 0.0125},   {"vsm_mip", 1, 0.0085}};

// The same blur in metres: what differs is the staircases of two grids, each at most 2 a / (pi r).
TEST(CascadeFrame, ShowsTheShadowsOfOneMap) {
    for (const char* name : {"city", "terrain"}) {
        renderer::Renderer frame(gl(), renderer::makeScene(name), 160, 90);
        renderer::OrbitCamera camera = frame.scene().camera;
        camera.distanceM *= 0.3F;
        frame.setCamera(camera);
        const auto softness = static_cast<float>(2 * frame.scene().softnessM);
        for (const CascadedKind& kind : kCascadedKinds) {
            const auto drawn = [&](int cascades) {
                frame.setCascades(cascades);
                frame.render({.technique = &renderer::findTechnique(kind.technique),
                              .resolution = 1200,
                              .radiusUv = softness / static_cast<float>(frame.window().extentM)});
                return frame.readVisibility();
            };
            const FloatImage one = drawn(1);
            const double extentOfOne = frame.window().extentM;
            const FloatImage three = drawn(3);
            const double ripple = 2 * (extentOfOne + frame.lightViews()[2].window.extentM) /
                                  (std::numbers::pi * 1200 * static_cast<double>(softness));
            EXPECT_EQ(frame.lightViews().size(), 3U);
            EXPECT_LT(frame.lightViews()[0].window.extentM, frame.lightViews()[2].window.extentM);
            tests::expectImagesAgree(
                std::string("cascades_") + name + "_" + kind.technique, three, one,
                {.most = kind.most, .often = ripple, .shareBeyondOften = kind.share});
        }
    }
}

/// Both kinds of lamps, from a camera near one of the balls.
renderer::Scene nearBall(std::size_t ball) {
    renderer::Scene scene = ballScene({kPoint, kSpot});
    scene.camera.target = kBalls[ball].centre;
    scene.camera.pitchDeg = 60;
    scene.camera.distanceM = 1.5F;
    scene.camera.verticalFieldDeg = 25;
    return scene;
}

// The same blur in the scene from maps narrowed to what is seen of the shadows and from whole ones:
// what differs is the staircases of two grids, as above.
TEST(LampFrame, NarrowedMapsShowTheShadowsOfWholeOnes) {
    constexpr double kSoftness = 0.02;
    constexpr int kN = 1400;
    for (std::size_t ball = 0; ball < std::size(kBalls); ++ball) {
        renderer::Scene scene = nearBall(ball);
        for (Lamp& lamp : scene.lamps) lamp.softness = static_cast<float>(kSoftness);
        renderer::Renderer frame(gl(), scene, 160, 90);
        for (const char* name : {"pcf_disc", "vsm"}) {
            const auto drawn = [&](renderer::WindowFit fit) {
                frame.setWindowFit(fit);
                frame.render({.technique = &renderer::findTechnique(name),
                              .resolution = kN,
                              .radiusUv = 0.01F});
                return std::array{frame.readVisibility(1), frame.readVisibility(2)};
            };
            const auto whole = drawn(renderer::WindowFit::casters);
            double widest = 0;
            for (const renderer::LightView& view : frame.lightViews())
                if (view.window.lampAt) widest = std::max(widest, view.window.extentM);
            const auto narrowed = drawn(renderer::WindowFit::view);
            const double ripple = 2 * 2 * widest / (std::numbers::pi * kN * kSoftness);
            for (const std::size_t light : {0U, 1U})
                tests::expectImagesAgree(
                    "narrowed_" + std::to_string(ball) + "_" + std::to_string(light) + "_" + name,
                    narrowed[light], whole[light],
                    {.most = 0.2, .often = ripple, .shareBeyondOften = 0.0005});
        }
    }
}

// One ball is seen: its shadow's maps are narrowed to it, and most of the others serve nothing.
TEST(LampFrame, MapsAreNarrowedToTheShadowsThatAreSeen) {
    for (std::size_t ball = 0; ball < std::size(kBalls); ++ball) {
        renderer::Renderer frame(gl(), nearBall(ball), 160, 90);
        const renderer::FrameSettings settings{
            .technique = &renderer::findTechnique("vsm"), .resolution = 256, .radiusUv = 0.01F};
        frame.render(settings);
        std::size_t serving = 0;
        std::size_t narrowed = 0;
        for (std::size_t view = 1; view < frame.lightViews().size(); ++view) {
            if (frame.servedPixels()[view].empty()) continue;
            ++serving;
            const renderer::ShadowWindow& window = frame.lightViews()[view].window;
            narrowed += window.narrowed ? 1 : 0;
        }
        EXPECT_LE(serving, 4U) << "of a cube's six and a spot's at ball " << ball;
        EXPECT_GE(narrowed, 2U) << "at ball " << ball;
    }
}

/// All maps of a frame, and what is seen.
std::vector<std::vector<float>> mapsAndSurfaces(renderer::Renderer& frame,
                                                const renderer::FrameSettings& settings) {
    frame.render(settings);
    std::vector<std::vector<float>> all;
    for (std::size_t view = 0; view < frame.lightViews().size(); ++view)
        all.push_back(frame.readShadowMap(view).values);
    all.push_back(frame.readPositions().values);
    all.push_back(frame.readVisibility(frame.lights() - 1).values);
    return all;
}

// Bit for bit, from the scene's own camera and from within it. Several depths in a texel among
// them.
TEST(LampFrame, TrianglesOutsideAMapAreLeftOutAndChangeNothing) {
    std::vector<renderer::Scene> scenes;
#ifdef __SANITIZE_ADDRESS__
    for (const char* name : {"city", "lamps"}) scenes.push_back(renderer::makeScene(name));
#else
    for (const renderer::SceneEntry& entry : renderer::builtInScenes())
        scenes.push_back(renderer::makeScene(entry.name));
#endif
    scenes.push_back(renderer::makeScene("yard:cascades=3:lamps=2"));
    scenes.push_back(ballScene({kPoint, kSpot}));
    const Technique& vsm = renderer::findTechnique("vsm");
    renderer::ParameterValues sampled = vsm.standardParameters();
    setParameter(vsm, sampled, "map_samples", 4);
    for (renderer::Scene& scene : scenes) {
        renderer::Renderer frame(gl(), scene, 96, 54);
        for (const float nearer : {1.0F, 0.25F}) {
            renderer::OrbitCamera camera = scene.camera;
            camera.distanceM *= nearer;
            frame.setCamera(camera);
            renderer::FrameSettings settings{
                .technique = &vsm, .parameters = sampled, .resolution = 200, .radiusUv = 0.01F};
            const auto spared = mapsAndSurfaces(frame, settings);
            const std::size_t drawn = frame.drawnTriangles();
            settings.drawOutside = true;
            const auto all = mapsAndSurfaces(frame, settings);
            EXPECT_EQ(spared, all) << scene.name << ", camera at " << nearer << " of its distance";
            EXPECT_LE(drawn, frame.drawnTriangles()) << scene.name;
            // The sun's map and the spot's hold all of them, a face of the cube a ball or two.
            if (scene.name == "balls") {
                EXPECT_LT(static_cast<double>(drawn),
                          0.6 * static_cast<double>(frame.drawnTriangles()));
            }
        }
    }
}

TEST(LampFrame, ACasterOnAnEdgeOfTheCubeIsInBothFacesMaps) {
    renderer::Scene scene = ballScene({kPoint});
    // The one that lies on the edge between the first and the fifth face alone.
    scene.objects = {scene.objects.at(2)};
    renderer::Renderer frame(gl(), std::move(scene), 96, 64);
    const auto coveredTexels = [&](std::size_t face) {
        const FloatImage map = frame.readShadowMap(1 + face);
        return std::count_if(map.values.begin(), map.values.end(),
                             [](float depth) { return depth < 1; });
    };
    frame.render({.technique = &renderer::findTechnique("hard"), .resolution = 256});
    EXPECT_GT(coveredTexels(0), 1000);
    EXPECT_NEAR(static_cast<double>(coveredTexels(0)) / static_cast<double>(coveredTexels(4)), 1,
                0.02)
        << "it lies as much in the one as in the other";
    EXPECT_EQ(coveredTexels(1), 0);
    // In the sun's map and two faces' wholly, and in no other.
    EXPECT_GE(frame.drawnTriangles(), 2 * frame.triangles());
    EXPECT_LE(frame.drawnTriangles(), 3 * frame.triangles());
}

TEST(LampFrame, MapsHaveSizesOfTheirOwn) {
    renderer::Renderer frame(gl(), ballScene({kSpot}), 96, 64);
    const Technique* disc = &renderer::findTechnique("pcf_disc");
    const auto drawn = [&](int sun, int lamp) {
        frame.render({.technique = disc,
                      .maps = {{.resolution = sun, .radiusUv = 0.01F},
                               {.resolution = lamp, .radiusUv = 0.02F}}});
        return std::pair{frame.readVisibility(0), frame.readVisibility(1)};
    };
    const auto small = drawn(128, 128);
    const auto large = drawn(300, 300);
    const auto mixed = drawn(128, 300);
    EXPECT_EQ(frame.shadowConstants(0).map.x, 128);
    EXPECT_EQ(frame.shadowConstants(1).map.x, 300);
    EXPECT_EQ(mixed.first.values, small.first.values);
    EXPECT_EQ(mixed.second.values, large.second.values);
    EXPECT_NE(small.second.values, large.second.values);
    try {
        frame.render({.technique = disc, .maps = {{.resolution = 64}}});
        FAIL() << "a map is missing";
    } catch (const std::invalid_argument& error) {
        EXPECT_THAT(error.what(),
                    HasSubstr("maps is 1 long, must be one for each of the frame's 2"));
    }
    try {
        frame.render({.technique = disc, .maps = {{}, {.resolution = 0}}});
        FAIL() << "a map has no texels";
    } catch (const std::invalid_argument& error) {
        EXPECT_THAT(error.what(), HasSubstr("maps[1].resolution is 0, must be in [1, "));
    }
    EXPECT_THROW(frame.setCascades(9), std::invalid_argument);
    EXPECT_THROW(frame.setLamps({Lamp{.nearM = -1}}), std::invalid_argument);
    EXPECT_THROW(frame.setLamps(std::vector<Lamp>(renderer::kMostLamps + 1)),
                 std::invalid_argument);
    frame.setLamps({});
    EXPECT_EQ(frame.lightViews().size(), 1U);
}

}  // namespace
