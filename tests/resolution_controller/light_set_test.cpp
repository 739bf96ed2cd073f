// SPDX-License-Identifier: MIT
#include "resolution_controller/light_set.h"

#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace {

namespace rc = resolution_controller;
using rc::LightData;
using rc::Reason;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

LightData needing(double texels, const rc::Frame& frame = {}) {
    return {.kind = LightData::Kind::radius, .radiusUv = 3.47 / texels, .frame = frame};
}

std::uint64_t texelsOf(const std::vector<rc::Decision>& decisions) {
    std::uint64_t sum = 0;
    for (const auto& d : decisions) sum += std::uint64_t(d.size) * d.size;
    return sum;
}

struct Fixture {
    explicit Fixture(std::size_t n, const rc::Settings& settings = {})
        : lights(std::vector<rc::Settings>(n, settings)), decisions(n) {}
    rc::LightSummary update(const std::vector<LightData>& data,
                            std::optional<std::int64_t> budget = {}) {
        return lights.update(data, decisions, {.texels = budget});
    }
    rc::LightSet lights;
    std::vector<rc::Decision> decisions;
};

TEST(LightSet, WithoutABudgetEachLightDecidesAsIfAlone) {
    std::mt19937_64 rng(1);
    Fixture f(3);
    std::vector<rc::ResolutionController> alone(3, rc::ResolutionController({}));
    rc::DemandHistogram h;
    for (int frame = 0; frame < 500; ++frame) {
        h.add(float(rng() % 3000));
        const double need = 20 + double(rng() % 3000);
        const rc::Frame cut{.cameraCut = frame % 50 == 0};
        f.update({needing(need, cut), {.kind = LightData::Kind::histogram, .histogram = &h}, {}});
        EXPECT_EQ(f.decisions[0], alone[0].update(3.47 / need, cut));
        EXPECT_EQ(f.decisions[1], alone[1].update(h));
        EXPECT_EQ(f.decisions[2], alone[2].hold());
    }
}

TEST(LightSet, AnAmpleBudgetChangesNothing) {
    Fixture with(4), without(4);
    std::mt19937_64 rng(2);
    for (int frame = 0; frame < 300; ++frame) {
        std::vector<LightData> data;
        for (int i = 0; i < 4; ++i) data.push_back(needing(20 + double(rng() % 3000)));
        const auto a = with.update(data, 4LL * 8192 * 8192);
        const auto b = without.update(data);
        EXPECT_EQ(with.decisions, without.decisions);
        EXPECT_EQ(a.budget.used, b.budget.used);
        EXPECT_TRUE(a.budget.feasible);
    }
}

TEST(LightSet, StaysWithinTheBudgetWhateverComes) {
    std::mt19937_64 rng(3);
    Fixture f(6);
    for (int frame = 0; frame < 5000; ++frame) {
        std::vector<LightData> data;
        for (int i = 0; i < 6; ++i) {
            const double need = std::exp2(4 + double(rng() % 1000) / 100);
            data.push_back(rng() % 9 == 0 ? LightData{} : needing(need));
        }
        const auto budget = std::int64_t(6 * 64 * 64 + rng() % 8'000'000);
        const auto summary = f.update(data, budget);
        ASSERT_TRUE(summary.budget.feasible);
        ASSERT_LE(texelsOf(f.decisions), std::uint64_t(budget));
        ASSERT_EQ(texelsOf(f.decisions), summary.budget.used);
        double worst = 0;
        for (const auto& d : f.decisions) worst = std::max(worst, d.artifactRatio);
        ASSERT_EQ(worst, summary.worstArtifactRatio);
        ASSERT_EQ(worst, f.decisions[summary.worstLight].artifactRatio);
    }
}

TEST(LightSet, LimitedLightsSaySoAndEnlargeTheirFilters) {
    Fixture f(2);
    const auto summary = f.update({needing(2000), needing(2000)}, 2 * 1024 * 1024);
    for (const auto& d : f.decisions) {
        EXPECT_EQ(d.size, 1024);
        EXPECT_EQ(d.reason, Reason::limitedByBudget);
        EXPECT_DOUBLE_EQ(d.minRadiusUv, 3.47 / 1024);
    }
    EXPECT_NEAR(summary.worstArtifactRatio, 2000.0 / 1024, 1e-9);
    EXPECT_EQ(summary.budget.wanted, 2u * 2048 * 2048);
}

