// SPDX-License-Identifier: MIT
// From any starting size the automatic one is there after a few changes and stays, although a
// technique with a blocker search reads the map whose size it decides.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "demo/shadow_run.h"
#include "renderer/scene.h"
#include "tests/headless_gl.h"

namespace {

using demo::ShadowRun;
using tests::gl;

constexpr int kMostChanges = 4;
constexpr glm::ivec2 kSmall{160, 90}, kSmallest{96, 54};
// The smallest 16:9 frame, in whole cells, that is asked one pixel in 36 at a time.
constexpr glm::ivec2 kLarge{972, 546};

/// As many frames with data as the rotation of the sparse pixels has, whose demands are added up.
int turnsOf(glm::ivec2 framePx) {
    const int edge = renderer::DemandPass::cellEdge(framePx.x, framePx.y);
    return edge * edge;
}

void settles(const std::string& technique, const renderer::SceneEntry& scene, int startSize,
             glm::ivec2 framePx = kSmall) {
    const int lowerAfter = turnsOf(framePx);
    // Each change waits at most lowerAfter frames; the demand is one frame old.
    const int mostSettling = kMostChanges * (lowerAfter + 1);
    const int watched = lowerAfter + 2;
    renderer::Renderer frame(gl(), renderer::makeScene(scene.name), framePx.x, framePx.y);
    ShadowRun::Settings settings;
    settings.technique = &renderer::findTechnique(technique);
    settings.parameters = settings.technique->standardParameters();
    settings.radiusUv = demo::chooseSoftness(frame, {}, {}).radiusUv;
    settings.sizing.startSize = startSize;
    settings.sizing.lowerAfterFrames = lowerAfter;
    ShadowRun run(frame, gl(), settings);
    std::vector<int> changes(frame.lightViews().size());
    int lastChange = 0, quiet = 0;
    std::string sizes = std::to_string(startSize);
    for (int i = 0; i < mostSettling + watched && quiet < watched; ++i, ++quiet) {
        const std::vector<demo::ChosenResolution> last = run.maps();
        run.step();
        glFinish();  // so that every frame has the demand of the one before, on any machine
        for (std::size_t map = 0; i > 0 && map < changes.size(); ++map) {
            if (run.maps()[map].resolution == last[map].resolution) continue;
            ++changes[map];
            lastChange = i;
            quiet = 0;
            sizes += " " + std::to_string(run.maps()[map].resolution);
        }
    }
    const std::string which = std::string(scene.name) + " " + technique + ": " + sizes;
    EXPECT_LE(std::ranges::max(changes), kMostChanges) << which;
    EXPECT_LE(lastChange, mostSettling) << which;
    EXPECT_GT(run.chosen().need, 0) << which << " asks for nothing";
}

TEST(Settling, TakesFewChangesInEveryScene) {
    for (const renderer::SceneEntry& scene : renderer::builtInScenes())
        for (const char* technique : {"pcf_disc", "pcss"})
            settles(technique, scene, technique == std::string("pcss") ? 2048 : 64);
}

TEST(Settling, TakesFewChangesWithEveryTechnique) {
    for (const renderer::Technique& technique : renderer::techniques())
        settles(std::string(technique.name), renderer::findScene("planar_occluder"), 128);
}

// The technique whose demand depends on the map that it starts with.
TEST(Settling, TakesFewChangesFromAnyStart) {
#ifdef __SANITIZE_ADDRESS__
    const std::vector<int> starts{64, 8192};
#else
    const std::vector<int> starts{64, 512, 2048, 8192};
#endif
    for (const renderer::SceneEntry& scene : renderer::builtInScenes())
        for (const int start : starts) {
            // The eight maps of the lamps would take 2 GB of 8192 texels squared each.
            if (start > 4096 && !renderer::makeScene(scene.name).lamps.empty()) continue;
            settles("pcss", scene, start, kSmallest);
        }
}

TEST(Settling, TakesFewChangesInALargeFrame) {
    ASSERT_GT(turnsOf(kLarge), turnsOf(kSmall));
    settles("pcss", renderer::findScene("planar_occluder"), 64, kLarge);
}

// What a sixteenth of the pixels asks for differs from frame to frame, in this view from 512 to
// 1723 texels; the size must come from all of them.
TEST(Settling, IsNotWhatTheMostDemandingSixteenthAsksFor) {
    renderer::Renderer frame(gl(), renderer::makeScene("overlapping_spheres"), 640, 360);
    ShadowRun::Settings settings;
    settings.technique = &renderer::findTechnique("pcss");
    settings.parameters = settings.technique->standardParameters();
    settings.radiusUv = demo::chooseSoftness(frame, {}, {}).radiusUv;
    ShadowRun run(frame, gl(), settings);
    run.settle();
    const int size = run.chosen().resolution, need = run.chosen().need;
    EXPECT_LE(need, size);
    EXPECT_LE(size, 1024);
    for (int i = 0; i < turnsOf({640, 360}); ++i) {
        run.step();
        glFinish();
        EXPECT_EQ(run.chosen().resolution, size) << i;
        EXPECT_EQ(run.chosen().need, need) << i;
    }
}

// Of the techniques that read few texels of it: a blur of 8192 texels squared takes seconds.
TEST(Settling, TakesFewChangesFromTheLargestMap) {
    for (const char* technique : {"pcf_taps", "pcss"})
        settles(technique, renderer::findScene("planar_occluder"), 8192);
}

/// Lights that want more than there is: what one asks for depends on the size that the others leave
/// to it.
void settlesUnderABudget(const std::string& scene, const std::string& technique,
                         std::int64_t budgetTexels) {
    const int lowerAfter = turnsOf(kSmall);
    renderer::Renderer frame(gl(), renderer::makeScene(scene), kSmall.x, kSmall.y);
    ShadowRun::Settings settings;
    settings.technique = &renderer::findTechnique(technique);
    settings.parameters = settings.technique->standardParameters();
    settings.radiusUv = demo::chooseSoftness(frame, {}, {}).radiusUv;
    settings.sizing.lowerAfterFrames = lowerAfter;
    settings.budgetTexels = budgetTexels;
    ShadowRun run(frame, gl(), settings);
    // A need that falls in vain is taken back once before it stays.
    const int settling = 10 * (lowerAfter + 1);
    const int watched = 5 * (lowerAfter + 1);
    std::string sizes;
    int changes = 0;
    for (int i = 0; i < settling + watched; ++i) {
        const std::vector<demo::ChosenResolution> last = run.maps();
        run.step();
        glFinish();
        for (std::size_t map = 0; i >= settling && map < last.size(); ++map) {
            if (run.maps()[map].resolution == last[map].resolution) continue;
            ++changes;
            sizes += " map " + std::to_string(map) + " in frame " + std::to_string(i) + ": " +
                     std::to_string(run.maps()[map].resolution) + ";";
        }
    }
    EXPECT_EQ(changes, 0) << scene << ' ' << technique << ' ' << budgetTexels << sizes;
    EXPECT_GT(run.budget()->wanted, static_cast<std::uint64_t>(budgetTexels)) << "nothing to share";
}

TEST(Settling, StaysUnderABudget) {
    settlesUnderABudget("yard:cascades=4:lamps=2", "pcf_disc", 300'000);
    settlesUnderABudget("yard:cascades=4:lamps=2", "pcf_disc", 150'000);
#ifndef __SANITIZE_ADDRESS__
    settlesUnderABudget("yard:cascades=4:lamps=2", "pcss", 300'000);
    settlesUnderABudget("city:cascades=3", "vsm", 200'000);
    settlesUnderABudget("lamps", "pcf_disc", 300'000);
#endif
}

// Every tile of the detail probe has its turn twice, in a view where thin casters ask for more than
// the filter.
TEST(Settling, StaysWhileTheDetailProbeGoesRound) {
    renderer::Renderer frame(gl(), renderer::makeScene("terrain"), kSmall.x, kSmall.y);
    ShadowRun::Settings settings;
    settings.technique = &renderer::findTechnique("pcf_taps");
    settings.parameters = settings.technique->standardParameters();
    settings.radiusUv = 3 * demo::chooseSoftness(frame, {}, {}).radiusUv;
    ShadowRun run(frame, gl(), settings);
    run.settle();
    constexpr int kRound = 160;  // 16 tiles, one in ten frames
    int size = 0, detail = 0;
    for (int i = 0; i < 3 * kRound; ++i) {
        run.step();
        glFinish();
        if (i == kRound) {
            size = run.chosen().resolution;
            detail = run.chosen().detailTexels;
            EXPECT_GT(detail, 0) << "nothing thin is found";
        } else if (i > kRound) {
            ASSERT_EQ(run.chosen().detailTexels, detail) << i;
            ASSERT_EQ(run.chosen().resolution, size) << i;
        }
    }
}

}  // namespace
