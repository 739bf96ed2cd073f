// SPDX-License-Identifier: MIT
// The controller's demand formula as GLSL (demand.glsl) and as C++ (demand.h), and the pass that
// counts it on the GPU.
#include "resolution_controller/demand.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <numeric>
#include <random>

#include "demo/demand_glsl.h"
#include "renderer/demand_pass.h"
#include "renderer/scene.h"
#include "resolution_controller/slope.h"

namespace {

namespace rc = resolution_controller;

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

const renderer::GlInfo& gl() {
    static const renderer::HeadlessContext context;
    return context.info();
}

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

/// All pixels of the last frame on the CPU: the shaders' receiver, the controller's formula.
Counters onTheCpu(renderer::Renderer& frame, bool hasKernel, const rc::DemandRule& rule) {
    const renderer::FloatImage positions = frame.readPositions(), planes = frame.readPlanes(),
                               visibility = frame.readVisibility();
    const auto& shadow = frame.shadowConstants();
    Counters counters{};
    for (int y = 0; y < positions.height; ++y) {
        for (int x = 0; x < positions.width; ++x) {
            if (positions.at(x, y, 3) == 0) continue;
            const auto three = [&](const renderer::FloatImage& image) {
                return glm::vec3(image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2));
            };
            const auto receiver = renderer::f32::shadowReceiver(three(positions), three(planes),
                                                                frame.viewConstants(), shadow);
            const bool inPenumbra = renderer::f32::inPenumbra(visibility.at(x, y));
            const bool wide = hasKernel && shadow.kernel.x >= receiver.footprintUv;
            const bool onMap = receiver.uv.x >= 0 && receiver.uv.y >= 0 && receiver.uv.x <= 1 &&
                               receiver.uv.y <= 1;
            if ((wide && !inPenumbra) || !receiver.facesLight || !onMap) continue;
            const int bin = rc::DemandHistogram::binOf(
                rc::demand(rule, {.radiusUv = shadow.kernel.x, .footprint = receiver.footprintUv}));
            ++counters[bin < 0 ? 64 : static_cast<std::size_t>(bin)];
        }
    }
    return counters;
}

/// As many submissions as a cell has pixels ask every pixel once.
Counters onTheGpu(renderer::DemandPass& pass, const renderer::Renderer& frame,
                  const renderer::DemandRule& rule) {
    Counters counters{};
    for (int turn = 0; turn < renderer::DemandPass::kCellEdge * renderer::DemandPass::kCellEdge;
         ++turn) {
        pass.submit(frame, rule);
        glFinish();
        const auto reading = pass.newest();
        EXPECT_TRUE(reading && reading->ageFrames == 0);
        if (!reading) break;
        for (std::size_t i = 0; i < counters.size(); ++i) counters[i] += reading->counters[i];
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
            for (const float radius : {0.0005F, 0.01F}) {
                const renderer::Technique& row = renderer::findTechnique(technique);
                frame.render({.technique = &row, .resolution = 256, .radiusUv = radius});
                const Counters expected =
                    onTheCpu(frame, row.soft, {.c = 3.47F, .texelsPerCaster = 0});
                const Counters found = onTheGpu(pass, frame, {.c = 3.47F, .texelsPerCaster = 0});
                EXPECT_GT(std::accumulate(expected.begin(), expected.end(), 0U), 50U);
                EXPECT_EQ(found, expected) << scene.name << ' ' << technique << ' ' << radius;
            }
        }
    }
    EXPECT_EQ(pass.lost(), 0);
}

TEST(DemandPass, GivesTheNewestFinishedReadingOnce) {
    renderer::Renderer frame(gl(), renderer::makeScene("yard"), 64, 36);
    renderer::DemandPass pass(renderer::ShaderLibrary::embedded(), demo::kDemandGlsl);
    EXPECT_FALSE(pass.newest()) << "nothing was submitted";
    pass.submit(frame, {});
    EXPECT_FALSE(pass.newest()) << "no frame was drawn";
    frame.render({.technique = &renderer::findTechnique("pcf_disc"), .radiusUv = 0.01F});
    for (int i = 0; i < 3; ++i) pass.submit(frame, {});
    glFinish();
    const auto first = pass.newest();
    ASSERT_TRUE(first);
    EXPECT_EQ(first->ageFrames, 0);
    EXPECT_FALSE(pass.newest()) << "the older ones are of no use any more";
    // More than the ring holds, without ever asking.
    for (std::size_t i = 0; i < 3 * renderer::DemandPass::kRing; ++i) pass.submit(frame, {});
    glFinish();
    const auto last = pass.newest();
    ASSERT_TRUE(last);
    EXPECT_EQ(last->ageFrames, 0);
    EXPECT_FALSE(pass.newest());
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