TEST(LightSet, ALightInNeedTakesFromThoseThatWaitToBeLowered) {
    Fixture f(2);
    f.update({needing(2000), needing(100)}, 2048 * 2048 + 200 * 200);
    EXPECT_EQ(f.decisions[0].size, 2048);
    f.update({needing(100), needing(100)}, 2048 * 2048 + 200 * 200);
    EXPECT_EQ(f.decisions[0].size, 2048) << "waits";
    for (int frame = 0; frame < 50; ++frame) {
        f.update({needing(100), needing(100)}, 2048 * 2048 + 200 * 200);
    }
    EXPECT_EQ(f.decisions[0].size, 128);
    f.update({needing(100), needing(2000)}, 2048 * 2048 + 200 * 200);
    EXPECT_EQ(f.decisions[1].size, 2048);
}

// Demands that wander by 10 % leave the allotment at rest once every light's largest was seen.
TEST(LightSet, DoesNotTradeTexelsBackAndForthOnAStillScene) {
    std::mt19937_64 rng(4);
    std::uniform_real_distribution<double> logNeed(6, 12), jitter(0.9, 1.1);
    for (int scene = 0; scene < 60; ++scene) {
        Fixture f(8);
        std::vector<double> needs(8);
        for (double& need : needs) need = std::exp2(logNeed(rng));
        const auto budget = std::int64_t(std::exp2(18 + 6 * double(rng() % 1000) / 1000));
        int lateChanges = 0;
        for (int frame = 0; frame < 1500; ++frame) {
            std::vector<LightData> data;
            // Every light's largest demand is seen by frame 20.
            for (const double need : needs) {
                data.push_back(needing(need * (frame == 20 ? 1.1 : jitter(rng))));
            }
            const auto summary = f.update(data, budget);
            if (frame > 21) lateChanges += summary.changes;
        }
        EXPECT_EQ(lateChanges, 0) << "scene " << scene;
    }
}

/// Lights whose measured need is larger on a map that is too small, as that of percentiles is,
/// heard three frames late. Counts the changes in frames `from` to `to`.
int changesIn(std::uint64_t seed, rc::Rules rules, int from, int to) {
    std::mt19937_64 rng(seed);
    std::uniform_real_distribution<double> logNeed(6, 11), share(0.3, 1), growth(1.3, 2.2);
    constexpr std::size_t kLights = 6;
    Fixture f(kLights);
    f.lights.decideBy(rules);
    struct Light {
        double need, enough, growth;
        std::vector<int> sizes;
    };
    std::vector<Light> lights(kLights);
    for (Light& light : lights) {
        light.need = std::exp2(logNeed(rng));
        light.enough = light.need * share(rng);
        light.growth = growth(rng);
    }
    const auto budget = std::int64_t(std::exp2(17 + 6 * double(rng() % 1000) / 1000));
    int changes = 0;
    for (int frame = 0; frame < to; ++frame) {
        std::vector<LightData> data;
        for (const Light& light : lights) {
            const int size = frame < 3 ? 512 : light.sizes[std::size_t(frame) - 3];
            data.push_back(needing(light.need * (size < light.enough ? light.growth : 1)));
        }
        const auto summary = f.update(data, budget);
        if (frame >= from) changes += summary.changes;
        for (std::size_t i = 0; i < kLights; ++i) lights[i].sizes.push_back(f.decisions[i].size);
    }
    return changes;
}

TEST(LightSet, DoesNotTradeTexelsWhereADemandDependsOnTheMapThatItIsMeasuredOn) {
    int traded = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        using enum rc::Rules;
        EXPECT_EQ(changesIn(seed, fallsRemembered, 700, 64 * 45), 0) << "scene " << seed;
        EXPECT_EQ(changesIn(seed, fallsRemembered, 4000, 3 * 64 * 45), 0)
            << "tried again once in scene " << seed;
        EXPECT_EQ(changesIn(seed, needsRemembered, 700, 64 * 45), 0);
        traded += changesIn(seed, nothingRemembered, 700, 64 * 45) > 0 ? 1 : 0;
    }
    EXPECT_GT(traded, 5) << "scenes in which it would, were no fall remembered";
}

