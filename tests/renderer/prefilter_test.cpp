// SPDX-License-Identifier: MIT
// Kinds of prefilter against what they are said to compute: sums, mips, and penumbrae of the width
// that a variance map tells.
#include "renderer/prefilter.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/renderer/exact_box.h"
#include "tests/renderer/technique_case.h"

namespace {

using renderer::Storage;
using renderer::Technique;
using tests::constantsFor;
using tests::CpuTechnique;
using tests::exactly;
using tests::halfPlane;
using tests::Random;
using tests::receiverAt;
using Map = tests::DepthMap;

// Instrumented code does a tenth.
#ifdef __SANITIZE_ADDRESS__
constexpr int kShare = 10;
#else
constexpr int kShare = 1;
#endif

/// Mean of depth under a box in texels from the map's corner, texels counted by
/// their covered share.
double boxMean(const Map& map, glm::dvec2 low, glm::dvec2 high) {
    double sum = 0;
    const auto share = [](int i, double from, double to) {
        return std::max(std::min(i + 1.0, to) - std::max(static_cast<double>(i), from), 0.0);
    };
    for (int j = static_cast<int>(low.y); j < high.y; ++j)
        for (int i = static_cast<int>(low.x); i < high.x; ++i)
            sum += static_cast<double>(map.view().at(i, j)) * share(i, low.x, high.x) *
                   share(j, low.y, high.y);
    return sum / ((high.x - low.x) * (high.y - low.y));
}

// 2^32 units are passed every few hundred texels. What remains is a texel's
// rounding to units and float32's of the mean; a table of float32 sums would be
// off by up to .25 / (box's texels).
TEST(SummedAreaTable, BoxesAreExactAtAnyPlaceOfALargeMap) {
    const Technique& technique = renderer::findTechnique("vsm_sat");
    Random random(15);
    for (const int n : {32, 300, kShare == 1 ? 2048 : 512}) {
        const Map map(n, [&](double, double) { return random(); });
        const double radius = 4.0 / n;
        const auto constants = tests::toFloat(constantsFor(technique, n, radius));
        const auto sums = renderer::cpuMap<float>(technique, map.view(), constants);
        for (int i = 0; i < 2000; ++i) {
            const double reach = random(0.5, 3.4);
            const glm::vec2 uv(random(4.0 / n, 1 - 4.0 / n), random(4.0 / n, 1 - 4.0 / n));
            const glm::vec4 found =
                meanOfBox(sums.summedView(), uv, static_cast<float>(reach) / static_cast<float>(n),
                          constants);
            const glm::dvec2 centre = glm::dvec2(uv) * static_cast<double>(n);
            // 2e-4: places in float32 of 2,048 texels, over a texel of random depth.
            EXPECT_NEAR(found.x, boxMean(map, centre - reach, centre + reach),
                        n > 300 ? 2e-4 : 3e-5)
                << n;
        }
        // At whole texels nothing but the units' rounding is left.
        const glm::vec2 middle(static_cast<float>(n / 2 + 0.5) / static_cast<float>(n));
        const double m = n / 2 + 0.5;
        EXPECT_NEAR(meanOfBox(sums.summedView(), middle, 2.5F / static_cast<float>(n), constants).x,
                    boxMean(map, {m - 2.5, m - 2.5}, {m + 2.5, m + 2.5}), 2e-7 + 1e-4 * (n > 300));
    }
}

// Bleeding needs two depths before the receiver under one kernel.
TEST(SampledVariance, BleedsLessWithMoreSamples) {
    const Technique& technique = renderer::findTechnique("vsm_samples");
    const Map map(64, [](double u, double) { return u < 0.5 ? 0.1 : 0.6; });
    double last = 1;
    for (const float samples : {1.0F, 2.0F, 4.0F, 8.0F}) {
        renderer::ParameterValues parameters = technique.standardParameters();
        setParameter(technique, parameters, "samples", samples);
        const CpuTechnique<double> filter(
            technique, map, constantsFor(technique, 64, 0.15, parameters), Storage::exact);
        double bleeding = 0;
        for (double u = 0.3; u < 0.7; u += 0.01) bleeding += filter(receiverAt(u, 0.5, 0.7)) / 40;
        EXPECT_LT(bleeding, 0.8 * last) << samples;
        last = bleeding;
    }
}

// A pixel that is long across the light and short along an edge: without probes
// the level of its longer side blurs the edge.
TEST(MipChain, AnisotropyKeepsEdgesThatALongPixelRunsAlong) {
    const Technique& technique = renderer::findTechnique("vsm_mip");
    const Map map = halfPlane(256, 0, 0.3, 0.2, 0.8);
    auto receiver = receiverAt(0.5, 0.5 + 6.0 / 256, 0.8);
    receiver.longestStep = {16.0 / 256, 0};
    receiver.footprintUv = 4.0 / 256;
    const auto visibility = [&](float anisotropy, double radius) {
        renderer::ParameterValues parameters = technique.standardParameters();
        setParameter(technique, parameters, "anisotropy", anisotropy);
        return CpuTechnique<double>(technique, map,
                                    constantsFor(technique, 256, radius, parameters),
                                    Storage::exact)(receiver);
    };
    EXPECT_LT(visibility(1, 0.001), 0.8);
    EXPECT_GT(visibility(16, 0.001), 0.99);
    EXPECT_NEAR(visibility(1, 0.06), visibility(16, 0.06), 0.02) << "the kernel is wider than both";
}

// A pixel that is larger than the guard band is wide finds texels beyond the level's edge. There is
// nothing in the way; with the depths on the rim in their place a plane that falls away from the
// light towards the edge shadows itself there, to .1 of the light.
TEST(MipChain, PlanesAreLitWherePixelsSeeOverTheMapsEdge) {
    const Technique& technique = renderer::findTechnique("vsm_mip");
    constexpr int kN = 128;  // whose last mips leave texels out: 136 / 16 is not whole
    double least = 1;
    for (const glm::dvec2 slope : {glm::dvec2(0.4, 0), {-0.4, 0}, {0, 0.4}, {0, -0.4}}) {
        const auto depthAt = [&](double u, double v) {
            return 0.5 + slope.x * (u - 0.5) + slope.y * (v - 0.5);
        };
        const Map map(kN, depthAt);
        for (const float anisotropy : {1.0F, 16.0F}) {
            renderer::ParameterValues parameters = technique.standardParameters();
            setParameter(technique, parameters, "anisotropy", anisotropy);
            const CpuTechnique<double> filter(
                technique, map, constantsFor(technique, kN, 0, parameters), Storage::exact);
            for (const double pixel : {0.01, 0.06, 0.14, 0.5})
                for (const double u : {0.003, 0.04, 0.5, 0.96, 0.997})
                    for (const double v : {0.003, 0.04, 0.5, 0.96, 0.997}) {
                        auto receiver = receiverAt(u, v, depthAt(u, v), slope);
                        receiver.longestStep = slope * (pixel / glm::length(slope));
                        receiver.footprintUv = pixel / 4;
                        least = std::min(least, filter(receiver));
                    }
        }
    }
    EXPECT_GT(least, 0.95);
}

/// RMS difference from the profile of the penumbra that an occluder throws from
/// `gap` before the receiver.
double penumbraError(const Technique& technique, double gap) {
    constexpr double kAngle = 0.3, kReceiverDepth = 0.8, kRadius = 0.03;
    const Map map =
        halfPlane(256, kAngle * 180 / std::numbers::pi, 0.2, kReceiverDepth - gap, kReceiverDepth);
    const auto filter = exactly(technique, map, kRadius);
    const double radius = kRadius * gap / 0.25;
    double sum = 0;
    int count = 0;
    for (double along = -0.1; along < 0.1; along += 0.013)
        for (double x = -1.1; x < 1.1; x += 0.1, ++count) {
            const double distance = x * radius + 0.2 / 256;
            const double v = filter(receiverAt(
                0.5 + along * std::cos(kAngle) - std::sin(kAngle) * distance,
                0.5 + along * std::sin(kAngle) + std::cos(kAngle) * distance, kReceiverDepth));
            const double truth = tests::boxProfile(x * radius, radius * std::sqrt(0.75), kAngle);
            sum += (v - truth) * (v - truth);
        }
    return std::sqrt(sum / count);
}

// "Mipmapped samples are poor estimators of coverage for a penumbra with a
// slowly increasing width, creating boxy artifacts": sums have the width
// itself.
TEST(VariancePenumbra, FollowsTheGapWithSumsAndIsBoxyWithMips) {
    for (const double gap : {0.1, 0.25, 0.5, 0.7}) {
        const double sums = penumbraError(renderer::findTechnique("pcss_sat"), gap);
        const double mips = penumbraError(renderer::findTechnique("pcss_mip"), gap);
        EXPECT_LT(sums, 0.03) << "gap " << gap;
        EXPECT_LT(mips, 0.2) << "gap " << gap;
        EXPECT_GT(mips, 2 * sums) << "gap " << gap;
    }
}
}  // namespace
