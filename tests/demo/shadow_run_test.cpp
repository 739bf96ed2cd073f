// SPDX-License-Identifier: MIT
// Renderer and controller together.
#include "demo/shadow_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <random>
#include <set>
#include <sstream>
#include <vector>

#include "demo/edge_ripple.h"
#include "demo/loaded_slope.h"
#include "demo/map_places.h"
#include "demo/thin_detail.h"
#include "renderer/scene.h"
#include "tests/headless_gl.h"
#include "tests/project_folders.h"
#include "tests/thrown_message.h"

namespace {

using demo::ShadowRun;
using testing::HasSubstr;
using tests::gl;
using tests::messageOf;

ShadowRun::Settings settingsAt(double radiusUv, double c) {
    ShadowRun::Settings settings;
    settings.technique = &renderer::findTechnique("pcf_disc");
    settings.parameters = settings.technique->standardParameters();
    settings.radiusUv = radiusUv;
    settings.slope.c = c;
    return settings;
}

TEST(ResolutionOption, IsAutoOrAPositiveWholeNumber) {
    EXPECT_FALSE(demo::parseResolution("auto", "--resolution"));
    EXPECT_EQ(demo::parseResolution("1", "--resolution"), 1);
    EXPECT_EQ(demo::parseResolution("4096", "--resolution"), 4096);
    for (const char* bad : {"0", "-1", "", "12.5", "1024x", " 7", "99999999999", "Auto"})
        EXPECT_EQ(
            messageOf<std::invalid_argument>([&] { demo::parseResolution(bad, "--resolution"); }),
            "--resolution is \"" + std::string(bad) +
                "\", must be auto or a whole number of texels from 1");
}

TEST(Softness, IsTheScenesOrWhatWasAskedFor) {
    renderer::Renderer frame(gl(), renderer::makeScene("yard"), 16, 9);
    const double extent = frame.window().extentM;
    EXPECT_DOUBLE_EQ(demo::chooseSoftness(frame, {}, {}).radiusM, frame.scene().softnessM);
    EXPECT_DOUBLE_EQ(demo::chooseSoftness(frame, 0.1, {}).radiusUv, 0.1 / extent);
    EXPECT_DOUBLE_EQ(demo::chooseSoftness(frame, {}, 0.02).radiusM, 0.02 * extent);
    EXPECT_EQ(demo::chooseSoftness(frame, 0.0, {}).radiusUv, 0);
    for (const double bad : std::vector<double>{NAN, -0.1, 1e9, INFINITY}) {
        EXPECT_THAT(messageOf<std::invalid_argument>([&] { demo::chooseSoftness(frame, bad, {}); }),
                    HasSubstr("radius is "));
        EXPECT_THAT(messageOf<std::invalid_argument>([&] { demo::chooseSoftness(frame, {}, bad); }),
                    HasSubstr("radius is "));
    }
}

// Far more pixels than texels, so that the pixel bound is silent: N is c / r, rounded up by the
// histogram's bin and the levels, at most a factor 2^(1/4) sqrt 2 in all.
TEST(ShadowRun, AutomaticSizeFollowsSlopeAndSoftness) {
    for (const auto& [radius, c] : {std::pair{0.04, 3.47}, {0.02, 3.47}, {0.02, 2.0}}) {
        renderer::Renderer frame(gl(), renderer::makeScene("planar_occluder"), 640, 360);
        ShadowRun run(frame, gl(), settingsAt(radius, c));
        run.settle();
        EXPECT_TRUE(run.chosen().automatic);
        EXPECT_GE(run.chosen().resolution, c / radius * 0.999) << radius;
        EXPECT_LE(run.chosen().resolution, c / radius * 1.72) << radius;
        EXPECT_EQ(run.chosen().minRadiusUv, 0);
        EXPECT_FALSE(run.chosen().reason.empty());
    }
}

// The renderer's shaders and the controller each have the formula, since neither knows the other.
TEST(ShadowRun, RendererAndControllerMeanTheSameFootprint) {
    std::mt19937_64 random(1);
    const auto number = [&] { return static_cast<float>(random() >> 40) * 0x1p-23F - 1; };
    for (int i = 0; i < 1000; ++i) {
        const glm::vec2 x(number(), number());
        const glm::vec2 y =
            i % 2 == 0 ? glm::vec2(number(), number()) : x * number();  // and degenerate ones
        const float expected = resolution_controller::pixelFootprint(
            {.dudx = x.x, .dvdx = x.y, .dudy = y.x, .dvdy = y.y});
        EXPECT_NEAR(renderer::f32::pixelFootprint(x, y), expected,
                    2e-3F * glm::length(glm::vec2(glm::length(x), glm::length(y))));
    }
}

TEST(ShadowRun, PixelsBoundTheSize) {
    renderer::Renderer frame(gl(), renderer::makeScene("planar_occluder"), 64, 36);
    ShadowRun run(frame, gl(), settingsAt(0.004, 3.47));
    run.settle();
    EXPECT_LT(run.chosen().resolution, 400)
        << "a map of c / r = 868 texels has several texels to a pixel";
    EXPECT_GE(run.chosen().resolution, 32);
}

// What the softness says does not matter where nothing is blurred: a texel is to be no larger than
// a pixel. Far more pixels than texels, so that the slope alone would ask for 87.
TEST(ShadowRun, WithoutABlurTexelsAreAsSmallAsPixels) {
    renderer::Renderer frame(gl(), renderer::makeScene("planar_occluder"), 320, 180);
    const auto sizeOf = [&](const char* technique, double radiusUv) {
        ShadowRun::Settings settings = settingsAt(radiusUv, 3.47);
        settings.technique = &renderer::findTechnique(technique);
        settings.parameters = settings.technique->standardParameters();
        ShadowRun run(frame, gl(), settings);
        run.settle();
        return run.chosen().resolution;
    };
    const int hard = sizeOf("hard", 0.04);
    EXPECT_EQ(hard, sizeOf("hard", 0.001));
    EXPECT_EQ(hard, sizeOf("pcf_disc", 0));
    EXPECT_GE(hard, 3 * sizeOf("pcf_disc", 0.04));
}

TEST(ShadowRun, SettlesFromAnyViewAndStays) {
    renderer::Renderer frame(gl(), renderer::makeScene("yard"), 160, 90);
    ShadowRun run(frame, gl(), settingsAt(0.01, 3.47));
    run.settle();
    const int settled = run.chosen().resolution;
    for (int i = 0; i < 20; ++i) {
        run.step();
        EXPECT_EQ(run.chosen().resolution, settled) << i;
    }
}

TEST(ShadowRun, HoldsItsSizeWhereNothingIsInPenumbra) {
    renderer::Scene scene = renderer::makeScene("planar_occluder");
    scene.camera.target = {40, 30, 40};  // the sky
    scene.camera.pitchDeg = -60;
    renderer::Renderer frame(gl(), scene, 64, 36);
    ShadowRun run(frame, gl(), settingsAt(0.01, 3.47));
    run.settle();
    const int held = run.chosen().resolution;
    EXPECT_THAT(run.chosen().reason, HasSubstr("held"));
    run.step();
    EXPECT_EQ(run.chosen().resolution, held);
}

TEST(ShadowRun, FixedSizeIsLeftAlone) {
    renderer::Renderer frame(gl(), renderer::makeScene("yard"), 64, 36);
    ShadowRun::Settings settings = settingsAt(0.01, 3.47);
    settings.resolution = 77;
    ShadowRun run(frame, gl(), settings);
    EXPECT_EQ(run.settle(), 1);
    EXPECT_EQ(run.chosen().resolution, 77);
    EXPECT_FALSE(run.chosen().automatic);
    EXPECT_EQ(frame.readShadowMap().width, 77);
    settings.resolution = 1 << 20;
    EXPECT_THAT(messageOf<std::invalid_argument>([&] { ShadowRun(frame, gl(), settings); }),
                HasSubstr("resolution is 1048576"));
}

// The weights as the controller gives them: neither map alone is shown.
TEST(ShadowRun, FadesFromOneSizeToTheNext) {
    renderer::Renderer frame(gl(), renderer::makeScene("planar_occluder"), 320, 180);
    for (const char* technique : {"pcf_disc", "vsm"}) {
        ShadowRun::Settings settings = settingsAt(0.03, 3.47);
        settings.technique = &renderer::findTechnique(technique);
        settings.parameters = settings.technique->standardParameters();
        settings.sizing.crossFadeFrames = 4;
        ShadowRun run(frame, gl(), settings);
        run.settle();
        settings.radiusUv = 0.012;  // asks for more
        run.change(settings);
        int faded = 0;
        for (int i = 0; i < 8; ++i) {
            run.step();
            const auto shown = frame.readVisibility().values;
            const renderer::FrameSettings mixed = run.frameSettings();
            if (mixed.fadeWeight == 1) continue;
            ++faded;
            renderer::FrameSettings alone = mixed;
            alone.fadeWeight = 1;
            frame.render(alone);
            const auto now = frame.readVisibility().values;
            alone.resolution = mixed.fadeFrom;
            frame.render(alone);
            const auto before = frame.readVisibility().values;
            EXPECT_NE(now, before);
            for (std::size_t p = 0; p < shown.size(); ++p)
                ASSERT_NEAR(shown[p], std::lerp(before[p], now[p], mixed.fadeWeight), 1e-5)
                    << "rounding of the blend";
        }
        // One frame more where the first pixels that are heard ask for less than all of them.
        EXPECT_GE(faded, 4);
        EXPECT_EQ(run.frameSettings().fadeWeight, 1) << "the fade ends";
    }
}

/// Its shadow asks for c / r texels, its width for more.
renderer::Scene wireOverGround(float widthM) {
    renderer::Scene scene = renderer::makeScene("planar_occluder");
    renderer::Mesh wire =
        renderer::box({-1.6F, 1.0F, -widthM / 2}, {1.6F, 1.0F + widthM, widthM / 2});
    scene.objects[1].mesh = renderer::transformed(
        std::move(wire), glm::rotate(glm::mat4(1), glm::radians(25.0F), glm::vec3(0, 1, 0)));
    return scene;
}

/// Share of the wire's shadow on the converged map that a frame shows.
double shadowKept(renderer::Renderer& frame, renderer::FrameSettings settings) {
    const auto darkness = [&] {
        double sum = 0;
        for (const float visibility : frame.readVisibility().values)
            sum += 1 - static_cast<double>(visibility);
        return sum;
    };
    frame.render(settings);
    const double kept = darkness();
    settings.resolution = 8192;
    frame.render(settings);
    return kept / darkness();
}

TEST(ShadowRun, ThinCastersGetTheTexelsTheyTake) {
    const renderer::Scene scene = wireOverGround(0.006F);
    renderer::Renderer frame(gl(), scene, 640, 360);
    ShadowRun::Settings settings = settingsAt(0.02, 3.47);
    ShadowRun run(frame, gl(), settings);
    run.settle();
    const double widthUv = 0.006 / frame.window().extentM;
    EXPECT_GE(run.chosen().detailTexels, 1 / widthUv) << "or the wire is hit here and there";
    EXPECT_GE(run.chosen().resolution, 1 / widthUv);
    EXPECT_LE(run.chosen().resolution, 4096);
    EXPECT_THAT(run.chosen().reason, HasSubstr("thin"));
    EXPECT_NEAR(shadowKept(frame, run.frameSettings()), 1, 0.2) << "two texels to a width";
    // The same without the probe's word.
    settings.sizing.texelsPerCaster = 0;
    run.change(settings);
    run.settle();
    EXPECT_LT(run.chosen().resolution, 0.5 / widthUv);
}

TEST(ShadowRun, NothingThinAsksForNoDetail) {
    renderer::Renderer frame(gl(), renderer::makeScene("planar_occluder"), 640, 360);
    ShadowRun run(frame, gl(), settingsAt(0.02, 3.47));
    run.settle();
    EXPECT_LE(run.chosen().detailTexels, 368) << "the size that the filter asks for";
}

/// As the scene itself has it, at automatic size.
ShadowRun::Settings settledIn(renderer::Renderer& frame, const char* technique) {
    ShadowRun::Settings settings = settingsAt(demo::chooseSoftness(frame, {}, {}).radiusUv, 3.47);
    settings.technique = &renderer::findTechnique(technique);
    settings.parameters = settings.technique->standardParameters();
    return settings;
}

/// The same frame with a fixed map.
renderer::FloatImage visibilityAt(renderer::Renderer& frame, renderer::FrameSettings settings,
                                  int resolution) {
    settings.resolution = resolution;
    settings.minRadiusUv = 0;
    frame.render(settings);
    return frame.readVisibility();
}

// Where posts stand on the ground the radius of PCSS goes to 0, which would ask for the largest map
// (Kreuzer, section 7).
TEST(ShadowRun, ContactsAskForNoLargeMapAndShowNoStairSteps) {
    renderer::Renderer frame(gl(), renderer::makeScene("contact_posts"), 640, 360);
    ShadowRun run(frame, gl(), settledIn(frame, "pcss"));
    run.settle();
    const int size = run.chosen().resolution;
    EXPECT_LE(size, 1024);
    const renderer::FloatImage shown = frame.readVisibility();
    const renderer::FloatImage truth = visibilityAt(frame, run.frameSettings(), 4096);
    const renderer::FloatImage places = demo::mapPlaces(frame);
    const demo::EdgeRipple ripple = demo::summarised(demo::edgeRipples(shown, truth, places, size));
    EXPECT_GT(ripple.contourPixels, 100U);
    EXPECT_LE(ripple.p95, 2 / (std::numbers::pi * 3.47)) << "what the slope leaves of any edge";
}

// A view that is cut to knows nothing of its bars yet.
TEST(ShadowRun, NoBarVanishesThatALargeMapShows) {
    for (const char* scene : {"yard", "foliage"}) {
        renderer::Renderer frame(gl(), renderer::makeScene(scene), 640, 360);
        ShadowRun run(frame, gl(), settledIn(frame, "pcf_disc"));
        for (const bool cut : {false, true}) {
            if (!cut) run.settle();
            if (cut) run.step(nullptr, true);
            // The probe's tiles, one in each frame, and the answers of the last.
            for (int i = 0; cut && i < renderer::DetailProbe::kTiles + 2; ++i) {
                glFinish();
                run.step();
            }
            const renderer::FloatImage shown = frame.readVisibility();
            const renderer::FloatImage large = visibilityAt(frame, run.frameSettings(), 4096);
            const demo::ThinDetail detail = demo::thinDetail(
                shown, large,
                demo::behindThinCasters(frame.readShadowMap(), demo::mapPlaces(frame),
                                        static_cast<double>(run.frameSettings().radiusUv)));
            EXPECT_GT(detail.pixels, 100U) << scene;
            EXPECT_LE(detail.lost, 0.1) << scene << (cut ? " after a cut" : "");
        }
    }
}

TEST(ShadowRun, TimesWholeFramesAndPassesApart) {
    renderer::Renderer frame(gl(), renderer::makeScene("yard"), 64, 36);
    ShadowRun run(frame, gl(), settingsAt(0.01, 3.47));
    run.settle();
    EXPECT_EQ(run.timeWholeFrames(3).count, 3);
    const ShadowRun::PassSpreads passes = run.timePasses(4);
    for (const renderer::Pass pass : renderer::kAllPasses) {
        if (pass == renderer::Pass::prefilter) continue;  // the full disc has none
        const demo::Spread& spread = passes.passes[static_cast<std::size_t>(pass)];
        EXPECT_EQ(spread.count, 4);
        EXPECT_GT(spread.median, 0);
    }
}

TEST(ShadowRun, PictureIsAntialiasedAndLeavesTheFrameAsItWas) {
    renderer::Renderer frame(gl(), renderer::makeScene("yard"), 96, 54);
    ShadowRun run(frame, gl(), settingsAt(0.01, 3.47));
    run.settle();
    const auto before = frame.readVisibility().values;
    const renderer::ByteImage picture = run.picture(2);
    EXPECT_EQ(picture.width, 96);
    EXPECT_EQ(picture.height, 54);
    EXPECT_EQ(frame.widthPx(), 96);
    EXPECT_EQ(frame.readVisibility().values, before);
}

std::int64_t texelsOf(const ShadowRun& run) {
    std::int64_t sum = 0;
    for (const demo::ChosenResolution& map : run.maps())
        sum += std::int64_t{map.resolution} * map.resolution;
    return sum;
}

TEST(SeveralMaps, EachHasItsOwnSizeAndTogetherTheyKeepToTheBudget) {
    renderer::Renderer frame(gl(), renderer::makeScene("lamps"), 160, 90);
    ShadowRun::Settings settings = settingsAt(demo::chooseSoftness(frame, {}, {}).radiusUv, 3.47);
    ShadowRun run(frame, gl(), settings);
    run.settle();
    ASSERT_EQ(run.maps().size(), 8U) << "the sun, six faces of a cube, a spot";
    EXPECT_FALSE(run.budget());
    std::set<int> sizes;
    for (std::size_t map = 0; map < run.maps().size(); ++map) {
        sizes.insert(run.maps()[map].resolution);
        EXPECT_EQ(frame.shadowConstants(map).map.x, static_cast<float>(run.maps()[map].resolution))
            << "what is drawn";
    }
    EXPECT_GE(sizes.size(), 3U);
    for (const std::size_t map : {1U, 7U})
        EXPECT_FLOAT_EQ(frame.shadowConstants(map).kernel.x,
                        static_cast<float>(frame.lightViews()[map].softnessUv))
            << "each lamp keeps its own softness";

    // The point lamp's upper face sees nothing but the roof's underside, which the camera does not.
    const auto unseen = std::ranges::find(run.maps(), 0, &demo::ChosenResolution::need);
    ASSERT_NE(unseen, run.maps().end());
    EXPECT_EQ(unseen->reason, "no penumbra of it in view");
    EXPECT_EQ(unseen->resolution, 256);

    const double worstWithout = std::ranges::max(run.maps(), {}, [](const auto& map) {
                                    return map.artifactRatio;
                                }).artifactRatio;
    settings.budgetTexels = texelsOf(run) / 2;
    run.change(settings);
    for (int i = 0; i < 3; ++i) {
        run.step();
        EXPECT_LE(texelsOf(run), *settings.budgetTexels) << "from the next frame on";
    }
    ASSERT_TRUE(run.budget());
    EXPECT_TRUE(run.budget()->feasible);
    EXPECT_EQ(run.budget()->used, static_cast<std::uint64_t>(texelsOf(run)));
    EXPECT_GT(run.budget()->wanted, static_cast<std::uint64_t>(*settings.budgetTexels));
    double worst = 0;
    for (const demo::ChosenResolution& map : run.maps()) worst = std::max(worst, map.artifactRatio);
    EXPECT_GT(worst, worstWithout);
    // Half the texels for all alike would be sqrt 2; a level of sqrt 2 may come on top.
    EXPECT_LE(worst, 2.001 * std::max(worstWithout, 1.0));

    settings.resolution = 256;
    run.change(settings);
    run.step();
    for (const demo::ChosenResolution& map : run.maps()) EXPECT_EQ(map.resolution, 256);
    EXPECT_FALSE(run.budget());
}

TEST(SeveralMaps, CascadesAreSizedByWhatTheyServe) {
    renderer::Renderer frame(gl(), renderer::makeScene("yard:cascades=3"), 320, 180);
    ShadowRun run(frame, gl(), settingsAt(demo::chooseSoftness(frame, {}, {}).radiusUv, 3.47));
    run.settle();
    ASSERT_EQ(run.maps().size(), 3U);
    for (std::size_t map = 0; map < 3; ++map) {
        const demo::ChosenResolution& chosen = run.maps()[map];
        if (chosen.need == 0) continue;
        // Nobody asks for more than the law, which counts in the cascade's own extent; a bin of
        // 2^(1/4), then a level.
        const double law = 3.47 / static_cast<double>(frame.shadowConstants(map).kernel.x);
        const double asked = std::max(1.19 * law, 1.0 * chosen.detailTexels);
        EXPECT_LE(chosen.need, std::ceil(asked)) << map;
    }
}

double worstRatio(const ShadowRun& run) {
    double worst = 0;
    for (const demo::ChosenResolution& map : run.maps()) worst = std::max(worst, map.artifactRatio);
    return worst;
}

/// Frames with the demand of the one before, on any machine.
void stepFinished(ShadowRun& run, int frames) {
    for (int i = 0; i < frames; ++i) {
        run.step();
        glFinish();
    }
}

// Seen in one view and not in the next: the budget goes by what is in view now, also where it has
// cut the map's size before. Nothing is held from another view: nobody is a level of sqrt 2 worse
// off than where only this one was ever seen.
TEST(SeveralMaps, OneThatWasInViewLeavesItsShareOfABudgetToTheOthers) {
    const renderer::Scene scene = renderer::makeScene("yard:lamps=3:cascades=3");
    renderer::OrbitCamera other = scene.camera;
    other.yawDeg = std::remainder(other.yawDeg + 180.0F, 360.0F);
    other.distanceM *= 0.4F;
    renderer::Renderer frame(gl(), scene, 128, 72), swungFrame(gl(), scene, 128, 72);
    ShadowRun::Settings settings = settledIn(frame, "pcf_disc");
    settings.budgetTexels = 150000;
    ShadowRun run(frame, gl(), settings), swung(swungFrame, gl(), settings);
    stepFinished(run, 100);
    const auto unseen =
        std::ranges::find(run.maps(), "no penumbra of it in view", &demo::ChosenResolution::reason);
    ASSERT_NE(unseen, run.maps().end()) << "or the test could not fail";
    for (const auto& [camera, frames] :
         {std::pair{other, 60}, {scene.camera, 70}, {other, 60}, {scene.camera, 150}}) {
        swungFrame.setCamera(camera);
        stepFinished(swung, frames);
    }
    const auto map = static_cast<std::size_t>(unseen - run.maps().begin());
    EXPECT_EQ(swung.maps()[map].resolution, 64) << "the smallest size";
    EXPECT_LE(worstRatio(swung), 1.01 * worstRatio(run));
}

// Every face of the point lamp but one is in view, and the texels are scarce.
TEST(SeveralMaps, OneOutOfViewAsksForTheSmallestSizeUnderABudget) {
    renderer::Scene scene = renderer::makeScene("lamps");
    renderer::Renderer frame(gl(), scene, 128, 72);
    ShadowRun::Settings settings = settledIn(frame, "pcf_disc");
    ShadowRun run(frame, gl(), settings);
    const auto unseen = [&] {
        const auto found = std::ranges::find(run.maps(), "no penumbra of it in view",
                                             &demo::ChosenResolution::reason);
        return found == run.maps().end() ? 0 : found->resolution;
    };
    run.settle();
    EXPECT_EQ(unseen(), 256) << "without a budget";
    settings.budgetTexels = 400000;
    run.change(settings);
    stepFinished(run, 50);
    EXPECT_EQ(unseen(), 64);
    EXPECT_LE(worstRatio(run), 1.21) << "a level more for each that is in view can be paid";
    settings.budgetTexels.reset();
    run.change(settings);
    stepFinished(run, 2);
    EXPECT_EQ(unseen(), 256) << "at once";
}

TEST(SeveralMaps, OneMapKeepsToABudgetToo) {
    renderer::Renderer frame(gl(), renderer::makeScene("yard"), 160, 90);
    ShadowRun::Settings settings = settingsAt(0.01, 3.47);
    ShadowRun run(frame, gl(), settings);
    run.settle();
    const int free = run.chosen().resolution;
    settings.budgetTexels = std::int64_t{free} * free;
    run.change(settings);
    run.step();
    EXPECT_EQ(run.chosen().resolution, free) << "enough: nothing changes, without any data";
    settings.budgetTexels = std::int64_t{free} * free - 1;
    run.change(settings);
    run.step();
    EXPECT_LT(run.chosen().resolution, free);
    EXPECT_THAT(run.chosen().reason, HasSubstr("budget"));
    EXPECT_GT(run.chosen().minRadiusUv, 0) << "the filter is enlarged instead";
    settings.budgetTexels = 1;
    run.change(settings);
    run.step();
    EXPECT_FALSE(run.budget()->feasible);
    EXPECT_EQ(run.chosen().resolution, 64) << "the smallest of all";
    settings.budgetTexels.reset();
    run.change(settings);
    for (int i = 0; i < 3; ++i) run.step();
    EXPECT_EQ(run.chosen().resolution, free);
    for (const std::int64_t bad : {std::int64_t{0}, std::int64_t{-7}}) {
        settings.budgetTexels = bad;
        EXPECT_EQ(messageOf<std::invalid_argument>([&] { run.change(settings); }),
                  "budget is " + std::to_string(bad) + " texels, must be at least 1");
    }
    run.step();
    EXPECT_EQ(run.chosen().resolution, free);
}

TEST(SeveralMaps, ATraceLeavesTheDecisionsForOneMapAsTheyAre) {
    renderer::Scene sky = renderer::makeScene("planar_occluder");
    sky.camera.target = {40, 30, 40};
    sky.camera.pitchDeg = -60;
    for (const renderer::Scene& scene : {renderer::makeScene("yard"), sky}) {
        renderer::Renderer frame(gl(), scene, 64, 36), recordedFrame(gl(), scene, 64, 36);
        const ShadowRun::Settings settings = settingsAt(0.01, 3.47);
        ShadowRun run(frame, gl(), settings), recorded(recordedFrame, gl(), settings);
        recorded.startTrace(1 << 18);
        for (int i = 0; i < 20; ++i) {
            for (ShadowRun* each : {&run, &recorded}) each->step(nullptr, i == 10);
            glFinish();
            EXPECT_EQ(recorded.chosen().resolution, run.chosen().resolution) << i;
            EXPECT_EQ(recorded.chosen().reason, run.chosen().reason) << i;
        }
        EXPECT_EQ(recorded.trace()->frames(), 20U);
    }
}

TEST(SeveralMaps, AreRecordedAndDecidedAgainTheSame) {
    renderer::Renderer frame(gl(), renderer::makeScene("lamps"), 96, 54);
    ShadowRun::Settings settings = settingsAt(demo::chooseSoftness(frame, {}, {}).radiusUv, 3.47);
    settings.sizing.crossFadeFrames = 4;
    ShadowRun run(frame, gl(), settings);
    run.startTrace(1 << 20);
    run.settle();
    settings.budgetTexels = 1'000'000;
    settings.sizing.percentile = 0.9;
    run.change(settings);
    for (int i = 0; i < 6; ++i) run.step(nullptr, i == 3);
    ASSERT_TRUE(run.trace());
    EXPECT_GE(run.trace()->frames(), 8U);
    EXPECT_EQ(run.trace()->lost(), 0U);
    const auto report = resolution_controller::replay(run.trace()->bytes());
    EXPECT_TRUE(report.same) << report.problem;
    EXPECT_EQ(report.frames, run.trace()->frames());
}

std::string withoutSpace(const std::string& file) {
    std::ifstream in(tests::sourceFolder() / file);
    std::string text;
    for (char letter; in.get(letter);)
        if (std::isspace(static_cast<unsigned char>(letter)) == 0) text += letter;
    return text;
}

TEST(ShadowRun, JoinsControllerAndRendererInTheLinesThatEnginesAreShown) {
    const std::string manual = withoutSpace("docs/engines.md");
    const std::string code = withoutSpace("demo/shadow_run.cpp");
    const std::string open = "##Fivelines```cpp";
    const std::size_t begin = manual.find(open);
    ASSERT_NE(begin, std::string::npos);
    const std::size_t end = manual.find("```", begin + open.size());
    std::istringstream lines(manual.substr(begin + open.size(), end - begin - open.size()));
    int count = 0;
    for (std::string line; std::getline(lines, line, ';'); ++count)
        EXPECT_THAT(code, HasSubstr(line + ";"));
    EXPECT_EQ(count, 5);
    EXPECT_THAT(withoutSpace("README.md"),
                HasSubstr(manual.substr(begin + open.size(), end - begin - open.size())));
}

TEST(LoadedSlope, IsThePublishedOneForTheAudienceAskedFor) {
    const demo::LoadedSlope measured = demo::loadSlope(std::nullopt);
    EXPECT_EQ(measured.slope.c, 3.47);
    EXPECT_THAT(measured.notes, testing::ElementsAre(HasSubstr("other encoding")));
    const demo::LoadedSlope hidden = demo::loadSlope(std::nullopt, {.detection = 0.10});
    EXPECT_NEAR(hidden.slope.c / 3.47, 1.92, 0.005) << "(ln(1 - .6465) / ln(.9))^(1 / 3.5)";
    EXPECT_THAT(hidden.text, HasSubstr("at most 10 % of looks"));
    const demo::LoadedSlope many = demo::loadSlope(std::nullopt, {.people = 0.9});
    EXPECT_THAT(many.notes, testing::Contains(HasSubstr("how observers differ")));
}

}  // namespace