/// A light that asks for 500 texels or, where its map is below 728, for 1000.
struct Grudging {
    explicit Grudging(std::size_t lights) : f(lights) {}
    /// Frames in which the first light's demand is `factor` times as large.
    void frames(int count, double factor = 1, const rc::Frame& first = {}) {
        for (int i = 0; i < count; ++i) {
            const double texels = f.decisions[0].size < 728 ? 1000 : 500;
            std::vector<LightData> data{needing(texels * factor, i == 0 ? first : rc::Frame{})};
            if (f.decisions.size() > 1) data.push_back(needing(2000));
            f.update(data, budget);
            heldFell += f.lights.heldNeed(0).texels < held;
            held = f.lights.heldNeed(0).texels;
        }
    }
    Fixture f;
    std::optional<std::int64_t> budget;
    std::int32_t held = 0;
    int heldFell = 0;
};

// What a need fell to in vain is tried again ever more rarely, and at once in another scene.
TEST(LightSet, ANeedThatFellInVainPausesUntilTheSceneChanges) {
    const auto settled = [] {
        Grudging g(2);
        g.budget = 2048 * 2048 + 1;  // the other takes all that it can
        g.f.decisions[0].size = 1024;
        g.frames(400);
        EXPECT_EQ(g.heldFell, 1) << "once in vain";
        EXPECT_GE(g.held, 1000);
        return g;
    };
    Grudging still = settled();
    still.frames(64 * 45);
    EXPECT_EQ(still.heldFell, 2);
    still.frames(64 * 45);
    EXPECT_EQ(still.heldFell, 2) << "the second pause is twice as long";
    Grudging cut = settled();
    cut.frames(1, 1, {.cameraCut = true});
    EXPECT_EQ(cut.heldFell, 2);
    Grudging other = settled();
    other.frames(100, 0.3);
    EXPECT_LE(other.held, 301);
}

// A light whose need fell, rose and fell again because its scene did takes nothing from the others
// once it has waited: neither in what it holds nor in what is reserved for it.
TEST(LightSet, ANeedThatTheSceneTakesBackStarvesNobody) {
    for (const int up : {50, 60, 90, 300}) {
        Fixture f(2);
        const std::int64_t budget = 2048 * 2048 + 600 * 600;
        const auto frames = [&](int count, double texels) {
            rc::LightSummary summary;
            for (int i = 0; i < count; ++i)
                summary = f.update({needing(texels), needing(2000)}, budget);
            return summary;
        };
        frames(100, 1000);
        EXPECT_EQ(f.decisions[1].size, 1456) << "there is no more";
        for (int swing = 0; swing < 3; ++swing) {
            frames(60, 500);
            EXPECT_EQ(f.decisions[1].size, 2048);
            frames(up, 1000);
            EXPECT_EQ(f.decisions[1].size, 1456);
        }
        const rc::LightSummary summary = frames(2 * 45, 500);
        EXPECT_LE(f.lights.heldNeed(0).texels, 501) << up;
        EXPECT_EQ(f.decisions[1].size, 2048) << up;
        EXPECT_LE(summary.worstArtifactRatio, 1);
    }
}

// Where a pause does keep a need up, the light gets no more than it would choose.
TEST(LightSet, APauseReservesNothingThatTheLightDoesNotUse) {
    Grudging g(2);
    g.budget = 2048 * 2048 + 1;
    g.f.decisions[0].size = 1024;
    g.frames(400);
    EXPECT_EQ(g.f.decisions[1].size, 1456);
    g.budget = 2048 * 2048 + 740 * 740;  // the first light's 728 beside it, not its 1024
    g.frames(1);
    EXPECT_GE(g.held, 1000);
    EXPECT_TRUE(g.f.lights.heldNeed(0).falls.pauses());
    EXPECT_EQ(g.f.decisions[0].size, 728);
    EXPECT_EQ(g.f.decisions[1].size, 2048);
}

