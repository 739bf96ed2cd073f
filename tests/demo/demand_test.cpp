// SPDX-License-Identifier: MIT
// The controller's demand formula as GLSL (demand.glsl) and as C++ (demand.h), and the pass that
// counts it on the GPU.
#include "resolution_controller/demand.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <numeric>
#include <random>

#include "demo/demand_glsl.h"
#include "renderer/cpu_penumbra.h"
#include "renderer/demand_pass.h"
#include "renderer/scene.h"
#include "resolution_controller/slope.h"
#include "tests/headless_gl.h"

namespace {

namespace rc = resolution_controller;
using tests::gl;

/// demand.glsl compiled as C++.
namespace glsl {
using vec2 = glm::vec2;
using uint = std::uint32_t;
using glm::abs, glm::clamp, glm::max, glm::min, glm::pow, glm::sqrt;
inline uint floatBitsToUint(float value) {
    return std::bit_cast<uint>(value);
}
#include "resolution_controller/demand.glsl"
}  // namespace glsl

using Counters = std::array<std::uint32_t, renderer::DemandPass::kCounters>;

// log-uniform over what floats hold, and every special value.
class Numbers {
  public:
    float next() {
        constexpr float kInfinity = std::numeric_limits<float>::infinity();
        constexpr float kSpecial[] = {0.0F,    -0.0F, NAN,  kInfinity, -kInfinity, 1.0F, 1e-45F,
                                      3.4e38F, -1.0F, 0.5F, 0.02F,     1e-20F,     7.0F};
        const std::uint64_t drawn = random_();
        if (drawn % 8 == 0) return kSpecial[drawn / 8 % std::size(kSpecial)];
        const double unit = static_cast<double>(drawn >> 11) * 0x1p-53;
        return static_cast<float>(std::exp2(30 * unit - 20));
    }

  private:
    std::mt19937_64 random_{1};
};

TEST(DemandFormula, CountsTheSameInGlslAndInCpp) {
    Numbers numbers;
    for (int i = 0; i < 200000; ++i) {
        const rc::DemandRule rule{.c = numbers.next(),
                                  .pixelBound = numbers.next(),
                                  .contrastExponent = 0,
                                  .texelsPerCaster = numbers.next()};
        const rc::DemandPoint point{.radiusUv = numbers.next(),
                                    .footprint = numbers.next(),
                                    .contrast = numbers.next(),
                                    .casterWidthUv = numbers.next()};
        const int bin = rc::DemandHistogram::binOf(rc::demand(rule, point));
        const int counter = glsl::stairwellDemandCounter(glsl::stairwellDemand(
            {rule.c, rule.pixelBound, rule.contrastExponent, rule.texelsPerCaster}, point.radiusUv,
            point.footprint, point.contrast, point.casterWidthUv));
        ASSERT_EQ(counter, bin < 0 ? 64 : bin)
            << "c " << rule.c << " k " << rule.pixelBound << " texels per caster "
            << rule.texelsPerCaster << " r " << point.radiusUv << " footprint " << point.footprint
            << " width " << point.casterWidthUv;
    }
}

TEST(DemandFormula, WeightIsTheSameInGlslAndInCpp) {
    Numbers numbers;
    for (int i = 0; i < 100000; ++i) {
        const float radius = numbers.next(), footprint = numbers.next();
        ASSERT_EQ(glsl::stairwellDemandWeight(radius, footprint),
                  rc::demandWeight(radius, footprint))
            << radius << ' ' << footprint;
    }
}

TEST(DemandFormula, FootprintIsTheSameInGlslAndInCpp) {
    Numbers numbers;
    for (int i = 0; i < 100000; ++i) {
        const rc::UvDerivatives d{numbers.next(), numbers.next(), numbers.next(), numbers.next()};
        ASSERT_EQ(glsl::stairwellPixelFootprint({d.dudx, d.dvdx}, {d.dudy, d.dvdy}),
                  rc::pixelFootprint(d));
    }
}

// The powers are each library's own: equal to a few rounding steps.
TEST(DemandFormula, ContrastScalesTheSlopeInGlslAsInCpp) {
    for (const float exponent : {-1.0F, -0.2F, 0.15F, 0.5F, 2.0F}) {
        for (const float contrast : {0.0F, 0.01F, 0.02F, 0.3F, 0.9F, 1.0F, -1.0F, 7.0F, NAN}) {
            const float found =
                glsl::stairwellDemand({3.47F, 1, exponent, 0}, 0.01F, 0, contrast, 0);
            const float expected = rc::demand({.contrastExponent = exponent, .texelsPerCaster = 0},
                                              {.radiusUv = 0.01F, .contrast = contrast});
            EXPECT_NEAR(found / expected, 1, 1e-6) << exponent << ' ' << contrast;
        }
    }
}

/// A finished frame as the CPU sees it.
struct Surfaces {
    renderer::FloatImage positions, planes, visibility, depths;
    renderer::f32::ShadowConstants shadow;

