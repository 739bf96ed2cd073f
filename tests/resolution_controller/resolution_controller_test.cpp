// SPDX-License-Identifier: MIT
#include "resolution_controller/resolution_controller.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace rc = resolution_controller;
using rc::Reason;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

double radiusFor(double need) {
    return rc::Slope{}.c / need;
}

rc::DemandHistogram histogramOf(std::initializer_list<std::pair<float, int>> demands) {
    rc::DemandHistogram h;
    for (const auto& [texels, count] : demands) {
        for (int i = 0; i < count; ++i) h.add(texels);
    }
    return h;
}

bool limited(Reason r) {
    return r == Reason::limitedByMaximum || r == Reason::limitedByDriver ||
           r == Reason::limitedByBudget;
}

rc::Decision onFreshController(double need, const rc::Settings& settings = {}) {
    return rc::ResolutionController(settings).update(radiusFor(need));
}

TEST(ResolutionController, FollowsTheLawForOneRadius) {
    // r = 1/100 of the map: 347 texels make a = r / c.
    const rc::Decision d = rc::ResolutionController({}).update(0.01);
    EXPECT_EQ(d.need, 347);
    EXPECT_EQ(d.size, 368);
    EXPECT_EQ(d.reason, Reason::demandMet);
    EXPECT_NEAR(d.artifactRatio, 347.0 / 368, 1e-12);
    EXPECT_EQ(d.minRadiusUv, 0);
    EXPECT_EQ(d.shareAbove, 0);
}

TEST(ResolutionController, NeverFallsBelowTheNeedUnlessLimitedAndSaysHowFarToEnlarge) {
    std::mt19937_64 rng(1);
    std::uniform_real_distribution<double> logNeed(0, 18);
    for (int i = 0; i < 20000; ++i) {
        rc::Settings s;
        s.levelRatio = i % 2 ? rc::LevelRatio::two : rc::LevelRatio::sqrtTwo;
        s.minSize = 16 << (i % 5);
        s.maxSize = 1000 << (i % 4);
        s.driverMaxSize = 2048 << (i % 3);
        const double need = std::exp2(logNeed(rng));
        const rc::Decision d = onFreshController(need, s);
        ASSERT_GE(d.size, s.minSize);
        ASSERT_LE(d.size, std::min(s.maxSize, s.driverMaxSize));
        ASSERT_TRUE(rc::levelAtLeast(d.size, s.levelRatio) == d.size);
        if (limited(d.reason)) {
            ASSERT_LT(d.size, need);
            ASSERT_DOUBLE_EQ(d.minRadiusUv, s.slope.c / d.size);
            ASSERT_GT(d.minRadiusUv, radiusFor(need));
            ASSERT_GT(d.artifactRatio, 1);
            ASSERT_EQ(d.shareAbove, 1);
        } else {
            ASSERT_GE(d.size, need * (1 - 1e-12));
            ASSERT_EQ(d.minRadiusUv, 0);
            ASSERT_LE(d.artifactRatio, 1 + 1e-12);
        }
    }
}

TEST(ResolutionController, GrowsWithTheNeed) {
    for (const auto ratio : {rc::LevelRatio::sqrtTwo, rc::LevelRatio::two}) {
        std::int32_t last = 0;
        for (double need = 1; need < 70000; need *= 1.01) {
            const std::int32_t size = onFreshController(need, {.levelRatio = ratio}).size;
            EXPECT_GE(size, last);
            last = size;
        }
    }
}

TEST(ResolutionController, HistogramAndRadiusAgreeOnTheSameDemand) {
    for (double need = 20; need < 8000; need *= 1.03) {
        const auto fromHistogram =
            rc::ResolutionController({}).update(histogramOf({{float(need), 50}}));
        const auto fromRadius = onFreshController(need);
        if (fromHistogram.size == fromRadius.size) continue;
        // Levels between powers of two are a little more than sqrt 2 (up to 6 %), bin edges are
        // not: in that gap the histogram takes the next level.
        EXPECT_GT(fromHistogram.size, fromRadius.size);
        EXPECT_FALSE(std::has_single_bit(unsigned(fromRadius.size))) << need;
        EXPECT_GT(need, 0.94 * fromRadius.size);
    }
}

