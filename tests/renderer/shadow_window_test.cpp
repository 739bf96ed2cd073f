// SPDX-License-Identifier: MIT
#include "renderer/shadow_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/light_views.h"
#include "tests/renderer/technique_case.h"

namespace {

TEST(ShadowWindow, HoldsEveryCasterAtEverySun) {
    for (const renderer::SceneEntry& entry : renderer::builtInScenes()) {
        const renderer::Scene scene = renderer::makeScene(entry.name);
        for (const float elevation : {5.0F, 40.0F, 90.0F})
            for (float azimuth = 0; azimuth < 360; azimuth += 45) {
                const auto window = renderer::fitShadowWindow(
                    scene.casters, {.azimuthDeg = azimuth, .elevationDeg = elevation});
                for (const renderer::SceneObject& object : scene.objects) {
                    if (!object.casts) continue;
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

/// What a camera of a 16:9 picture sees.
renderer::ConvexBody seenBy(const renderer::OrbitCamera& camera) {
    return renderer::viewVolume(camera, 16.0 / 9, 0.02 * static_cast<double>(camera.distanceM),
                                40 * static_cast<double>(camera.distanceM));
}

glm::dvec2 place(const renderer::ShadowWindow& window, glm::vec3 point) {
    return glm::dvec2(window.shadowFromWorld * glm::dvec4(point, 1));
}

TEST(ViewVolume, HasTheEightCornersOfATruncatedPyramid) {
    const renderer::OrbitCamera camera{
        .target = {1, 2, 3}, .yawDeg = 40, .pitchDeg = 25, .distanceM = 7, .verticalFieldDeg = 50};
    const auto corners = renderer::cornersOf(renderer::viewVolume(camera, 1.6, 2, 9));
    ASSERT_EQ(corners.size(), 8U);
    const glm::dvec3 eye(camera.eye());
    const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - eye);
    const double tall = std::tan(glm::radians(25.0));
    for (const glm::dvec3& corner : corners) {
        const double depth = glm::dot(corner - eye, forward);
        EXPECT_TRUE(std::abs(depth - 2) < 1e-9 || std::abs(depth - 9) < 1e-9) << depth;
        EXPECT_NEAR(glm::distance(corner, eye), depth * std::sqrt(1 + tall * tall * (1 + 2.56)),
                    1e-9);
    }
    renderer::ConvexBody empty = renderer::viewVolume(camera, 1.6, 2, 9);
    empty.push_back({0, 1, 0, -100});
    EXPECT_TRUE(renderer::cornersOf(empty).empty()) << "all of it lies under 100 m";
}

/// Cameras that see a part of a scene: on its path, and near to it.
std::vector<renderer::OrbitCamera> camerasOf(const renderer::Scene& scene) {
    std::vector<renderer::OrbitCamera> cameras;
    for (const float nearer : {1.0F, 0.3F, 0.08F})
        for (int i = 0; i < 12; ++i) {
            renderer::OrbitCamera camera = along(scene.cameraPath, scene.camera, i / 12.0);
            camera.distanceM *= nearer;
            cameras.push_back(camera);
        }
    return cameras;
}

TEST(NarrowedWindow, HoldsEveryCasterPointThatIsSeenWithRoomForTheKernel) {
    for (const renderer::SceneEntry& entry : renderer::builtInScenes()) {
        const renderer::Scene scene = renderer::makeScene(entry.name);
        const auto whole = renderer::fitShadowWindow(scene.casters, scene.sun);
        const double reach = 4 * scene.softnessM;
        int narrowed = 0;
        for (const renderer::OrbitCamera& camera : camerasOf(scene)) {
            const renderer::ConvexBody seen = seenBy(camera);
            std::optional<int> step;
            const auto fitted = narrowShadowWindow(whole, scene.casters, seen, reach, step);
            EXPECT_LE(fitted.extentM, whole.extentM);
            EXPECT_EQ(fitted.narrowed, step.has_value());
            EXPECT_EQ(fitted.depthRangeM, whole.depthRangeM) << "depth does not follow the camera";
            if (!fitted.narrowed) continue;
            ++narrowed;
            const double quarters = 4 * std::log2(fitted.extentM);
            EXPECT_NEAR(quarters, std::round(quarters), 1e-9);
            for (const int n : {64, 368, 1024}) {
                const auto window = snapToTexels(fitted, n);
                const double room = reach / window.extentM - 1e-9;
                for (const renderer::SceneObject& object : scene.objects) {
                    if (!object.casts) continue;
                    for (const renderer::Vertex& vertex : object.mesh.vertices) {
                        if (!std::all_of(seen.begin(), seen.end(), [&](const glm::dvec4& plane) {
                                return glm::dot(plane, glm::dvec4(vertex.position, 1)) > 0;
                            }))
                            continue;
                        const glm::dvec2 uv = place(window, vertex.position);
                        ASSERT_TRUE(uv.x > room && uv.x < 1 - room && uv.y > room &&
                                    uv.y < 1 - room)
                            << entry.name << ' ' << object.name << ' ' << uv.x << ' ' << uv.y;
                    }
                }
            }
        }
        EXPECT_GT(narrowed, 5) << entry.name;
    }
}

// A texel grid that is the same wherever the window lies: a world point is at the same place within
// its texel as long as the extent stays.
TEST(NarrowedWindow, KeepsItsTexelGridWhileTheCameraMoves) {
    const renderer::Scene scene = renderer::makeScene("city");
    const auto whole = renderer::fitShadowWindow(scene.casters, scene.sun);
    const glm::vec3 point(3.7F, 1.2F, -8.1F);
    for (const int n : {64, 368, 1024}) {
        std::optional<int> step;
        std::optional<int> lastStep;
        glm::dvec2 lastPhase(0);
        glm::dvec2 lastPlace(0);
        int kept = 0;
        int moved = 0;
        for (int i = 0; i < 400; ++i) {
            renderer::OrbitCamera camera = along(scene.cameraPath, scene.camera, i / 400.0);
            camera.distanceM = 30;
            camera.target = {20 * std::sin(0.05F * static_cast<float>(i)), 3, 0};
            const auto window =
                snapToTexels(narrowShadowWindow(whole, scene.casters, seenBy(camera), 1, step), n);
            ASSERT_TRUE(window.narrowed);
            const glm::dvec2 texels = place(window, point) * static_cast<double>(n);
            const glm::dvec2 phase = texels - glm::floor(texels);
            if (i > 0 && step == lastStep) {
                ++kept;
                moved += glm::distance(texels, lastPlace) > 0.5 ? 1 : 0;
                for (const int k : {0, 1}) {
                    const double change = phase[k] - lastPhase[k];
                    EXPECT_NEAR(change, std::round(change), 1e-6) << i;
                }
            }
            lastStep = step;
            lastPhase = phase;
            lastPlace = texels;
        }
        EXPECT_GT(kept, 370) << "the extent changes a few times on the way";
        EXPECT_GT(moved, 100) << "the window did move";
    }
}

TEST(NarrowedWindow, DoesNotSwitchBackAndForthWhereTheCameraTrembles) {
    const renderer::Scene scene = renderer::makeScene("terrain");
    const auto whole = renderer::fitShadowWindow(scene.casters, scene.sun);
    for (float distance = 8; distance < 20; distance *= 1.03F) {
        std::optional<int> step;
        int changes = 0;
        for (int i = 0; i < 40; ++i) {
            renderer::OrbitCamera camera = scene.camera;
            camera.distanceM = distance * (i % 2 == 0 ? 1.0F : 1.02F);
            const std::optional<int> before = step;
            narrowShadowWindow(whole, scene.casters, seenBy(camera), 0.5, step);
            changes += i > 0 && step != before ? 1 : 0;
        }
        EXPECT_LE(changes, 1) << "around " << distance << " m";
    }
}

TEST(NarrowedWindow, IsTheWholeOneWhereNothingInShadowIsSeen) {
    const renderer::Scene scene = renderer::makeScene("yard");
    const auto whole = renderer::fitShadowWindow(scene.casters, scene.sun);
    std::optional<int> step = 3;
    const renderer::OrbitCamera sky{.target = {0, 500, 0}, .pitchDeg = -80, .distanceM = 10};
    const auto window = narrowShadowWindow(whole, scene.casters, seenBy(sky), 0.1, step);
    EXPECT_FALSE(window.narrowed);
    EXPECT_EQ(window.shadowFromWorld, whole.shadowFromWorld);
    EXPECT_EQ(step, 3) << "a glance at the sky does not let go of the extent";
    EXPECT_EQ(snapToTexels(whole, 100).shadowFromWorld, whole.shadowFromWorld);
}

/// A lamp over a yard, its maps and a camera in it, all at random.
struct LitYard {
    const renderer::Bounds casters{{-2, 0, -1.5F}, {2.5F, 1.2F, 2}};
    const renderer::Bounds surfaces{{-8, 0, -8}, {8, 1.2F, 8}};
    renderer::Lamp lamp;
    renderer::OrbitCamera camera;
    renderer::ConvexBody seen;

    explicit LitYard(tests::Random& random) {
        lamp = {.kind = random() < 0.5 ? renderer::Lamp::Kind::point : renderer::Lamp::Kind::spot,
                .position = glm::vec3(random(-4, 4), random(0.2, 4), random(-4, 4)),
                .target = glm::vec3(random(-1, 1), -0.2, random(-1, 1)),
                .coneDeg = static_cast<float>(random(20, 120)),
                .farM = 12,
                .softness = static_cast<float>(random(0, 0.02))};
        camera = {.target = glm::vec3(random(-4, 4), random(0, 1), random(-4, 4)),
                  .yawDeg = static_cast<float>(random(-180, 180)),
                  .pitchDeg = static_cast<float>(random(5, 80)),
                  .distanceM = static_cast<float>(random(0.2, 6)),
                  .verticalFieldDeg = 40};
        see();
    }
    void see() {
        seen = seenBy(camera);
        cutToBox(seen, surfaces);
    }
    bool sees(const glm::dvec3& point) const {
        return std::all_of(seen.begin(), seen.end(), [&](const glm::dvec4& plane) {
            return glm::dot(plane, glm::dvec4(point, 1)) > 0;
        });
    }
};

glm::dvec3 pointIn(const renderer::Bounds& bounds, tests::Random& random) {
    return glm::mix(glm::dvec3(bounds.low), glm::dvec3(bounds.high),
                    glm::dvec3(random(), random(), random()));
}

glm::dvec2 lampPlace(const renderer::ShadowWindow& window, const glm::dvec3& point) {
    const glm::dvec4 h = window.shadowFromWorld * glm::dvec4(point, 1);
    return glm::dvec2(h) / h.w;
}

// Whatever a caster within its bounds can throw a shadow on, with the casters that a kernel finds
// around it; and a whole map's receivers stay its own.
TEST(NarrowedLampWindow, HoldsEveryShadowThatIsSeenWithRoomForTheKernel) {
    tests::Random random(5);
#ifdef __SANITIZE_ADDRESS__
    constexpr int kRounds = 100;
#else
    constexpr int kRounds = 1000;
#endif
    int narrowed = 0;
    int none = 0;
    int shadowed = 0;
    for (int round = 0; round < kRounds; ++round) {
        const LitYard yard(random);
        for (const renderer::LightView& whole : lampViews(yard.lamp, 1)) {
            std::optional<int> step;
            renderer::LightView view = whole;
            narrowLampView(view, yard.casters, yard.seen, step);
            const bool empty = !(view.window.part.lowUv.x < view.window.part.highUv.x);
            none += empty ? 1 : 0;
            narrowed += view.window.narrowed ? 1 : 0;
            ASSERT_LE(view.window.extentM, whole.window.extentM);
            ASSERT_EQ(view.window.depthRangeM, whole.window.depthRangeM);
            ASSERT_NEAR(view.softnessUv * view.window.extentM,
                        whole.softnessUv * whole.window.extentM, 1e-9);
            const auto window = snapToTexels(view.window, 64);
            const double scale = whole.window.extentM / window.extentM;
            const double room = scale * whole.window.part.lowUv.x - 1e-5;
            for (int i = 0; i < 200; ++i) {
                const glm::dvec3 caster = pointIn(yard.casters, random);
                const glm::dvec3 at(yard.lamp.position);
                const glm::dvec3 receiver = at + random(1, 4) * (caster - at);
                const glm::dvec4 h = whole.window.shadowFromWorld * glm::dvec4(caster, 1);
                if (!(h.z > 0 && h.z < 1) || !yard.sees(receiver)) continue;
                const glm::dvec2 wholeUv = lampPlace(whole.window, receiver);
                if (!(glm::all(glm::greaterThan(wholeUv, whole.window.part.lowUv)) &&
                      glm::all(glm::lessThan(wholeUv, whole.window.part.highUv))))
                    continue;
                ++shadowed;
                ASSERT_FALSE(empty);
                const glm::dvec2 uv = lampPlace(window, receiver);
                ASSERT_TRUE(uv.x > room && uv.y > room && uv.x < 1 - room && uv.y < 1 - room)
                    << uv.x << ' ' << uv.y << " of an extent of " << window.extentM << ", whole "
                    << whole.window.extentM;
                ASSERT_NEAR(uv.x - window.part.lowUv.x,
                            scale * (wholeUv.x - whole.window.part.lowUv.x), 1e-9);
                ASSERT_NEAR(window.part.highUv.y - uv.y,
                            scale * (whole.window.part.highUv.y - wholeUv.y), 1e-9);
            }
        }
    }
    EXPECT_GT(shadowed, 5 * kRounds);
    EXPECT_GT(narrowed, kRounds / 3);
    EXPECT_GT(none, kRounds / 3);
}

TEST(NarrowedLampWindow, KeepsItsTexelGridWhileTheCameraMoves) {
    tests::Random random(6);
    LitYard yard(random);
    yard.lamp = {.position = {1, 4, 2}, .target = {0, 0, 0}, .coneDeg = 70, .farM = 12};
    const auto whole = renderer::lampViews(yard.lamp, 1).front();
    const glm::dvec3 point(0.3, 0.2, -0.4);
    std::optional<int> step;
    std::optional<int> lastStep;
    glm::dvec2 lastPlace(0);
    int kept = 0;
    int moved = 0;
    for (int i = 0; i < 400; ++i) {
        yard.camera = {.target = {0.8F * std::sin(0.05F * static_cast<float>(i)), 0.3F, 0},
                       .yawDeg = static_cast<float>(i) / 4,
                       .pitchDeg = 40,
                       .distanceM = 1,
                       .verticalFieldDeg = 40};
        yard.see();
        const auto window =
            snapToTexels(narrowLampWindow(whole.window, yard.casters, yard.seen, step), 368);
        ASSERT_TRUE(window.narrowed);
        const glm::dvec2 texels = lampPlace(window, point) * 368.0;
        if (i > 0 && step == lastStep) {
            ++kept;
            moved += glm::distance(texels, lastPlace) > 0.5 ? 1 : 0;
            for (const int k : {0, 1})
                EXPECT_NEAR(texels[k] - lastPlace[k], std::round(texels[k] - lastPlace[k]), 1e-6)
                    << i;
        }
        lastStep = step;
        lastPlace = texels;
    }
    EXPECT_GT(kept, 360) << "the extent changes a few times on the way";
    EXPECT_GT(moved, 100) << "the window did move";
}

TEST(NarrowedLampWindow, KeepsItsExtentAtAGlanceAway) {
    tests::Random random(7);
    LitYard yard(random);
    yard.lamp = {.position = {1, 4, 2}, .target = {0, 0, 0}, .coneDeg = 70, .farM = 12};
    yard.camera = {.target = {0, 500, 0}, .pitchDeg = -80, .distanceM = 10};
    yard.see();
    const auto whole = renderer::lampViews(yard.lamp, 1).front();
    std::optional<int> step = -3;
    const auto window = narrowLampWindow(whole.window, yard.casters, yard.seen, step);
    EXPECT_FALSE(window.part.lowUv.x < window.part.highUv.x) << "it serves nothing";
    EXPECT_EQ(window.shadowFromWorld, whole.window.shadowFromWorld);
    EXPECT_EQ(step, -3);
}

}  // namespace