    Surfaces(renderer::Renderer& frame, std::size_t view)
        : positions(frame.readPositions()),
          planes(frame.readPlanes()),
          visibility(frame.readVisibility(frame.lightViews()[view].light)),
          depths(frame.readShadowMap(view)),
          shadow(frame.shadowConstants(view)) {}

    static glm::vec3 three(const renderer::FloatImage& image, int x, int y) {
        return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
    }
    /// Another visibility beside the pixel, on the same surface.
    bool changesBeside(int x, int y) const {
        for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
            const int u = x + dx, v = y + dy;
            if (u < 0 || v < 0 || u >= positions.width || v >= positions.height) continue;
            const glm::vec3 way = three(positions, u, v) - three(positions, x, y);
            if (positions.at(u, v, 3) != 0 &&
                glm::dot(three(planes, u, v),
                         renderer::f32::towardsLight(three(positions, u, v), shadow)) > 0 &&
                std::abs(glm::dot(way, three(planes, x, y))) <= 0.5F * glm::length(way) &&
                std::abs(visibility.at(u, v) - visibility.at(x, y)) > renderer::f32::kVisibleShare)
                return true;
        }
        return false;
    }
};

/// All pixels of the last frame on the CPU: the shaders' receiver, the technique's radius, the
/// controller's formula.
Counters onTheCpu(renderer::Renderer& frame, const renderer::Technique& technique,
                  const rc::DemandRule& rule, std::size_t view = 0) {
    const Surfaces surfaces(frame, view);
    const auto& shadow = surfaces.shadow;
    Counters counters{};
    for (int y = 0; y < surfaces.positions.height; ++y) {
        for (int x = 0; x < surfaces.positions.width; ++x) {
            if (surfaces.positions.at(x, y, 3) == 0) continue;
            const auto receiver = renderer::f32::shadowReceiver(
                Surfaces::three(surfaces.positions, x, y), Surfaces::three(surfaces.planes, x, y),
                frame.viewConstants(), shadow);
            const bool onMap = receiver.uv.x >= 0 && receiver.uv.y >= 0 && receiver.uv.x <= 1 &&
                               receiver.uv.y <= 1;
            if (!receiver.facesLight || !onMap) continue;
            const glm::vec3 place = Surfaces::three(surfaces.positions, x, y);
            if (!serves(receiver, glm::dot(place, glm::vec3(frame.viewConstants().forward)),
                        shadow))
                continue;
            // A hard shadow has no filter that hides steps.
            const float radius =
                technique.soft
                    ? renderer::cpuPenumbraRadiusUv<float>(
                          technique, {surfaces.depths.values.data(), surfaces.depths.width},
                          receiver, shadow)
                    : 0.0F;
            if (radius < 0) continue;
            const bool between = renderer::f32::inPenumbra(surfaces.visibility.at(x, y));
            const float shown = renderer::f32::shownRadiusUv(radius, receiver, shadow);
            const bool wide = technique.soft && shown >= receiver.footprintUv;
            if (!between && (wide || !surfaces.changesBeside(x, y))) continue;
            const int bin = rc::DemandHistogram::binOf(
                rc::demand(rule, {.radiusUv = radius, .footprint = receiver.footprintUv}));
            counters[bin < 0 ? 64 : static_cast<std::size_t>(bin)] +=
                rc::demandWeight(wide ? shown : 0, receiver.footprintUv);
        }
    }
    return counters;
}