TEST(ResolutionController, PowersOfTwoLoseNothingToTheBins) {
    const rc::Settings s{.levelRatio = rc::LevelRatio::two};
    for (float need = 64.5f; need < 8192; need *= 1.01f) {
        EXPECT_EQ(rc::ResolutionController(s).update(histogramOf({{need, 3}})).size,
                  onFreshController(need, s).size);
    }
    EXPECT_EQ(rc::ResolutionController(s).update(histogramOf({{1024.0f, 3}})).size, 1024);
}

TEST(ResolutionController, AFewContactPixelsDoNotAskForTheMaximum) {
    const auto scene = histogramOf({{300.0f, 985}, {20000.0f, 15}});
    const rc::Decision d = rc::ResolutionController({}).update(scene);
    EXPECT_EQ(d.size, 368);
    EXPECT_EQ(d.reason, Reason::limitedByPercentile);
    EXPECT_NEAR(d.shareAbove, 0.015, 1e-12);
    EXPECT_DOUBLE_EQ(d.minRadiusUv, 3.47 / 368);
    EXPECT_LE(d.artifactRatio, 1);

    const rc::Decision published =
        rc::ResolutionController({.percentile = rc::kMaximumRule}).update(scene);
    EXPECT_EQ(published.size, 8192);
    EXPECT_EQ(published.reason, Reason::limitedByMaximum);
    const rc::Decision enough =
        rc::ResolutionController({.maxSize = 32768, .driverMaxSize = 32768, .percentile = 1})
            .update(scene);
    EXPECT_EQ(enough.size, 23176);
    EXPECT_EQ(enough.minRadiusUv, 0);
}

TEST(ResolutionController, PercentileIsMetExactly) {
    // 98 of 100 are met by the lower demand; 97 of 100 are not enough.
    EXPECT_EQ(rc::ResolutionController({}).update(histogramOf({{100.0f, 98}, {4000.0f, 2}})).size,
              128);
    EXPECT_EQ(rc::ResolutionController({}).update(histogramOf({{100.0f, 97}, {4000.0f, 3}})).size,
              4096);
    // 98 % of 99 are 97.02: so many are met only by 98.
    EXPECT_EQ(rc::ResolutionController({}).update(histogramOf({{100.0f, 97}, {4000.0f, 2}})).size,
              4096);
    // One sample is a histogram, and the smallest percentile is still somebody's.
    EXPECT_EQ(rc::ResolutionController({.percentile = 1e-12})
                  .update(histogramOf({{1000.0f, 1}, {4000.0f, 1}}))
                  .size,
              1024);
}

TEST(ResolutionController, CountsBeyond32BitsAreNoTrouble) {
    rc::DemandHistogram full;
    full.counts.fill(std::numeric_limits<std::uint32_t>::max());
    const rc::Decision d = rc::ResolutionController({}).update(full);
    EXPECT_EQ(d.size, 8192);
    EXPECT_NEAR(d.shareAbove, 12.0 / 64, 1e-9) << "bins above 2^13";
}

TEST(ResolutionController, RaisesAtOnceAndLowersLate) {
    rc::ResolutionController controller({});
    EXPECT_EQ(controller.update(radiusFor(500)).size, 512);
    const rc::Decision raised = controller.update(radiusFor(2000));
    EXPECT_EQ(raised.size, 2048);
    EXPECT_EQ(raised.previousSize, 512);
    EXPECT_TRUE(raised.changed);
    for (int frame = 1; frame < 45; ++frame) {
        const rc::Decision d = controller.update(radiusFor(300));
        EXPECT_EQ(d.size, 2048) << frame;
        EXPECT_FALSE(d.changed);
        EXPECT_EQ(d.reason, Reason::waitingToLower);
    }
    const rc::Decision lowered = controller.update(radiusFor(300));
    EXPECT_EQ(lowered.size, 512) << "300 is above 80 % of 368";
    EXPECT_TRUE(lowered.changed);
}

TEST(ResolutionController, LowersOnlyAsFarAsTheWholeWaitAllows) {
    rc::ResolutionController controller({});
    controller.update(radiusFor(4000));
    rc::Decision d;
    for (int frame = 0; frame < 45; ++frame) {
        d = controller.update(radiusFor(frame == 20 ? 1100 : 50));
    }
    EXPECT_EQ(d.size, 1456);
}