TEST(LightSet, BudgetCountsLayersAndBytes) {
    const std::vector<rc::Settings> settings{{.budgetPerTexel = 24}, {.budgetPerTexel = 4}};
    rc::LightSet lights(settings);
    std::vector<rc::Decision> decisions(2);
    const std::vector<LightData> data{needing(1000), needing(1000)};
    const auto summary = lights.update(data, decisions, {.texels = 28 * 512 * 512});
    EXPECT_EQ(summary.budget.wanted, 28u * 1024 * 1024);
    EXPECT_LE(summary.budget.used, 28u * 512 * 512);
    EXPECT_GE(decisions[1].size, decisions[0].size);
}

TEST(LightSet, LightsThatAreOffTakeNothing) {
    Fixture f(2);
    f.update({needing(2000), needing(2000)});
    const LightData off{.kind = LightData::Kind::off};
    const auto summary = f.update({off, needing(2000)}, 2048 * 2048);
    EXPECT_EQ(f.decisions[0].reason, Reason::switchedOff);
    EXPECT_EQ(f.decisions[0].size, 2048);
    EXPECT_FALSE(f.decisions[0].changed);
    EXPECT_EQ(f.decisions[1].size, 2048);
    EXPECT_EQ(summary.budget.used, 2048u * 2048);
    // A cut that it slept through is not lost on it.
    LightData offAtCut = off;
    offAtCut.frame.cameraCut = true;
    f.update({offAtCut, needing(2000)});
    f.update({needing(100), needing(2000)});
    EXPECT_EQ(f.decisions[0].size, 128);
}

// As a damaged trace may hold it.
TEST(LightSet, LowersAfterARestoredStateThatHasWaitedForeverAlready) {
    Fixture f(1);
    f.update({needing(2000)});
    rc::ControllerState state = f.lights.light(0).state();
    state.framesBelow = std::numeric_limits<std::int32_t>::max();
    rc::HeldNeed need = f.lights.heldNeed(0);
    need.framesBelow = std::numeric_limits<std::int32_t>::max();
    f.lights.restore(0, state, need);
    f.update({needing(200)});
    EXPECT_EQ(f.decisions[0].size, 256);
    EXPECT_EQ(f.lights.heldNeed(0).texels, 200);
}

TEST(LightSet, HoldsWithoutDataAndKeepsItsNeed) {
    Fixture f(2);
    f.update({needing(2000), needing(2000)}, 2 * 2048 * 2048);
    for (const LightData& bad :
         {LightData{}, needing(kNan), LightData{.kind = LightData::Kind::histogram},
          LightData{.kind = LightData::Kind(77), .radiusUv = 1}}) {
        f.update({bad, needing(2000)}, 2048 * 2048);
        EXPECT_EQ(f.decisions[0].size, 1456) << "its need still counts: 2000 as the other's";
        EXPECT_GE(int(f.decisions[0].reason), int(Reason::heldWithoutData));
        f.update({needing(2000), needing(2000)}, 2 * 2048 * 2048);
    }
}

TEST(LightSet, ZeroBudgetZeroLightsAndShortSpansAreDefined) {
    Fixture f(3);
    const auto summary = f.update({needing(500), needing(500), needing(500)}, 0);
    EXPECT_FALSE(summary.budget.feasible);
    for (const auto& d : f.decisions) {
        EXPECT_EQ(d.size, 64);
        EXPECT_EQ(d.reason, Reason::limitedByBudget);
    }
    EXPECT_FALSE(f.update({needing(500)}, -7).budget.feasible) << "two lights without data";
    std::vector<rc::Decision> one(1);
    const std::vector<LightData> many(9, needing(100));
    f.lights.update(many, one);
    EXPECT_EQ(one[0].size, 128);

    rc::LightSet none(std::span<const rc::Settings>{});
    const auto nothing = none.update(many, one, {.texels = 0});
    EXPECT_TRUE(nothing.budget.feasible);
    EXPECT_EQ(nothing.changes, 0);
}