/// As many submissions as a cell has pixels ask every pixel once.
Counters onTheGpu(renderer::DemandPass& pass, const renderer::Renderer& frame,
                  const renderer::DemandRule& rule, std::size_t view = 0) {
    Counters counters{};
    const int edge = renderer::DemandPass::cellEdge(frame.widthPx(), frame.heightPx());
    for (int turn = 0; turn < edge * edge; ++turn) {
        pass.submit(frame, rule, nullptr, view);
        glFinish();
        const auto reading = pass.next(view);
        EXPECT_TRUE(reading && !pass.next(view));
        if (!reading) break;
        for (std::size_t i = 0; i < counters.size(); ++i) counters[i] += reading->at(i);
    }
    return counters;
}

TEST(DemandPass, HistogramIsTheCpusOnTheSameSurfaces) {
    gl();
    renderer::DemandPass pass(renderer::ShaderLibrary::embedded(), demo::kDemandGlsl);
    for (const renderer::SceneEntry& scene : renderer::builtInScenes()) {
        // Edges that a group of the pass does not divide.
        renderer::Renderer frame(gl(), renderer::makeScene(scene.name), 161, 90);
        for (const char* technique : {"hard", "pcf_disc"}) {
            for (const auto& [radius, least] : {std::pair{0.0005F, 0.0F},
                                                {0.01F, 0.0F},
                                                {0.0005F, 0.0136F},
                                                {0.0F, 0.0F},
                                                {0.0F, 0.0136F}}) {
                const renderer::Technique& row = renderer::findTechnique(technique);
                frame.render({.technique = &row,
                              .resolution = 256,
                              .radiusUv = radius,
                              .minRadiusUv = least});
                const Counters expected = onTheCpu(frame, row, {.c = 3.47F, .texelsPerCaster = 0});
                const Counters found = onTheGpu(pass, frame, {.c = 3.47F, .texelsPerCaster = 0});
                EXPECT_GT(std::accumulate(expected.begin(), expected.end(), 0U), 50U);
                EXPECT_EQ(found, expected)
                    << scene.name << ' ' << technique << ' ' << radius << ' ' << least;
            }
        }
    }
}

// Lamps and cascades: each map asks only where it may serve, and misses nothing there.
TEST(DemandPass, EachOfSeveralMapsAsksAllPixelsThatItServes) {
    gl();
    renderer::DemandPass pass(renderer::ShaderLibrary::embedded(), demo::kDemandGlsl);
    const renderer::Technique& row = renderer::findTechnique("pcf_disc");
    for (const char* scene : {"lamps", "city:cascades=3"}) {
        renderer::Renderer frame(gl(), renderer::makeScene(scene), 161, 90);
        frame.render({.technique = &row, .resolution = 256});
        int asking = 0;
        for (std::size_t view = 0; view < frame.lightViews().size(); ++view) {
            if (!frame.outputs(view)) continue;
            const Counters expected =
                onTheCpu(frame, row, {.c = 3.47F, .texelsPerCaster = 0}, view);
            asking += std::accumulate(expected.begin(), expected.end(), 0U) > 0 ? 1 : 0;
            EXPECT_EQ(onTheGpu(pass, frame, {.c = 3.47F, .texelsPerCaster = 0}, view), expected)
                << scene << ", map " << view;
        }
        EXPECT_GE(asking, 3) << scene;
    }
}