TEST(ResolutionController, AFrameThatNeedsTheSizeStartsTheWaitAnew) {
    rc::ResolutionController controller({});
    controller.update(radiusFor(1000));
    for (int round = 0; round < 10; ++round) {
        for (int frame = 0; frame < 44; ++frame) {
            EXPECT_EQ(controller.update(radiusFor(100)).size, 1024);
        }
        EXPECT_EQ(controller.update(radiusFor(600)).size, 1024);  // above .8 x 728
    }
}

TEST(ResolutionController, FramesWithoutDataNeitherCountNorStartAnew) {
    rc::ResolutionController controller({});
    controller.update(radiusFor(1000));
    for (int frame = 0; frame < 44; ++frame) {
        controller.update(radiusFor(100));
        controller.hold();
        controller.update(kNan);
    }
    EXPECT_EQ(controller.size(), 1024);
    EXPECT_EQ(controller.update(radiusFor(100)).size, 128);
}

// A demand that wanders by less than the margin never makes the size go up and down again.
TEST(ResolutionController, NeverOscillatesOnASteadyScene) {
    std::mt19937_64 rng(3);
    std::uniform_real_distribution<double> logNeed(4, 13), jitter(0.9, 1.1);
    for (int scene = 0; scene < 300; ++scene) {
        rc::ResolutionController controller(
            {.levelRatio = scene % 2 ? rc::LevelRatio::two : rc::LevelRatio::sqrtTwo,
             .startSize = 64 << (scene % 8)});
        const double need = std::exp2(logNeed(rng));
        int raises = 0, lowerings = 0, lastChange = 0;
        for (int frame = 0; frame < 600; ++frame) {
            const rc::Decision d = controller.update(radiusFor(need * jitter(rng)));
            if (!d.changed || frame == 0) continue;
            (d.size > d.previousSize ? raises : lowerings) += 1;
            lastChange = frame;
        }
        EXPECT_LE(raises, 1) << need;
        EXPECT_LE(lowerings, 1) << need;
        EXPECT_LE(raises * lowerings, 0) << "up and down again at " << need;
        EXPECT_LE(lastChange, 590);
    }
}

/// A still scene whose need is another on every size, heard a few frames late and in the sum of
/// the last ones, as in a renderer. For each frame whether the size changed.
std::vector<bool> changesInStillScene(const std::function<double(std::int32_t)>& needOn,
                                      const rc::Settings& settings, int latency, int summed,
                                      int frames) {
    rc::ResolutionController controller(settings);
    rc::RecentDemand recent(summed);
    std::vector<std::int32_t> sizes(std::size_t(latency) + 1, controller.size());
    std::vector<bool> changed;
    for (int frame = 0; frame < frames; ++frame) {
        rc::DemandHistogram seen;
        seen.add(float(needOn(sizes[sizes.size() - 1 - std::size_t(latency)])), 100);
        const rc::Decision d = controller.update(recent.add(seen));
        sizes.push_back(d.size);
        changed.push_back(d.changed);
    }
    return changed;
}

std::ptrdiff_t changesBefore(const std::vector<bool>& changed, int frame) {
    return std::count(changed.begin(), changed.begin() + frame, true);
}