TEST(LightSet, RefusesBadSettingsByLight) {
    const std::vector<rc::Settings> settings{{}, {.minSize = -1}};
    try {
        rc::LightSet lights(settings);
        ADD_FAILURE();
    } catch (const std::invalid_argument& e) {
        EXPECT_THAT(e.what(), HasSubstr("light 1: resolution controller: minSize is -1"));
    }
    const std::vector<rc::Settings> tooMany(rc::kMostLights + 1);
    EXPECT_THROW(rc::LightSet{tooMany}, std::invalid_argument);
    Fixture f(1);
    EXPECT_THAT(f.lights.reconfigure(1, {}), HasSubstr("light is 1: must be below their number"));
    EXPECT_THAT(f.lights.reconfigure(0, {.minSize = -1}), HasSubstr("minSize is -1"));
    f.update({needing(100)});
    EXPECT_EQ(f.decisions[0].reason, Reason::heldBadSettings);
}

TEST(LightSet, SettlesFromAnyStartWithinFourChanges) {
    for (std::int32_t start = 64; start <= 8192; start *= 2) {
        Fixture f(5, {.startSize = start});
        std::vector<int> changes(5);
        for (int frame = 0; frame < 300; ++frame) {
            f.update({needing(3000), needing(1500), needing(700), needing(90), {}}, 6'000'000);
            for (std::size_t i = 0; i < 5; ++i) changes[i] += f.decisions[i].changed;
        }
        for (const int n : changes) EXPECT_LE(n, 4);
    }
}

/// Of decisions that hang on everything.
std::uint64_t hashOfDecisions(rc::Rules rules) {
    std::mt19937_64 rng(2024);
    rc::LightSet lights(std::vector<rc::Settings>{
        {.slope = {.c = 3.1, .contrastExponent = 0.23}, .crossFadeFrames = 7},
        {.levelRatio = rc::LevelRatio::two},
        {.percentile = 0.9, .textureSize = 4096}});
    lights.decideBy(rules);
    std::vector<rc::Decision> decisions(3);
    std::uint64_t hash = 14695981039346656037u;
    const auto add = [&hash](std::uint64_t value) { hash = (hash ^ value) * 1099511628211u; };
    for (int frame = 0; frame < 3000; ++frame) {
        rc::DemandHistogram histogram;
        for (int i = 0; i < 30; ++i) {
            const auto radius = static_cast<float>(1 + rng() % 4000) / 65536;
            histogram.add(
                rc::demand(rc::DemandRule{.contrastExponent = 0.31f},
                           {.radiusUv = radius,
                            .footprint = rc::pixelFootprint({.dudx = radius / 3, .dvdy = 0.001f}),
                            .contrast = static_cast<float>(rng() % 100) / 99}));
        }
        const double radius = double(1 + rng() % 900) / 70000;
        const rc::Frame some{.contrast = double(rng() % 100) / 99};
        const std::vector<LightData> data{
            {.kind = LightData::Kind::radius, .radiusUv = radius, .frame = some},
            {.kind = LightData::Kind::histogram, .histogram = &histogram},
            {.kind = LightData::Kind::histogram, .histogram = &histogram, .frame = some}};
        lights.update(data, decisions, {.texels = std::int64_t(rng() % 9'000'000)});
        for (const rc::Decision& d : decisions) {
            add(std::uint64_t(d.size));
            add(std::uint64_t(d.need));
            add(std::uint64_t(d.reason));
            add(std::bit_cast<std::uint64_t>(d.minRadiusUv));
            add(std::bit_cast<std::uint64_t>(d.fadeWeight));
            add(std::bit_cast<std::uint64_t>(d.artifactRatio));
        }
    }
    return hash;
}

// The promise to replays and networked games: these numbers are the same for every compiler,
// library and machine. A new rule is a new minor version of the trace with a number of its own.
TEST(LightSet, DecidesTheSameOnEveryMachine) {
    EXPECT_EQ(hashOfDecisions(rc::Rules::nothingRemembered), 11616860303923398892u);
    EXPECT_EQ(hashOfDecisions(rc::Rules::needsRemembered), 3549361728995034992u);
    EXPECT_EQ(hashOfDecisions(rc::Rules::fallsRemembered), 1161895049219113047u);
}

}  // namespace