// The contact of a fence with its shadow is as long whether its filter is a texel wide or,
// enlarged, many pixels. What bins at 2 px a texel and more is enlarged wholly.
TEST(DemandPass, AnEnlargedPenumbraWeighsWhatItsEdgeDoes) {
    gl();
    renderer::DemandPass pass(renderer::ShaderLibrary::embedded(), demo::kDemandGlsl);
    renderer::Renderer frame(gl(), renderer::makeScene("planar_occluder"), 640, 360);
    const auto weight = [&](float leastUv) {
        frame.render({.technique = &renderer::findTechnique("pcf_disc"),
                      .resolution = 128,
                      .radiusUv = 0.004F,
                      .minRadiusUv = leastUv});
        const Counters counters = onTheGpu(pass, frame, {.c = 3.47F});
        return std::accumulate(counters.begin(), counters.end() - 1, 0.0);
    };
    // Pixels are counted four times over by area; corners are rounded off by the wider filter.
    EXPECT_NEAR(weight(0.016F) / weight(0), 1, 0.25);
}

TEST(DemandPass, AsksEveryPixelOfALargeFrameOnceToo) {
    gl();
    renderer::DemandPass pass(renderer::ShaderLibrary::embedded(), demo::kDemandGlsl);
    renderer::Renderer frame(gl(), renderer::makeScene("planar_occluder"), 1001, 541);
    ASSERT_EQ(renderer::DemandPass::cellEdge(1001, 541), renderer::DemandPass::kLargeCellEdge);
    const renderer::Technique& row = renderer::findTechnique("hard");
    frame.render({.technique = &row, .resolution = 256});
    EXPECT_EQ(onTheGpu(pass, frame, {.c = 3.47F}), onTheCpu(frame, row, {.c = 3.47F}));
}

// The search's taps come from a sine and a cosine, which are each library's own: a tap on the edge
// of a texel may fall to its neighbour, and with it a demand on the edge of a bin.
TEST(DemandPass, CountsTheRadiusThatATechniqueHasAtEachPoint) {
    gl();
    renderer::DemandPass pass(renderer::ShaderLibrary::embedded(), demo::kDemandGlsl);
    for (const renderer::Technique& row : renderer::techniques()) {
        if (!renderer::hasOwnRadius(renderer::ShaderLibrary::embedded(), row)) continue;
        std::ptrdiff_t bins = 0;
        for (const renderer::SceneEntry& scene : renderer::builtInScenes()) {
            renderer::Renderer frame(gl(), renderer::makeScene(scene.name), 161, 90);
            frame.render({.technique = &row, .resolution = 256, .radiusUv = 0.01F});
            const Counters expected = onTheCpu(frame, row, {.c = 3.47F, .texelsPerCaster = 0});
            const Counters found = onTheGpu(pass, frame, {.c = 3.47F, .texelsPerCaster = 0});
            const unsigned total = std::accumulate(expected.begin(), expected.end(), 0U);
            unsigned moved = 0;
            for (std::size_t i = 0; i < found.size(); ++i)
                moved += found[i] > expected[i] ? found[i] - expected[i] : expected[i] - found[i];
            EXPECT_GT(total, 50U);
            EXPECT_LE(moved, 2 + total / 50) << scene.name << ' ' << row.name << ' ' << total;
            bins = std::max(bins, std::count_if(expected.begin(), expected.end(),
                                                [](unsigned count) { return count > 0; }));
        }
        EXPECT_GE(bins, 5) << "penumbrae of many widths ask for many sizes";
    }
}