// Where the larger map asks for the smaller one and the smaller for the larger, the size goes down
// once in vain; then again only in pauses that double.
TEST(ResolutionController, RestsInAStillSceneWhoseNeedDependsOnTheSize) {
    const auto needOn = [](std::int32_t size) { return size < 8192 ? 5810 : 4000; };
    for (const std::int32_t start : {64, 1024, 5800, 8192}) {
        for (const auto& [latency, summed] : {std::pair{0, 1}, {3, 1}, {3, 16}, {4, 36}}) {
            const auto changed =
                changesInStillScene(needOn, {.startSize = start}, latency, summed, 100'000);
            const int wait = 45, pause = 64 * wait, slack = 4 * wait;
            EXPECT_LE(changesBefore(changed, pause), 4) << start << ' ' << summed;
            for (int pauses = 1, time = slack; time < int(changed.size()); pauses *= 2) {
                const auto from = changed.begin() + time;
                time = std::min(time + pauses * (pause - slack), int(changed.size()));
                EXPECT_EQ(std::count(from, changed.begin() + time, true), 0)
                    << "before pause " << pauses << " is over";
                time += pauses * slack + slack;
            }
            EXPECT_LE(std::count(changed.begin(), changed.end(), true), 4 + 2 * 5);
        }
    }
}

// Whatever the need on each size, within half an octave either way.
TEST(ResolutionController, ComesToRestWhateverTheNeedOnEachSize) {
    constexpr int kScenes = 300, kPause = 64 * 45;
    int oscillated = 0, manyChanges = 0;
    for (int scene = 0; scene < kScenes; ++scene) {
        std::mt19937_64 rng(std::uint64_t(scene) + 1);
        std::uniform_real_distribution<double> logNeed(6, 13), logFactor(-0.5, 0.5);
        const double need = std::exp2(logNeed(rng));
        std::map<std::int32_t, double> factors;
        for (const std::int32_t level : rc::kLevels) factors[level] = std::exp2(logFactor(rng));
        const auto needOn = [&](std::int32_t size) { return need * factors.at(size); };
        const rc::Settings settings{.startSize = 64 << (rng() % 8)};
        const auto changed = changesInStillScene(needOn, settings, 3, 4, kPause);
        manyChanges += changesBefore(changed, kPause) > 4;
        EXPECT_EQ(std::count(changed.begin() + 700, changed.end(), true), 0) << scene;
        rc::ResolutionController forgetting(settings);
        forgetting.decideBy(rc::Rules::nothingRemembered);
        int late = 0;
        for (int frame = 0; frame < 2000; ++frame) {
            const rc::Decision d = forgetting.update(radiusFor(needOn(forgetting.size())));
            late += frame > 1000 && d.changed;
        }
        oscillated += late > 0;
    }
    EXPECT_GT(oscillated, 5) << "scenes in which it would not, were no fall remembered";
    EXPECT_LE(manyChanges, kScenes / 50);
}

// A need that swings because the scene does is followed as if nothing were remembered.
TEST(ResolutionController, FollowsASceneThatSwings) {
    for (const int high : {50, 60, 90, 200}) {
        for (const int low : {50, 60, 80, 100}) {
            rc::ResolutionController controller({}), forgetting({});
            forgetting.decideBy(rc::Rules::nothingRemembered);
            for (int frame = 0; frame < 20 * (high + low); ++frame) {
                const double radius = radiusFor(frame % (high + low) < high ? 1000 : 400);
                const std::int32_t size = controller.update(radius).size;
                ASSERT_EQ(size, forgetting.update(radius).size) << high << ' ' << low;
            }
        }
    }
    // Faster ones: never below what is asked for, and at most a pause late when all is at rest.
    for (const int high : {5, 20, 44}) {
        rc::ResolutionController controller({});
        for (int frame = 0; frame < 20 * (high + 50); ++frame) {
            const rc::Decision d =
                controller.update(radiusFor(frame % (high + 50) < high ? 1000 : 400));
            ASSERT_GE(d.size, d.need);
        }
        for (int frame = 0; frame < 66 * 45; ++frame) controller.update(radiusFor(400));
        EXPECT_EQ(controller.size(), 512) << high;
    }
}

// As random a walk as a camera takes: the mean size is that without a memory within a hundredth of
// an octave.
TEST(ResolutionController, AMovingSceneIsNotSlower) {
    double octaves = 0;
    int frames = 0;
    for (int walk = 0; walk < 20; ++walk) {
        std::mt19937_64 rng(std::uint64_t(walk) + 1);
        std::normal_distribution<double> step(0, 0.03);
        rc::ResolutionController controller({}), forgetting({});
        forgetting.decideBy(rc::Rules::nothingRemembered);
        for (double logNeed = 9; frames < 10'000 * (walk + 1); ++frames) {
            logNeed = std::clamp(logNeed + step(rng), 6.5, 12.0);
            const double radius = radiusFor(std::exp2(logNeed));
            octaves +=
                std::log2(double(controller.update(radius).size) / forgetting.update(radius).size);
        }
    }
    EXPECT_NEAR(octaves / frames, 0, 0.01);
}

TEST(ResolutionController, ForgetsFallsInVainAtACutWithOtherSettingsAndWithDataOfAnotherKind) {
    const auto inPause = [] {
        rc::ResolutionController controller({});
        for (int frame = 0; frame < 200; ++frame)
            controller.update(radiusFor(controller.size() < 1024 ? 1000 : 500));
        EXPECT_EQ(controller.size(), 1024);
        EXPECT_TRUE(controller.state().falls.pauses());
        return controller;
    };
    rc::ResolutionController waiting = inPause(), cut = inPause(), set = inPause(),
                             alike = inPause(), other = inPause(), less = inPause(),
                             older = inPause();
    EXPECT_EQ(cut.update(radiusFor(500), {.cameraCut = true}).size, 512);
    EXPECT_EQ(set.reconfigure({.percentile = 0.97}), "");
    EXPECT_EQ(alike.reconfigure({.startSize = 64, .crossFadeFrames = 8, .budgetPerTexel = 4}), "");
    older.decideBy(rc::Rules::needsRemembered);
    for (int frame = 0; frame < 60; ++frame) {
        waiting.update(radiusFor(500));
        set.update(radiusFor(500));
        alike.update(radiusFor(500));
        other.update(histogramOf({{500.0f, 9}}));
        older.update(radiusFor(500));
    }
    for (int frame = 0; frame < 2 * 45; ++frame) less.update(radiusFor(350));
    EXPECT_EQ(waiting.size(), 1024);
    EXPECT_EQ(set.size(), 728);
    EXPECT_EQ(alike.size(), 1024) << "they choose alike";
    EXPECT_EQ(other.size(), 728);
    EXPECT_EQ(older.size(), 728);
    EXPECT_EQ(less.size(), 512) << "another scene";
}

// A limit that is lifted raises the size, too; that takes a fall back only above where it went.
TEST(ResolutionController, ALimitThatIsLiftedTakesNoFallBack) {
    for (const double need : {500.0, 900.0}) {
        rc::ResolutionController controller({});
        controller.update(radiusFor(1000));
        while (controller.size() == 1024) controller.update(radiusFor(500));
        EXPECT_EQ(controller.size(), 728);
        EXPECT_EQ(controller.update(radiusFor(need), {.budgetSize = 256}).size, 256);
        EXPECT_EQ(controller.update(radiusFor(need)).size, need > 728 ? 1024 : 512);
        EXPECT_EQ(controller.state().falls.pauses(), need > 728) << need;
    }
}

// What an engine says of a map of which nothing is in view: the large map shows no penumbra, on the
// smaller one it is wide enough to be seen.
TEST(ResolutionController, RestsWhereAMapIsInViewOnlyWhileItIsSmall) {
    const rc::DemandHistogram unseen = histogramOf({{50.0f, 1}});
    const rc::DemandHistogram seen = histogramOf({{1000.0f, 9}});
    for (const int largest : {184, 368, 1024}) {
        for (const std::size_t latency : {0U, 3U, 20U}) {
            rc::ResolutionController controller({.startSize = 2048});
            std::vector<std::int32_t> sizes(latency, 2048);
            int changes = 0, late = 0;
            for (int frame = 0; frame < 64 * 45; ++frame) {
                sizes.push_back(controller.size());
                const bool isSeen = sizes[sizes.size() - 1 - latency] < largest;
                const rc::Decision d = controller.update(isSeen ? seen : unseen);
                changes += d.changed;
                late += frame > 300 && d.changed;
            }
            EXPECT_GT(changes, 1) << "or the test could not fail";
            EXPECT_EQ(late, 0) << largest << ' ' << latency;
        }
    }
}

// As a damaged trace may hold it, and over and over.
TEST(ResolutionController, PausesNeverOverflow) {
    constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
    for (const std::int32_t wait : {0, 1, 45, kMost}) {
        rc::FallMemory falls;
        for (int fall = 0, last = 0; fall < 100; ++fall) {
            falls.fell(wait, 2);
            EXPECT_GE(falls.trialFrames, std::max(std::min(wait, kMost / 2) * 2, 45));
            falls.rose(wait);
            EXPECT_GE(falls.pauseFrames, last);
            EXPECT_EQ(rc::validate(falls), "");
            last = falls.pauseFrames;
        }
        EXPECT_EQ(falls.pauseFrames, wait > 45 ? kMost : 64 * std::max(wait, 1) << 19);
        falls.framesOnSize = falls.trialFrames = kMost;
        falls.pass(100, 0, wait);
        EXPECT_EQ(rc::validate(falls), "");
    }
}

TEST(ResolutionController, LowersAtMostOncePerWaitUnderAnyDemand) {
    std::mt19937_64 rng(4);
    std::uniform_real_distribution<double> logNeed(0, 15);
    for (const int wait : {1, 10, 45}) {
        rc::ResolutionController controller({.lowerAfterFrames = wait});
        int lastLowered = -1000;
        double level = 10;
        for (int frame = 0; frame < 20000; ++frame) {
            if (rng() % 30 == 0) level = logNeed(rng);
            const rc::Decision d = controller.update(radiusFor(std::exp2(level)));
            ASSERT_TRUE(d.size >= d.need || limited(d.reason));
            if (!d.changed || d.size > d.previousSize || frame == 0) continue;
            ASSERT_GE(frame - lastLowered, wait);
            lastLowered = frame;
        }
    }
}

TEST(ResolutionController, SettlesWithinOneChangeFromAnyStart) {
    for (const std::int32_t start : {1, 64, 500, 1024, 8192, 1'000'000'000}) {
        rc::ResolutionController controller({.startSize = start});
        EXPECT_GE(controller.size(), 64);
        EXPECT_LE(controller.size(), 8192);
        EXPECT_EQ(controller.update(radiusFor(700)).size, 728) << "nothing was shown before";
        for (int frame = 0; frame < 100; ++frame) {
            EXPECT_FALSE(controller.update(radiusFor(700)).changed);
        }
    }
}

TEST(ResolutionController, HoldsOnBadInputAndNamesTheReason) {
    rc::ResolutionController controller({});
    rc::DemandHistogram onlyRejected;
    onlyRejected.add(std::numeric_limits<float>::quiet_NaN());
    const auto expectHeld = [&](const rc::Decision& d, Reason reason, std::int32_t size) {
        EXPECT_EQ(d.reason, reason) << rc::text(d.reason);
        EXPECT_EQ(d.size, size);
        EXPECT_EQ(d.previousSize, size);
        EXPECT_FALSE(d.changed);
        EXPECT_TRUE(std::isfinite(d.artifactRatio) && std::isfinite(d.minRadiusUv));
    };
    for (const std::int32_t size : {1024, 368}) {
        for (const double bad : {kNan, 0.0, -0.0, -0.1, kInf, -kInf}) {
            expectHeld(controller.update(bad), Reason::heldBadRadius, size);
        }
        expectHeld(controller.hold(), Reason::heldWithoutData, size);
        expectHeld(controller.update(rc::DemandHistogram{}), Reason::heldEmptyHistogram, size);
        expectHeld(controller.update(onlyRejected), Reason::heldRejectedDemand, size);
        controller.update(radiusFor(350));
    }
}

TEST(ResolutionController, TheTiniestAndWidestRadiiStayFinite) {
    for (const double r : {5e-324, 1e-300, 1e-9, 1.0, 1e9, 1e308}) {
        const rc::Decision d = rc::ResolutionController({}).update(r);
        EXPECT_EQ(d.size, r < 1e-3 ? 8192 : 64);
        EXPECT_TRUE(std::isfinite(d.artifactRatio));
        EXPECT_EQ(d.reason, r < 1e-3 ? Reason::limitedByMaximum : Reason::atMinimum);
    }
}

TEST(ResolutionController, WhatLimitsIsNamed) {
    EXPECT_EQ(onFreshController(5000, {.maxSize = 4096}).reason, Reason::limitedByMaximum);
    EXPECT_EQ(onFreshController(5000, {.driverMaxSize = 4096}).reason, Reason::limitedByDriver);
    rc::ResolutionController controller({});
    const rc::Decision d = controller.update(radiusFor(5000), {.budgetSize = 3000});
    EXPECT_EQ(d.reason, Reason::limitedByBudget);
    EXPECT_EQ(d.size, 2904);
    EXPECT_DOUBLE_EQ(d.minRadiusUv, 3.47 / 2904);
}

TEST(ResolutionController, ABudgetHoldsAtOnceAndAlsoWithoutData) {
    rc::ResolutionController controller({});
    controller.update(radiusFor(4000));
    const rc::Decision cut = controller.hold({.budgetSize = 1024});
    EXPECT_EQ(cut.size, 1024);
    EXPECT_TRUE(cut.changed);
    EXPECT_NEAR(cut.artifactRatio, 4000.0 / 1024, 1e-9);
    EXPECT_DOUBLE_EQ(cut.minRadiusUv, 3.47 / 1024);
    EXPECT_EQ(controller.update(radiusFor(4000), {.budgetSize = 512}).size, 512);
    EXPECT_EQ(controller.update(radiusFor(4000)).size, 4096) << "raised as soon as it may";
    for (const std::int32_t infeasible : {63, 1, 0, -5}) {
        const rc::Decision d = controller.update(radiusFor(4000), {.budgetSize = infeasible});
        EXPECT_EQ(d.size, 64) << "the minimum wins";
        EXPECT_EQ(d.reason, Reason::limitedByBudget);
    }
}

TEST(ResolutionController, EveryReasonHasItsOwnWords) {
    std::set<std::string> words;
    for (int r = 0; r < rc::kReasons; ++r) words.insert(rc::text(Reason(r)));
    EXPECT_EQ(words.size(), std::size_t(rc::kReasons));
    EXPECT_EQ(words.count("unknown"), 0u);
    EXPECT_STREQ(rc::text(Reason(rc::kReasons)), "unknown");
}

struct BadSettings {
    std::function<void(rc::Settings&)> spoil;
    std::string says;
};

std::vector<BadSettings> badSettings() {
    return {{[](auto& s) { s.slope.c = kNan; }, "slope.c is nan: must be finite"},
            {[](auto& s) { s.slope.c = kInf; }, "slope.c is inf"},
            {[](auto& s) { s.slope.c = 0; }, "slope.c is 0"},
            {[](auto& s) { s.slope.criterion = 1; }, "slope.criterion is 1"},
            {[](auto& s) { s.minSize = 4096, s.maxSize = 512; },
             "minSize is 4096: must not be above maxSize, 512"},
            {[](auto& s) { s.driverMaxSize = 32; }, "must not be above driverMaxSize, 32"},
            {[](auto& s) { s.driverMaxSize = -1; }, "must not be above driverMaxSize, -1"},
            {[](auto& s) { s.minSize = 0; }, "minSize is 0: must be at least 1"},
            {[](auto& s) { s.minSize = 100, s.maxSize = 120; }, "there must be a level between"},
            {[](auto& s) { s.minSize = 40000, s.maxSize = s.driverMaxSize = 50000; },
             "there must be a level between"},
            {[](auto& s) { s.minSize = s.maxSize = 8; }, "there must be a level between"},
            {[](auto& s) { s.minSize = 600, s.maxSize = 800, s.levelRatio = rc::LevelRatio::two; },
             "there must be a level between"},
            {[](auto& s) { s.levelRatio = rc::LevelRatio(7); }, "levelRatio is 7"},
            {[](auto& s) { s.percentile = 0; }, "percentile is 0: must be in (0, 1]"},
            {[](auto& s) { s.percentile = 1.01; }, "percentile is 1.01"},
            {[](auto& s) { s.percentile = kNan; }, "percentile is nan"},
            {[](auto& s) { s.lowerAfterFrames = -1; }, "lowerAfterFrames is -1"},
            {[](auto& s) { s.lowerBelowPercent = 0; }, "lowerBelowPercent is 0"},
            {[](auto& s) { s.lowerBelowPercent = 101; }, "lowerBelowPercent is 101"},
            {[](auto& s) { s.startSize = 0; }, "startSize is 0"},
            {[](auto& s) { s.slope.major = 2; }, "slope.major is 2"},
            {[](auto& s) { s.textureSize = -1; }, "textureSize is -1"},
            {[](auto& s) { s.textureSize = 32; }, "must not be above textureSize, 32"},
            {[](auto& s) { s.crossFadeFrames = -1; }, "crossFadeFrames is -1"},
            {[](auto& s) { s.pixelBound = 0; }, "pixelBound is 0"},
            {[](auto& s) { s.texelsPerCaster = float(kNan); }, "texelsPerCaster is nan"},
            {[](auto& s) { s.budgetPerTexel = 0; }, "budgetPerTexel is 0"},
            {[](auto& s) { s.budgetPerTexel = 65537; }, "budgetPerTexel is 65537"}};
}

TEST(ResolutionController, RefusesUnusableSettingsByNameValueAndRule) {
    for (const BadSettings& bad : badSettings()) {
        rc::Settings s;
        bad.spoil(s);
        EXPECT_THAT(rc::validate(s), HasSubstr(bad.says));
        try {
            rc::ResolutionController controller(s);
            ADD_FAILURE() << "accepted although " << bad.says;
        } catch (const std::invalid_argument& e) {
            EXPECT_THAT(e.what(), HasSubstr(bad.says));
        }
    }
}

TEST(ResolutionController, HoldsWhileItsNewSettingsAreUnusable) {
    for (const BadSettings& bad : badSettings()) {
        rc::ResolutionController controller({});
        controller.update(radiusFor(700));
        rc::Settings s;
        bad.spoil(s);
        EXPECT_THAT(controller.reconfigure(s), HasSubstr(bad.says));
        for (const rc::Decision& d : {controller.update(radiusFor(5000)), controller.hold(),
                                      controller.update(histogramOf({{5000.0f, 9}}))}) {
            EXPECT_EQ(d.size, 728);
            EXPECT_EQ(d.reason, bad.says.starts_with("slope") ? Reason::heldBadSlope
                                                              : Reason::heldBadSettings);
        }
        EXPECT_EQ(controller.reconfigure({}), "");
        EXPECT_EQ(controller.update(radiusFor(5000)).size, 5800);
    }
}

TEST(ResolutionController, MovesIntoNewLimitsAndLevelsAtOnce) {
    rc::ResolutionController controller({});
    controller.update(radiusFor(1400));
    EXPECT_EQ(controller.size(), 1456);
    EXPECT_EQ(controller.reconfigure({.levelRatio = rc::LevelRatio::two}), "");
    EXPECT_EQ(controller.update(radiusFor(1400)).size, 2048);
    EXPECT_EQ(controller.reconfigure({.maxSize = 512}), "");
    EXPECT_EQ(controller.hold().size, 512);
    EXPECT_EQ(controller.reconfigure({.minSize = 900}), "");
    EXPECT_EQ(controller.hold().size, 1024);
    EXPECT_EQ(controller.reconfigure({.slope = {.c = 6.94}}), "");
    EXPECT_EQ(controller.update(radiusFor(1000)).size, 2048) << "twice the slope, twice the map";
}

TEST(ResolutionController, EnlargesByThePresentSlopeAlsoWithoutData) {
    rc::DemandHistogram few;
    few.add(5000);
    few.add(300, 99);
    for (const bool histogram : {false, true}) {
        rc::ResolutionController controller({.maxSize = 512});
        const rc::Decision before =
            histogram ? controller.update(few) : controller.update(radiusFor(1000));
        ASSERT_EQ(before.minRadiusUv, 3.47 / before.size);
        ASSERT_EQ(controller.reconfigure({.slope = {.c = 6.94}, .maxSize = 512}), "");
        for (const rc::Decision& d : {controller.hold(), controller.update(kNan),
                                      controller.update(rc::DemandHistogram{})}) {
            EXPECT_EQ(d.size, before.size);
            EXPECT_EQ(d.minRadiusUv, 6.94 / d.size) << rc::text(d.reason);
            EXPECT_GE(d.map.radiusUv, histogram ? 0 : d.minRadiusUv);
        }
        EXPECT_NE(controller.reconfigure({.slope = {.c = kNan}, .maxSize = 512}), "");
        EXPECT_EQ(controller.hold().minRadiusUv, 6.94 / before.size) << "the last usable one";
    }
    rc::ResolutionController met({});
    met.update(radiusFor(1000));
    ASSERT_EQ(met.reconfigure({.slope = {.c = 6.94}}), "");
    EXPECT_EQ(met.hold().minRadiusUv, 0) << "no filter was narrower than its slope asks";
}

TEST(ResolutionController, SameInputSameDecisions) {
    std::mt19937_64 rng(6);
    rc::ResolutionController a({}), b({});
    for (int frame = 0; frame < 2000; ++frame) {
        rc::DemandHistogram h;
        for (int i = 0; i < 20; ++i) h.add(float(rng() % 5000));
        const rc::Decision da = a.update(h), db = b.update(h);
        ASSERT_EQ(da.size, db.size);
        ASSERT_EQ(da.reason, db.reason);
        ASSERT_EQ(da.minRadiusUv, db.minRadiusUv);
    }
}

}  // namespace
