// SPDX-License-Identifier: MIT
// What a frame and its settings add to the law: cuts, fades, contrast, detail, texel constants.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <stdexcept>

#include "resolution_controller/resolution_controller.h"

namespace {

namespace rc = resolution_controller;
using rc::Reason;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

double radiusFor(double need) {
    return rc::Slope{}.c / need;
}

TEST(CameraCut, FollowsTheFirstDataOfTheNewViewAtOnce) {
    rc::ResolutionController controller({.crossFadeFrames = 8});
    controller.update(radiusFor(2000));
    const rc::Decision lowered = controller.update(radiusFor(300), {.cameraCut = true});
    EXPECT_EQ(lowered.size, 368);
    EXPECT_EQ(lowered.fadeWeight, 1) << "nothing to fade from: the picture is another one";
    EXPECT_EQ(controller.update(radiusFor(50)).size, 368) << "one cut, one jump";
}

TEST(CameraCut, DoesNotBelieveDataOfTheOldView) {
    rc::ResolutionController controller({});
    controller.update(radiusFor(2000));
    // A read-back that takes two frames: the data of the cut frame and the next are old.
    const rc::Decision cut =
        controller.update(radiusFor(4000), {.cameraCut = true, .dataAgeFrames = 2});
    EXPECT_EQ(cut.reason, Reason::heldOldView);
    EXPECT_EQ(cut.size, 2048);
    EXPECT_EQ(controller.update(radiusFor(4000), {.dataAgeFrames = 2}).reason, Reason::heldOldView);
    const rc::Decision first = controller.update(radiusFor(100), {.dataAgeFrames = 2});
    EXPECT_EQ(first.size, 128);
    EXPECT_EQ(first.reason, Reason::demandMet);
}

TEST(CameraCut, WaitsThroughFramesWithoutData) {
    rc::ResolutionController controller({});
    controller.update(radiusFor(2000));
    controller.hold({.cameraCut = true});
    controller.update(kNan);
    EXPECT_EQ(controller.update(rc::DemandHistogram{}).size, 2048);
    EXPECT_EQ(controller.update(radiusFor(100)).size, 128);
}

TEST(CrossFade, RisesInEqualStepsAndEnds) {
    rc::ResolutionController controller({.crossFadeFrames = 4});
    controller.update(radiusFor(500));
    for (int frame = 1; frame <= 8; ++frame) {
        // Frames without data count, too: the fade is seen, whatever is known.
        const rc::Decision d = frame % 2 ? controller.update(radiusFor(2000)) : controller.hold();
        EXPECT_EQ(d.size, 2048);
        EXPECT_DOUBLE_EQ(d.fadeWeight, std::min(1.0, frame / 5.0));
        EXPECT_EQ(d.fadeFromSize, frame < 5 ? 512 : 2048);
    }
}

// A size that leaves 1 % above it enlarges their filters; so that they do not jump when the size
// rises, the enlargement goes with the fade.
TEST(CrossFade, TakesTheLeastRadiusAlong) {
    rc::DemandHistogram few, many;  // of points that ask for 1000
    few.add(350, 990);
    few.add(1000, 10);
    many.add(350, 900);
    many.add(1000, 100);
    for (const bool raised : {true, false}) {
        rc::ResolutionController controller(
            {.minSize = 512, .lowerAfterFrames = 1, .crossFadeFrames = 4});
        const double enlarged = controller.settings().slope.c / 512;
        const double first = raised ? enlarged : 0, last = raised ? 0 : enlarged;
        const auto before = controller.update(raised ? few : many);
        ASSERT_EQ(before.size, raised ? 512 : 1024);
        EXPECT_EQ(before.minRadiusUv, first);
        for (int frame = 1; frame < 5; ++frame) {
            const auto d = controller.update(raised ? many : few);
            EXPECT_EQ(d.size, raised ? 1024 : 512);
            EXPECT_NEAR(d.minRadiusUv, first + (last - first) * frame / 5, 1e-12) << "rounding";
        }
        EXPECT_EQ(controller.update(raised ? many : few).minRadiusUv, last);
    }
    // Where no filter is enlarged none is in the fade.
    rc::ResolutionController enough({.crossFadeFrames = 4});
    enough.update(radiusFor(500));
    for (int frame = 0; frame < 6; ++frame)
        EXPECT_EQ(enough.update(radiusFor(4000)).minRadiusUv, 0);
}

/// The share of the picture that is replaced from one frame to the next.
double replaced(const rc::Decision& before, const rc::Decision& now) {
    std::map<std::int32_t, double> shares;
    shares[now.size] += now.fadeWeight;
    shares[now.fadeFromSize] += 1 - now.fadeWeight;
    shares[before.size] -= before.fadeWeight;
    shares[before.fadeFromSize] -= 1 - before.fadeWeight;
    double sum = 0;
    for (const auto& [size, share] : shares) sum += std::max(share, 0.0);
    return sum;
}

TEST(CrossFade, KeepsTheMapWithTheLargerShareWhereTheSizeChangesAgain) {
    rc::ResolutionController controller({.crossFadeFrames = 9});
    controller.update(radiusFor(500));
    for (int frame = 1; frame <= 4; ++frame) controller.update(radiusFor(1000));
    const rc::Decision goesOn = controller.update(radiusFor(2000));
    EXPECT_EQ(goesOn.previousSize, 1024);
    EXPECT_EQ(goesOn.fadeFromSize, 512) << "still six tenths of the picture";
    EXPECT_DOUBLE_EQ(goesOn.fadeWeight, 0.5);
    const rc::Decision anew = controller.update(radiusFor(4000));
    EXPECT_EQ(anew.fadeFromSize, 2048) << "now half of it";
    EXPECT_DOUBLE_EQ(anew.fadeWeight, 0.1);
    const rc::Decision back = controller.hold({.budgetSize = 2048});
    EXPECT_EQ(back.size, 2048);
    EXPECT_EQ(back.fadeWeight, 1) << "it has just begun, and turns round";
}

TEST(CrossFade, TurnsRoundWhereTheSizeGoesBack) {
    rc::ResolutionController controller({.crossFadeFrames = 9});
    controller.update(radiusFor(500));
    for (int frame = 1; frame <= 3; ++frame) controller.update(radiusFor(1000));
    const rc::Decision back = controller.update(radiusFor(1000), {.budgetSize = 512});
    EXPECT_EQ(back.size, 512);
    EXPECT_EQ(back.fadeFromSize, 1024);
    EXPECT_DOUBLE_EQ(back.fadeWeight, 0.8);
    EXPECT_DOUBLE_EQ(controller.hold({.budgetSize = 512}).fadeWeight, 0.9);
    EXPECT_DOUBLE_EQ(controller.hold({.budgetSize = 512}).fadeWeight, 1);
}

// Whatever the demands, the limits and the settings do: half of the picture at most, beside a
// step; and a fade ends.
TEST(CrossFade, ReplacesAtMostHalfOfThePictureBesideAStep) {
    for (int run = 0; run < 200; ++run) {
        std::mt19937_64 rng(std::uint64_t(run) + 1);
        rc::Settings settings{.lowerAfterFrames = 1 + int(rng() % 9),
                              .crossFadeFrames = 1 + int(rng() % 30)};
        rc::ResolutionController controller(settings);
        double need = 500;
        rc::Decision last = controller.update(radiusFor(need));
        for (int frame = 0; frame < 400; ++frame) {
            if (rng() % 4 == 0)
                need = std::clamp(need * std::exp2(double(rng() % 5) - 2), 70.0, 8000.0);
            rc::Frame about;
            if (frame / 20 % 3 == 2) about.budgetSize = 64 << (rng() % 7);
            if (rng() % 25 == 0) {
                settings.crossFadeFrames = 1 + int(rng() % 30);
                controller.reconfigure(settings);
            }
            const rc::Decision d =
                rng() % 5 ? controller.update(radiusFor(need), about) : controller.hold(about);
            const double step = 1.0 / (settings.crossFadeFrames + 1);
            ASSERT_LE(replaced(last, d), 0.5 + step + 1e-9) << run << ' ' << frame;
            if (d.fadeFromSize == last.fadeFromSize && last.fadeWeight < 1 && d.size == last.size) {
                ASSERT_GT(d.fadeWeight, last.fadeWeight);
            }
            const bool lowered = d.changed && d.size < d.previousSize;
            ASSERT_FALSE(lowered && last.fadeWeight + step < 1 - step / 2 && !about.budgetSize)
                << "a lowering waits for the end";
            last = d;
        }
        for (int frame = 0; frame < 1000; ++frame) last = controller.update(radiusFor(need));
        EXPECT_EQ(last.fadeWeight, 1);
        EXPECT_EQ(last.fadeFromSize, last.size);
    }
}

TEST(CrossFade, ALoweringWaitsForItsEnd) {
    rc::ResolutionController controller({.lowerAfterFrames = 3, .crossFadeFrames = 9});
    controller.update(radiusFor(500));
    controller.update(radiusFor(1000));
    for (int frame = 2; frame <= 9; ++frame) {
        const rc::Decision d = controller.update(radiusFor(100));
        EXPECT_EQ(d.size, 1024);
        EXPECT_DOUBLE_EQ(d.fadeWeight, frame / 10.0);
    }
    const rc::Decision lowered = controller.update(radiusFor(100));
    EXPECT_EQ(lowered.size, 128) << "where the fade is over, having waited meanwhile";
    EXPECT_EQ(lowered.fadeFromSize, 1024);
    EXPECT_DOUBLE_EQ(lowered.fadeWeight, 0.1);
}

TEST(CrossFade, GoesOnFromItsWeightWhenTheFramesBecomeOthers) {
    rc::ResolutionController controller({.crossFadeFrames = 9});
    controller.update(radiusFor(500));
    for (int frame = 1; frame <= 4; ++frame) controller.update(radiusFor(1000));
    EXPECT_EQ(controller.reconfigure({.crossFadeFrames = 99}), "");
    EXPECT_DOUBLE_EQ(controller.update(radiusFor(1000)).fadeWeight, 0.41) << "slower from here";
    EXPECT_EQ(controller.reconfigure({.crossFadeFrames = 4}), "");
    EXPECT_DOUBLE_EQ(controller.update(radiusFor(1000)).fadeWeight, 0.61) << "and faster";
    EXPECT_EQ(controller.reconfigure({.crossFadeFrames = 0}), "");
    EXPECT_EQ(controller.update(radiusFor(1000)).fadeWeight, 1);
}

TEST(CrossFade, IsAbsentByDefaultAndBeforeAnythingChanged) {
    rc::ResolutionController off({}), on({.crossFadeFrames = 10});
    for (const double need : {500.0, 4000.0, 8000.0}) {
        const rc::Decision d = off.update(radiusFor(need));
        EXPECT_EQ(d.fadeWeight, 1);
        EXPECT_EQ(d.fadeFromSize, d.size);
    }
    EXPECT_EQ(on.hold().fadeWeight, 1);
    EXPECT_EQ(on.update(radiusFor(5000)).fadeWeight, 1) << "the first data: nothing was shown";
    EXPECT_EQ(off.reconfigure({.crossFadeFrames = 10}), "");
    EXPECT_EQ(off.update(radiusFor(8000)).fadeWeight, 1) << "switched on long after the change";
}

TEST(Frame, ContrastTermActsOnTheSlopeAndOnlyWithAnExponent) {
    const rc::Settings with{.slope = {.contrastExponent = 0.5}};
    EXPECT_EQ(rc::ResolutionController(with).update(radiusFor(999.5), {.contrast = 0.25}).need,
              500);
    EXPECT_EQ(rc::ResolutionController({}).update(radiusFor(999.5), {.contrast = 0.25}).need, 1000);
    EXPECT_EQ(rc::ResolutionController(with).update(radiusFor(999.5), {.contrast = kNan}).need,
              1000);
}

TEST(Frame, NoTexelSmallerThanAPixel) {
    rc::ResolutionController controller({});
    EXPECT_EQ(controller.update(1e-6, {.footprintUv = 1.0 / 500}).need, 500);
    for (const double none : {0.0, -1.0, kNan, kInf}) {
        EXPECT_EQ(controller.update(radiusFor(699.5), {.footprintUv = none}).need, 700);
    }
}

TEST(Frame, ThinCastersRaiseTheSizePastThePercentile) {
    rc::DemandHistogram h;
    for (int i = 0; i < 1000; ++i) h.add(100);
    rc::ResolutionController controller({});
    const rc::Decision d = controller.update(h, {.detailTexels = 900});
    EXPECT_EQ(d.size, 1024);
    EXPECT_EQ(d.reason, Reason::detailMet);
    EXPECT_EQ(d.need, 900);
    EXPECT_NEAR(d.artifactRatio, 108.0 / 1024, 1e-12) << "of the filter: upper edge of 100's bin";
    EXPECT_EQ(d.minRadiusUv, 0);
    const rc::Decision limited = controller.update(h, {.budgetSize = 512, .detailTexels = 900});
    EXPECT_EQ(limited.reason, Reason::limitedByBudget);
    EXPECT_EQ(limited.minRadiusUv, 0) << "a wider filter brings no bar back";
    rc::ResolutionController off({.texelsPerCaster = 0});
    EXPECT_EQ(off.update(h, {.detailTexels = 900}).size, 128);
    for (const std::int32_t none : {0, -5, std::numeric_limits<std::int32_t>::min()}) {
        EXPECT_EQ(rc::ResolutionController({}).update(h, {.detailTexels = none}).size, 128);
    }
}

TEST(Frame, TheTextureLimitsWhatItHolds) {
    rc::ResolutionController controller({.textureSize = 2048});
    const rc::Decision d = controller.update(radiusFor(5000));
    EXPECT_EQ(d.size, 2048);
    EXPECT_EQ(d.reason, Reason::limitedByTexture);
    EXPECT_EQ(d.map.textureScale, 1);
    const rc::Decision small = controller.update(radiusFor(1000), {.cameraCut = true});
    EXPECT_EQ(small.map.viewport, 1024);
    EXPECT_EQ(small.map.textureScale, 0.5);
}

TEST(MapConstants, HoldWhatTheSizeSays) {
    const rc::MapConstants m = rc::constantsFor(1000, 4000, 0.01, 0.02);
    EXPECT_EQ(m.viewport, 1000);
    EXPECT_EQ(m.cleared, 1000 + 20 + 1) << "the largest radius and one texel";
    EXPECT_EQ(m.textureScale, 0.25);
    EXPECT_EQ(m.texelUv, 0.001);
    EXPECT_DOUBLE_EQ(m.radiusTexels, 10);
    EXPECT_EQ(m.kernelReachTexels, 10);
    EXPECT_EQ(m.planeBiasUv, 0.0005);
    EXPECT_DOUBLE_EQ(m.normalOffsetUv, std::sqrt(0.5) / 1000);
}

// Every texel whose square a disc around any point of a texel can touch.
TEST(MapConstants, KernelReachesWhatADiscTouches) {
    for (double texels = 0.1; texels < 20; texels += 0.07) {
        const rc::MapConstants m = rc::constantsFor(512, 0, texels / 512, 0);
        int farthest = 0;
        for (double centre = 0; centre < 1; centre += 0.01) {
            farthest = std::max(farthest, int(std::floor(centre + texels)));
            farthest = std::max(farthest, -int(std::floor(centre - texels)));
        }
        EXPECT_GE(m.kernelReachTexels, farthest) << texels;
        EXPECT_LE(m.kernelReachTexels, farthest + 1) << texels;
    }
}

TEST(MapConstants, StayFiniteAndInsideTheTexture) {
    for (const double r : {0.0, -1.0, kNan, kInf, 1e-300, 1e300, 0.5}) {
        for (const std::int32_t size : {0, -4, 1, 512, 32768}) {
            const rc::MapConstants m = rc::constantsFor(size, 1024, r, r);
            EXPECT_GE(m.cleared, m.viewport);
            EXPECT_LE(m.cleared, std::max(size > 0 ? size : 0, 1024));
            EXPECT_GE(m.kernelReachTexels, 0);
            EXPECT_TRUE(std::isfinite(m.radiusTexels) || r == 1e300);
        }
    }
    EXPECT_EQ(rc::constantsFor(0, 1024, 0.1, 0.1), rc::MapConstants{});
}

TEST(MapConstants, OfADecisionFollowTheEnlargedFilter) {
    rc::ResolutionController controller({.maxSize = 512});
    const rc::Decision d = controller.update(radiusFor(2000));
    EXPECT_DOUBLE_EQ(d.map.radiusUv, d.minRadiusUv);
    EXPECT_NEAR(d.map.radiusTexels, 3.47, 1e-12) << "c texels: at the study's criterion";
    EXPECT_EQ(d.map.kernelReachTexels, 4);
    const rc::Decision wide = controller.update(radiusFor(100));
    EXPECT_DOUBLE_EQ(wide.map.radiusUv, radiusFor(100));
    rc::DemandHistogram h;
    h.add(300);
    EXPECT_EQ(controller.update(h).map.radiusUv, 0) << "it varies over the map";
}

TEST(DemandRule, IsTheSettings) {
    const rc::DemandRule rule = rc::demandRule(
        {.slope = {.c = 2, .contrastExponent = 0.25}, .pixelBound = 1.5f, .texelsPerCaster = 3});
    EXPECT_EQ(rule.c, 2);
    EXPECT_EQ(rule.contrastExponent, 0.25f);
    EXPECT_EQ(rule.pixelBound, 1.5f);
    EXPECT_EQ(rule.texelsPerCaster, 3);
    EXPECT_TRUE(std::isfinite(rc::demandRule({.slope = {.c = 1e300}}).c));
}

// Any state taken on the way gives the same future.
TEST(ControllerState, GoesOnWhereItWasTaken) {
    const rc::Settings settings{.lowerAfterFrames = 5, .textureSize = 8192, .crossFadeFrames = 3};
    rc::ResolutionController first(settings);
    const auto step = [](rc::ResolutionController& c, int frame) {
        const rc::Frame f{.cameraCut = frame % 37 == 0, .dataAgeFrames = frame % 3};
        if (frame % 11 == 0) return c.hold(f);
        return c.update(radiusFor(50 + (frame * 7919) % 4000 * (frame % 50 < 25 ? 1 : 0.01)), f);
    };
    for (int frame = 0; frame < 300; ++frame) {
        rc::ResolutionController second(settings, first.state());
        rc::ResolutionController ahead = first;
        for (int f = frame; f < frame + 20; ++f) ASSERT_EQ(step(second, f), step(ahead, f));
        step(first, frame);
        ASSERT_EQ(rc::validate(first.state()), "");
    }
}

TEST(ControllerState, RefusesWhatNoControllerWasEverIn) {
    const rc::ControllerState good = rc::ResolutionController({}).state();
    EXPECT_EQ(rc::validate(good), "");
    const auto refused = [&](auto spoil) {
        rc::ControllerState state = good;
        spoil(state);
        EXPECT_NE(rc::validate(state), "");
        EXPECT_THROW(rc::ResolutionController({}, state), std::invalid_argument);
    };
    refused([](auto& s) { s.last.size = 1000; });
    refused([](auto& s) { s.last.size = -1; });
    refused([](auto& s) { s.last.previousSize = 0; });
    refused([](auto& s) { s.last.fadeFromSize = 1 << 30; });
    refused([](auto& s) { s.last.need = 70000; });
    refused([](auto& s) { s.last.reason = Reason(200); });
    refused([](auto& s) { s.last.artifactRatio = kNan; });
    refused([](auto& s) { s.last.fadeWeight = 1.5; });
    refused([](auto& s) { s.radiusUv = kInf; });
    refused([](auto& s) { s.framesBelow = -1; });
    refused([](auto& s) { s.fellTo = -1; });
    refused([](auto& s) { s.fellTo = 1000; });
    refused([](auto& s) { s.falls.trialFrames = -1; });
    refused([](auto& s) { s.falls.takenBack = 21; });
    refused([](auto& s) { s.falls.takenBack = -1; });
    refused([](auto& s) { s.falls.pauseFrames = -1; });
    refused([](auto& s) { s.falls.size = 65537; });
    refused([](auto& s) { s.falls.framesOnSize = -1; });
    refused([](auto& s) { s.falls.needOnSize = -1; });
}

}  // namespace
