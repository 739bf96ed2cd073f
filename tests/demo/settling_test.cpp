// SPDX-License-Identifier: MIT
// From any starting size the automatic one is there after a few changes and stays, although a
// technique with a blocker search reads the map whose size it decides.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "demo/shadow_run.h"
#include "renderer/scene.h"
#include "tests/headless_gl.h"

namespace {

using demo::ShadowRun;
using tests::gl;

// As many frames with data as the rotation of the sparse pixels has, whose demands are added up.
constexpr int kLowerAfter = renderer::DemandPass::kCellEdge * renderer::DemandPass::kCellEdge;
constexpr int kMostChanges = 4;
// Each change waits at most kLowerAfter frames; the demand is one frame old.
constexpr int kSettled = kMostChanges * (kLowerAfter + 1);
constexpr int kWatched = kLowerAfter + 2;

void settles(const char* technique, const renderer::SceneEntry& scene, int startSize) {
    renderer::Renderer frame(gl(), renderer::makeScene(scene.name), 160, 90);
    ShadowRun::Settings settings;
    settings.technique = &renderer::findTechnique(technique);
    settings.parameters = settings.technique->standardParameters();
    settings.radiusUv = demo::chooseSoftness(frame, {}, {}).radiusUv;
    settings.sizing.startSize = startSize;
    settings.sizing.lowerAfterFrames = kLowerAfter;
    ShadowRun run(frame, gl(), settings);
    std::vector<int> changes(frame.lightViews().size());
    int lastChange = 0, quiet = 0;
    std::string sizes = std::to_string(startSize);
    for (int i = 0; i < kSettled + kWatched && quiet < kWatched; ++i, ++quiet) {
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
    EXPECT_LE(std::ranges::max(changes), kMostChanges)
        << scene.name << ' ' << technique << ": " << sizes;
    EXPECT_LE(lastChange, kSettled) << scene.name << ' ' << technique << ": " << sizes;
    EXPECT_GT(run.chosen().need, 0) << scene.name << ' ' << technique << " asks for nothing";
}

TEST(Settling, TakesFewChangesInEveryScene) {
    for (const renderer::SceneEntry& scene : renderer::builtInScenes())
        for (const char* technique : {"pcf_disc", "pcss"})
            settles(technique, scene, technique == std::string("pcss") ? 2048 : 64);
}

TEST(Settling, TakesFewChangesWithEveryTechnique) {
    for (const renderer::Technique& technique : renderer::techniques())
        settles(std::string(technique.name).c_str(), renderer::findScene("planar_occluder"), 128);
}

// What a sixteenth of the pixels asks for differs from frame to frame, in this view from 512 to 1723
// texels; the size must come from all of them.
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
    for (int i = 0; i < kLowerAfter; ++i) {
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

}  // namespace
