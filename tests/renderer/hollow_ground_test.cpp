// SPDX-License-Identifier: MIT
// Ground that rises over a receiver's plane within a wide kernel, as every hollow does, is not in
// its own way.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "renderer/renderer.h"
#include "tests/headless_gl.h"

namespace {

using renderer::FloatImage;
using tests::gl;

/// Pixels of ground that are lit as far around as a penumbra reaches, by hard shadows of a large
/// map.
std::vector<bool> surelyLit(renderer::Renderer& frame) {
    constexpr int kAround = 4;
    frame.render({.technique = &renderer::findTechnique("hard"), .resolution = 4096});
    const FloatImage hard = frame.readVisibility();
    const FloatImage positions = frame.readPositions();
    std::vector<bool> lit(hard.values.size());
    for (int y = kAround; y + kAround < hard.height; ++y)
        for (int x = kAround; x + kAround < hard.width; ++x) {
            bool all = true;
            for (int j = -kAround; j <= kAround; ++j)
                for (int i = -kAround; i <= kAround; ++i)
                    all = all && hard.at(x + i, y + j) == 1 && positions.at(x + i, y + j, 3) != 0;
            lit[static_cast<std::size_t>(y * hard.width + x)] = all;
        }
    return lit;
}

// At a bias of texels alone a third of the terrain's lit pixels are darker than .9, at every N.
// What is left of them, at most .06, lies in penumbrae that are wider than the four pixels.
TEST(HollowGround, IsNotInItsOwnWayUnderTheKernelsOfComparesAtAnySize) {
    for (const char* scene : {"terrain", "knob"}) {
        renderer::Renderer frame(gl(), renderer::makeScene(scene), 320, 180);
        const std::vector<bool> lit = surelyLit(frame);
        const auto radius = static_cast<float>(frame.scene().softnessM / frame.window().extentM);
        for (const char* technique : {"pcf_disc", "pcf_grid", "pcf_taps"})
            for (const int resolution : {512, 2048}) {
                frame.render({.technique = &renderer::findTechnique(technique),
                              .resolution = resolution,
                              .radiusUv = radius});
                const FloatImage visibility = frame.readVisibility();
                int pixels = 0, dark = 0;
                for (std::size_t i = 0; i < lit.size(); ++i) {
                    if (!lit[i]) continue;
                    ++pixels;
                    dark += visibility.values[i] < 0.9F ? 1 : 0;
                }
                ASSERT_GT(pixels, 3000) << scene;
                EXPECT_LT(static_cast<double>(dark) / pixels, 0.08)
                    << scene << ' ' << technique << ' ' << resolution;
            }
    }
}

}  // namespace