// A shadow that is half as deep is asked for with c times (1/2)^e: at an exponent of 2, faint edges
// ask for much less, and none for more.
TEST(DemandPass, FaintEdgesAskForLessWithAContrastTerm) {
    renderer::Renderer frame(gl(), renderer::makeScene("yard"), 161, 90);
    renderer::DemandPass pass(renderer::ShaderLibrary::embedded(), demo::kDemandGlsl);
    frame.render({.technique = &renderer::findTechnique("pcf_disc"), .radiusUv = 0.01F});
    const auto meanBin = [&](float exponent) {
        const Counters counters =
            onTheGpu(pass, frame, {.c = 3.47F, .pixelBound = 1e6F, .contrastExponent = exponent});
        double sum = 0, count = 0;
        for (std::size_t bin = 0; bin < 64; ++bin) {
            sum += static_cast<double>(bin) * counters[bin];
            count += counters[bin];
        }
        EXPECT_GT(count, 50);
        return sum / count;
    };
    // A quarter of an octave a bin: contrasts of .2 to .7 are 2 to 9 bins at exponent 1.
    const double without = meanBin(0), with = meanBin(1);
    EXPECT_LT(with, without - 2);
    EXPECT_GT(with, without - 10);
    EXPECT_NEAR(meanBin(2) - without, 2 * (with - without), 1) << "bins round";
}

TEST(DemandPass, GivesEveryReadingOnceAndInOrder) {
    renderer::Renderer frame(gl(), renderer::makeScene("yard"), 64, 36);
    renderer::DemandPass pass(renderer::ShaderLibrary::embedded(), demo::kDemandGlsl);
    EXPECT_FALSE(pass.next()) << "nothing was submitted";
    EXPECT_FALSE(pass.submit(frame, {}));
    EXPECT_FALSE(pass.next()) << "no frame was drawn";
    frame.render({.technique = &renderer::findTechnique("pcf_disc"), .radiusUv = 0.01F});
    // What each pixel of a cell asks for, read one by one.
    constexpr int kCell = renderer::DemandPass::kCellEdge * renderer::DemandPass::kCellEdge;
    std::vector<Counters> expected;
    for (int turn = 0; turn < kCell; ++turn) {
        EXPECT_TRUE(pass.submit(frame, {}));
        glFinish();
        expected.push_back(pass.next().value());
        EXPECT_FALSE(pass.next());
    }
    EXPECT_NE(expected[0], expected[1]);
    // As frames come that are asked for in their time, late and not at all, while the ring fills
    // up: a frame that finds no room asks for nothing, and its pixels are the next one's.
    std::mt19937 random(4);
    int refused = 0, together = 0;
    for (std::size_t turn = 0; turn < 5 * kCell;) {
        refused += pass.submit(frame, {}) ? 0 : 1;
        if (random() % 4 > 0) continue;
        if (random() % 2 > 0) glFinish();
        for (int now = 0; const auto reading = pass.next(); ++turn, together += now++ > 0)
            ASSERT_EQ(*reading, expected[turn % kCell]) << turn;
    }
    EXPECT_GT(refused, 0);
    EXPECT_GT(together, 0) << "two or more of them at once";
}

TEST(DemandPass, ForgetsWhatIsUnderWay) {
    renderer::Renderer frame(gl(), renderer::makeScene("yard"), 64, 36);
    renderer::DemandPass pass(renderer::ShaderLibrary::embedded(), demo::kDemandGlsl);
    frame.render({.technique = &renderer::findTechnique("pcf_disc"), .radiusUv = 0.01F});
    while (pass.submit(frame, {})) {
    }
    pass.forget();
    glFinish();
    EXPECT_FALSE(pass.next()) << "it was of a view that is over";
    for (std::size_t i = 0; i < renderer::DemandPass::kRing; ++i)
        EXPECT_TRUE(pass.submit(frame, {})) << "there is room again";
    glFinish();
    for (std::size_t i = 0; i < renderer::DemandPass::kRing; ++i) EXPECT_TRUE(pass.next());
    EXPECT_FALSE(pass.next());
}

// A formula that does not compile is named with our file and line.
TEST(DemandPass, NamesAFormulaThatDoesNotCompile) {
    gl();
    try {
        renderer::DemandPass pass(renderer::ShaderLibrary::embedded(), "float broken(;");
        FAIL() << "it compiled";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("demand.glsl:1"), std::string::npos)
            << error.what();
    }
}

}  // namespace
